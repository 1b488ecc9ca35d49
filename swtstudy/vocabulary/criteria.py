"""The criteria of which s may be the largest value, as the parameters know them.

The formulas are in `swtstudy.mechanics.planes.criteria`.
"""

from __future__ import annotations

import re

#: Their names: the Smith–Watson–Topper parameter, and the criteria of shear.
SWT, FATEMI_SOCIE, FINDLEY = "swt", "fatemi_socie", "findley"
NAMES = (SWT, FATEMI_SOCIE, FINDLEY)

#: What s is, in words for attributes, and its symbol with its unit.
MEANING = {
    SWT: "maximum Smith-Watson-Topper parameter over SWT0 = E* delta0 / R",
    FATEMI_SOCIE: "maximum Fatemi-Socie parameter times G over E* delta0 / a_H",
    FINDLEY: "maximum Findley stress over E* delta0 / a_H",
}
#: What a reader calls its values.
WORDS = {SWT: "SWT", FATEMI_SOCIE: "Fatemi-Socie parameter", FINDLEY: "Findley stress"}
SYMBOLS = {
    SWT: r"\mathrm{SWT}/\mathrm{SWT}_0",
    FATEMI_SOCIE: r"G \mathrm{FS}/(E^*\delta_0/a_H)",
    FINDLEY: r"f/(E^*\delta_0/a_H)",
}
#: Where a criterion of shear may be larger than s (results/audit_criteria_box.md).
BENEATH = (
    "a criterion of shear may be larger beside that line or beneath the surface, where friction is below "
    "0.3, the Poisson ratio below 0.1 or the tangential motion small: swtstudy audit compares"
)
#: The profile at whose sharp edge only SWT may be finite while it slips.
SHARP = "truncated_paraboloid"


def with_values_of(text: str, value: str) -> str:
    """A text about SWT with what another criterion calls its values in the place of that.

    Examples
    --------
    >>> with_values_of("mean of swt/SWT0 about local maxima of swt", "Findley stress")
    'mean of Findley stress in the unit of s about local maxima of Findley stress'
    """
    return re.sub(r"\b(?:swt|SWT)\b", value, text.replace("swt/SWT0", f"{value} in the unit of s"))
