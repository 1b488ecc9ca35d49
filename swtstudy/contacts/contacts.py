"""Many real contacts: the grid that arrays span."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from swtstudy.accuracy import ALLOWED_RTOL, DEFAULT_RTOL, is_rtol
from swtstudy.grid.reading import read_distances
from swtstudy.mistakes import Mistake, StudyError, literal, plain_number
from swtstudy.named import Named
from swtstudy.quantities import DISTANCE, Request, read_quantities
from swtstudy.solving import dimensions_of, solve_grid, spanned
from swtstudy.units.bodies import constants_of_both
from swtstudy.units.given import wrong_carrier
from swtstudy.units.grid import PhysicalGrid
from swtstudy.units.life import FatigueConstants
from swtstudy.units.reading import Given, completed, read_contacts

if TYPE_CHECKING:
    import xarray as xr


@dataclass(frozen=True, repr=False)
class PhysicalContacts:
    """Real contacts on the grid that arrays span, in any consistent set of units.

    Attributes
    ----------
    grid
        Their parameters.
    """

    grid: PhysicalGrid

    def __repr__(self) -> str:
        sizes = " × ".join(f"{n} {name}" for name, n in zip(self.grid.dims, self.grid.shape, strict=True))
        return f"<PhysicalContacts: {self.grid.size} = {sizes}>"

    def solve(
        self,
        rtol: float = DEFAULT_RTOL,
        *,
        quantities: Sequence[str] = (),
        critical_distance: object = None,
        constants: FatigueConstants | Sequence[FatigueConstants] | None = None,
    ) -> xr.Dataset:
        """s, SWT and, with constants, cycles of all of them.

        Parameters
        ----------
        rtol
            Relative accuracy asked of s.
        quantities
            Names of `swtstudy.quantities.QUANTITIES`, computed beside s.
        critical_distance
            One or several lengths, for nonlocal values.
        constants
            Of both bodies, or a pair for bodies of different materials: for cycles.

        Returns
        -------
        xarray.Dataset
            As of a study with units: the arrays are dimensions, in the order given; the bodies are one, 1 and
            2, where they differ.

        Raises
        ------
        StudyError
            A ValueError with every mistake.
        """
        mistakes: list[Mistake] = []

        def report(key: str, found: str, allowed: str) -> None:
            mistakes.append(Mistake(key, found, allowed))

        if not is_rtol(rtol):
            report("rtol", literal(rtol), ALLOWED_RTOL)
        several = critical_distance is not None and np.ndim(critical_distance) == 1  # type: ignore[arg-type]
        fixed = {} if several or critical_distance is None else {DISTANCE: critical_distance}
        axes = {DISTANCE: list(critical_distance)} if several else {}  # type: ignore[call-overload]
        distances = read_distances(fixed, axes, str, report, self.grid.row(DISTANCE))
        names = read_quantities(quantities, "quantities", report)
        asked = Request(names, *distances, counts=constants is not None)
        materials: tuple[FatigueConstants, ...] = ()
        try:
            materials = () if constants is None else constants_of_both(constants)
        except StudyError as error:
            mistakes += error.mistakes
        if mistakes:
            raise StudyError(mistakes)
        return solve_grid(_with_materials(self.grid, materials), float(rtol), asked)


def contacts_from(
    of_bodies: Mapping[str, object], values: Mapping[str, object], similar: object, bulk_stress_body: object
) -> PhysicalContacts:
    """The contacts on the grid that the sequences among the values span.

    Raises
    ------
    StudyError
        A ValueError with every mistake.
    """
    given = {name: value for name, value in values.items() if value is not None}
    fixed, several, mistakes = spanned(given)
    axes = {name: sequence for name, sequence in several.items() if sequence is not None}
    fixed |= {name: _pair(value) for name, value in of_bodies.items() if value is not None}
    defined = {
        name: {each.name: each for each in axes.get(name, [fixed.get(name)]) if isinstance(each, Named)}
        for name in ("load", "profile")
    }
    wrong = wrong_carrier(bulk_stress_body)
    if wrong:
        mistakes += wrong
        bulk_stress_body = 0
    own = Given(bulk_stress_body=int(plain_number(bulk_stress_body)))
    grid, found = read_contacts({**fixed, "similar": similar}, axes, own, known=defined)
    if grid is None or mistakes:
        raise StudyError([*mistakes, *found])
    return PhysicalContacts(grid)


def _pair(value: object) -> object:
    """A value, or a list of one for each body."""
    return list(value) if dimensions_of(value) == 1 else value  # type: ignore[call-overload]


def _with_materials(grid: PhysicalGrid, materials: tuple[FatigueConstants, ...]) -> PhysicalGrid:
    """The grid with constants; with both bodies, if these differ."""
    own = replace(grid, materials=materials)
    if len({*materials}) < 2 or grid.values("body"):
        return own
    extra = {
        name: getattr(own, name) for name in ("units", "pairs", "materials", "bulk_stress_body", "similar")
    }
    return completed(own.fixed, own.axes, own.samples, extra)
