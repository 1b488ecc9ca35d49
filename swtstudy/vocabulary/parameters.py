"""The table of the study's non-dimensional parameters (eq. 20, Table 1), which are prescribed, and axes.

Validation, coordinate attributes, axis labels, the command line's help and the documentation all read it;
none of them repeats a name, a symbol, a default or a range. In each direction a displacement or a force is
prescribed: the names of the parameters say which. An axis, everything that a dimension of results may be, is
a parameter, or what only some results range over.
"""

from __future__ import annotations

import math
from collections import ChainMap
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from swtstudy.vocabulary.choices import CRITERIA, FAMILIES, SHIFTS
from swtstudy.vocabulary.files import read_table
from swtstudy.vocabulary.parameter import Parameter, spelled

#: The load of the paper.
HARMONIC = "harmonic"
#: Amplitudes of a loop that are not given: its vertices are the loads themselves.
LOOP_AMPLITUDE = 1.0

#: The parameters that say whether a bulk stress moves the stick zone, and by how much its body strains.
SHIFT, STRAIN_SHARE = "stick_zone_shift", "bulk_strain_share"
#: Into the body from the critical point: straight down, or along the critical plane.
DIRECTIONS = ("depth", "critical_plane")

_NAMES = {
    "load": (HARMONIC,),
    "profile": tuple(FAMILIES),
    SHIFT: SHIFTS,
    "criterion": tuple(CRITERIA),
    "direction": DIRECTIONS,
}
_ROWS = [
    Parameter(name, names=_NAMES.get(name, ()), **row)
    for name, row in read_table(__file__, "parameters").items()
]
#: Dimensions of quantities beside s that the points do not have.
QUANTITY_AXES = {row.name: row for row in _ROWS if row.part == "quantity"}
#: Parameters of real contacts alone. The study names their units: see `swtstudy.study.units.rows`.
CONTACT_AXES = {row.name: row for row in _ROWS if row.part == "contact"}
PARAMETERS = {row.name: row for row in _ROWS if row.part not in ("quantity", "contact")}
AXES: Mapping[str, Parameter] = ChainMap(PARAMETERS, QUANTITY_AXES, CONTACT_AXES)

#: Names by letter; if names share a letter, the first of them.
LETTERS: dict[str, str] = {parameter.letter: name for name, parameter in reversed(PARAMETERS.items())}


#: Parameters of which one of two is given, by the one that takes the other's place.
PAIRS: dict[str, str] = {
    name: parameter.instead_of for name, parameter in PARAMETERS.items() if parameter.instead_of
}
#: The one of two that is a force, by the one whose place it takes.
FORCE_OF = {other: force for force, other in PAIRS.items()}
#: The two of the normal load.
NORMAL_AMPLITUDES = frozenset({"normal_amplitude", "normal_force_amplitude"})


def replaced_by(names: Iterable[str]) -> set[str]:
    """The parameters whose places are taken by some of these."""
    return {PAIRS[name] for name in names if name in PAIRS}


@dataclass(frozen=True)
class Control:
    """The quantities prescribed in the two directions, each a displacement or a force.

    A normal force is in units of that at the depth δ0, a tangential one in μ times that.

    Attributes
    ----------
    normal_force, tangential_force
        Whether it is a force.
    """

    normal_force: bool = False
    tangential_force: bool = False

    @classmethod
    def given(cls, names: Iterable[str]) -> Control:
        """From the names of the parameters that are given."""
        found = set(names)
        return cls("normal_force_amplitude" in found, "tangential_force_amplitude" in found)

    @property
    def mixed(self) -> bool:
        """True if one direction has a force and the other a displacement."""
        return self.normal_force != self.tangential_force

    @property
    def name(self) -> str:
        """Value of the coordinate ``control``."""
        return CONTROLS[self]

    def given_for(self, name: str) -> str:
        """The force that is given instead of a displacement; the displacement itself where no force is."""
        forces = {"normal_amplitude": self.normal_force, "tangential_amplitude": self.tangential_force}
        return FORCE_OF[name] if forces.get(name) else name


#: The control of the paper: both displacements are prescribed.
DISPLACEMENTS = Control()

#: The names of what is prescribed.
CONTROLS: dict[Control, str] = {
    DISPLACEMENTS: "displacements",
    Control(True, True): "forces",
    Control(True, False): "normal_force+tangential_displacement",
    Control(False, True): "normal_displacement+tangential_force",
}

#: An angle beyond so many rad is probably meant in degrees.
MANY_TURNS = 8.0 * math.pi

#: Name and letter of a parameter by what may be typed for it: its letter, its symbol, the numerator of that.
SYMBOLS: dict[str, tuple[str, str]] = {
    spelled(symbol): (row.name, row.letter)
    for row in (*CONTACT_AXES.values(), *reversed(PARAMETERS.values()))
    for symbol in (row.letter, row.symbol, row.symbol.split("/")[0])
}
#: And the names of values, with the words that others have for them.
SYMBOLS |= {word.lower(): ("paraboloid", word) for word in ("sphere", "ball", "Hertz")}
SYMBOLS |= {"fs": ("fatemi_socie", "FS")}
