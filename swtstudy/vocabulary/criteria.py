"""Words for the criteria on a plane and for what swings; formulas: `swtstudy.kernel.criterion`."""

from __future__ import annotations

from typing import NamedTuple

from swtstudy.vocabulary.choices import FATEMI_SOCIE, FINDLEY, SWT


class Swing(NamedTuple):
    """The swing of a plane: its name as a variable, what a reader calls it, and its symbol in LaTeX."""

    name: str
    words: str
    symbol: str


class Criterion(NamedTuple):
    """A criterion.

    Attributes
    ----------
    words, symbol
        What a reader calls it, and its symbol in LaTeX.
    degree
        With which power of the stress it goes: with 2 its unit is stress times strain, with 1 stress.
    swing
        What swings.
    """

    words: str
    symbol: str
    degree: int
    swing: Swing


NORMAL_STRAIN = Swing("normal_strain", "strain normal to the plane", r"\varepsilon_n")
SHEAR_STRESS = Swing("shear_stress", "shear stress on the plane", r"\tau")
#: By their names in studies.
CRITERIA = {
    SWT: Criterion("Smith-Watson-Topper parameter", "swt", 2, NORMAL_STRAIN),
    FATEMI_SOCIE: Criterion("Fatemi-Socie parameter", r"\mathrm{FS}", 1, SHEAR_STRESS),
    FINDLEY: Criterion("Findley stress", "f", 1, SHEAR_STRESS),
}
