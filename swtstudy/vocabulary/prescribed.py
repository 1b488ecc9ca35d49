"""Control: a displacement or a force is prescribed in each direction; the names of parameters say which."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from swtstudy.vocabulary.parameters import PARAMETERS

#: Parameters of which one of two is given, by the one that takes the other's place.
PAIRS: dict[str, str] = {
    name: parameter.instead_of for name, parameter in PARAMETERS.items() if parameter.instead_of
}


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
        """The parameter that is given in the place of one; that one itself where no force is."""
        forces = {"normal_amplitude": self.normal_force, "tangential_amplitude": self.tangential_force}
        return next(force for force, other in PAIRS.items() if other == name) if forces.get(name) else name


#: What the paper prescribes.
DISPLACEMENTS = Control()

#: The names of what is prescribed.
CONTROLS: dict[Control, str] = {
    DISPLACEMENTS: "displacements",
    Control(True, True): "forces",
    Control(True, False): "normal_force+tangential_displacement",
    Control(False, True): "normal_displacement+tangential_force",
}
