"""Real contacts: their parameters, SWT, cycles, and results of both bodies."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from swtstudy.contacts.measured import InUnits, as_html, as_text, require_swt
from swtstudy.points.reading import read_distances, read_grid
from swtstudy.points.values import as_number
from swtstudy.profiles.table import TabulatedProfile
from swtstudy.solving import solve_grid, spanned
from swtstudy.units.at_rest import Moduli
from swtstudy.units.blocks import Block, checked_blocks
from swtstudy.units.bodies import bodies_of, constants_of_both, cycles_from, stresses_of_both, swt_from
from swtstudy.units.contacts_at_rest import check_distances
from swtstudy.units.grid import PhysicalGrid
from swtstudy.units.loads import mean_of_bulk
from swtstudy.units.material import warn_of_units
from swtstudy.units.reading import completed
from swtstudy.units.rows import length_of
from swtstudy.vocabulary.choices import FINDLEY, family_of, is_profile
from swtstudy.vocabulary.definition import Definition
from swtstudy.vocabulary.mistakes import (
    ALLOWED_RTOL,
    DEFAULT_RTOL,
    Mistake,
    Report,
    StudyError,
    is_rtol,
    literal,
)
from swtstudy.vocabulary.parameters import PAIRS, PARAMETERS
from swtstudy.vocabulary.quantities import DISTANCE, YIELD, Request, read_quantities

if TYPE_CHECKING:
    import xarray as xr

    from swtstudy.units.bodies import Values
    from swtstudy.units.life import FatigueConstants

#: What a contact is at rest.
AT_REST = (
    *("depth", "normal_force", "contact_radius", "mean_pressure", "peak_pressure", "length_scale"),
    *("slip_scale", "stress_scale", "swt_scale", "work_scale", "force_factor"),
)


@lru_cache(maxsize=8)
def _scaled(table: TabulatedProfile, length: float, depth: float) -> TabulatedProfile:
    """`TabulatedProfile.scaled`, whose fit takes time."""
    return table.scaled(length, depth)


@dataclass(frozen=True, repr=False)
class PhysicalContact(InUnits):
    """A real contact, or those on the grid that sequences of values span, in any consistent set of units.

    Each parameter is an attribute, None where another one is given in its place; so is what the contact is
    at rest: ``depth`` δ0, ``normal_force``, ``contact_radius`` a, ``mean_pressure``, ``peak_pressure`` (inf
    at the edge of a truncated paraboloid), ``length_scale`` a_H, ``slip_scale`` μ E* δ0/G*,
    ``stress_scale`` E* δ0/a_H, ``swt_scale`` E* (δ0/a_H)², ``work_scale``, the unit of the work of friction,
    and ``force_factor``, the force over E* δ0 a_H. Of several contacts these are DataArrays over the
    dimensions on which they depend.

    Attributes
    ----------
    grid
        Their parameters; the bodies, 1 and 2, are the last dimension unless one of them is asked for.
    """

    grid: PhysicalGrid

    def __repr__(self) -> str:
        several = {n: size for n, size in zip(self.grid.dims, self.grid.shape, strict=True) if n != "body"}
        words = " × ".join(f"{size} {name}" for name, size in several.items()) or "one"
        count = f"{np.prod([*several.values()])} = " if len(several) > 1 else ""
        return f"<PhysicalContact: {count}{words}>\n{as_text(self)}"

    def _repr_html_(self) -> str:
        """A table for a notebook: what is given, the contact at rest, and the parameters without units."""
        return as_html(self)

    def __getattr__(self, name: str) -> Any:
        if name in AT_REST:
            return self._plain(self.grid.at_rest.each(lambda contact: getattr(contact, name)))
        if name == "grid" or name not in self.grid.rows:
            raise AttributeError(f"a contact has no {name!r}")
        values = self.grid.values(name)
        if name == "bulk_stress_mean" and self.grid.values("bulk_stress_ratio"):
            ratio, amplitude = map(self.grid.along, ("bulk_stress_ratio", "bulk_stress_amplitude"))
            return self._plain(mean_of_bulk(ratio, amplitude, *self.grid.ends_of_bulk()))
        if len(values) < 2:
            return values[0] if values else None
        if self.grid.row(name).kind == "name":
            return self._plain(self.grid.over_dimension(name, np.array(values, object)))
        return self._plain(self.grid.along(name))

    def _plain(self, values: xr.DataArray) -> Any:
        """A number that does not vary as one of Python's, others with the values of their dimensions."""
        names = {dim: self.grid.values(str(dim)) for dim in values.dims}
        labels = {
            dim: [
                str(value) if isinstance(value, str | Definition) else as_number(value) for value in several
            ]
            for dim, several in names.items()
        }
        return values.assign_coords(labels) if labels else values.item()

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *AT_REST, *self.grid.rows]

    @property
    def moduli(self) -> Moduli:
        """Elastic constants of the two bodies."""
        return next(iter(self.grid.at_rest.contacts.flat)).moduli

    @property
    def shape(self) -> dict[str, Any]:
        """Shape parameters of the profile, lengths but for the exponent."""
        profiles = {name for profile in self.grid.values("profile") for name in family_of(profile).shape}
        return {name: getattr(self, name) for name in PARAMETERS if name in profiles}

    def with_parameters(self, **parameters: Any) -> PhysicalContact:
        """The same bodies at the same R and δ0 with other non-dimensional parameters: lengths from those.

        Raises
        ------
        StudyError
            A ValueError with every mistake in the parameters.
        """
        if "poisson_ratio" in parameters:
            raise StudyError([Mistake("poisson_ratio", "a parameter", "that of the bodies, which stays")])
        rest, grid = self._one, self.grid
        profile = parameters.get("profile", rest.profile)
        kept = family_of(profile).shape if isinstance(profile, Definition) or is_profile(profile) else ()
        every = self.parameters(grid.bulk_stress_body + 1)
        own = {n: v for n, v in every.items() if PARAMETERS[n].part != "shape" or n in (*kept, "profile")}
        replaced = {name for pair in PAIRS.items() for name in pair if {*pair} & parameters.keys()}
        own = {name: value for name, value in own.items() if name not in replaced}
        found, report = read_grid({**own, **parameters}, {})
        if found is None:
            raise StudyError(report)
        fixed: dict[str, Any] = {n: v for n, v in found.fixed.items() if n != "poisson_ratio"}
        if "profile" not in parameters:
            fixed["profile"] = rest.profile
        elif isinstance(fixed["profile"], TabulatedProfile):
            fixed["profile"] = _scaled(fixed["profile"], 1.0 / rest.length_scale, 1.0 / rest.depth)
        contact = replace(rest, friction=fixed["friction"], profile=fixed["profile"], shape={})
        shape = family_of(contact.profile).shape
        # In the order of the table: a length may be measured in the one before it.
        for name in sorted(fixed, key=[*PARAMETERS].index):
            if PARAMETERS[name].scale:
                fixed[name] = length_of(name, fixed[name], contact)
            if name in shape:
                contact = replace(contact, shape={**contact.shape, name: fixed[name]})
        bodies = ("young_modulus", "poisson_ratio", "radius", "body")
        fixed |= {name: value for name, value in grid.fixed.items() if name in bodies}
        axes = {name: values for name, values in grid.axes.items() if name == "body"}
        return PhysicalContact(completed(fixed | {"depth": rest.depth}, axes, {}, grid.about))

    def swt(self, s: ArrayLike | xr.DataArray, body: int | None = None) -> Values:
        """SWT of the bodies, in the unit of stress of the moduli, from s (eq. 19).

        Parameters
        ----------
        s
            From `parameters` of the body; also non-local values, or s_local of `swtstudy.swt_field`. In a
            DataArray with the coordinate ``body``, such as `solve` gives, each value is that of its body.
            Of several contacts a DataArray over their dimensions.
        body
            1 or 2, the body that has this s. Needed where the bodies differ and s does not say it.

        Returns
        -------
        numpy.ndarray or xarray.DataArray
            As s is, of the same shape.

        Raises
        ------
        StudyError
            A ValueError, if it is not said which body has this s, or s is negative or no number.
        """
        require_swt(self.grid)
        return swt_from(s, self.swt_scale, self.moduli, bodies_of(s, self.moduli.alike, body))

    def cycles(
        self,
        constants: FatigueConstants | Sequence[FatigueConstants],
        s: ArrayLike | xr.DataArray,
        body: int | None = None,
        counted: xr.Dataset | None = None,
    ) -> Values:
        """Rounds of the load to the initiation of a crack; mind the caveat of `FatigueConstants.cycles`.

        Parameters
        ----------
        constants
            Of both bodies, or a pair for bodies of different materials.
        s, body
            As for `swt`: ``contact.cycles((steel, cast_iron), contact.solve().s)`` has a life of each body.
        counted
            Results with counted and counted_number, as of `solve` with constants, with which s is a
            DataArray; unless it is given a round counts as one strain cycle.

        Returns
        -------
        numpy.ndarray or xarray.DataArray
            As s is, of the same shape.

        Raises
        ------
        StudyError
            A ValueError, as of `swt`, or if the constants are none.
        """
        require_swt(self.grid)
        both = constants_of_both(constants)
        bodies = bodies_of(s, self.moduli.alike and both[0] == both[1], body)
        return cycles_from(both, swt_from(s, self.swt_scale, self.moduli, bodies), bodies, counted)

    def solve(
        self,
        rtol: float = DEFAULT_RTOL,
        *,
        quantities: Sequence[str] = (),
        critical_distance: object = None,
        constants: FatigueConstants | Sequence[FatigueConstants] | None = None,
        yield_strength: float | Sequence[float] | None = None,
        blocks: Mapping[str, float] | None = None,
    ) -> xr.Dataset:
        """s, SWT and, with constants, cycles of both bodies.

        Parameters
        ----------
        rtol
            Relative accuracy asked of s.
        quantities
            Names of `swtstudy.vocabulary.quantities.QUANTITIES`, computed beside s.
        critical_distance
            One or several lengths, for nonlocal values.
        constants
            Of both bodies, or a pair for bodies of different materials: for cycles.
        yield_strength
            Of both bodies, or a pair: for von_mises and yield_ratio.
        blocks
            Rounds of each load, by its name, in a sequence of blocks that repeats: for Miner's sum.

        Returns
        -------
        xarray.Dataset
            As of a study with units. Its dimensions are the sequences, in the order given, and ``body``, 1
            and 2, unless the contact is given as that of one body.

        Raises
        ------
        StudyError
            A ValueError with every mistake.
        """
        grid, asked = self._with_request(
            rtol, quantities, critical_distance, constants, yield_strength, blocks
        )
        return solve_grid(grid, float(rtol), asked)

    def _with_request(
        self,
        rtol: object,
        quantities: Sequence[str],
        critical_distance: object,
        constants: object,
        yield_strength: object,
        blocks: Mapping[str, float] | None = None,
    ) -> tuple[PhysicalGrid, Request]:
        """The contacts with their materials, and what is asked of them; a StudyError with every mistake."""
        report = Report()
        fixed, axes = spanned({} if critical_distance is None else {DISTANCE: critical_distance}, report)
        if not is_rtol(rtol):
            report("rtol", literal(rtol), ALLOWED_RTOL)
        distances = read_distances(fixed, axes, report, self.grid.row(DISTANCE))
        names = read_quantities(quantities, "quantities", report)
        materials: tuple[FatigueConstants, ...] = ()
        with report:
            materials = () if constants is None else constants_of_both(constants)
        strengths = stresses_of_both("yield_strength", yield_strength, report) or self.grid.yield_strengths
        sequence: tuple[Block, ...] = ()
        with report:
            sequence = checked_blocks(blocks, self.grid.values("load")) if blocks else ()
        if constants is not None and {*self.grid.values("criterion")} == {FINDLEY}:
            report("constants", f"constants with the criterion {FINDLEY} alone", "none: it has no life")
        if blocks and constants is None and not self.grid.shear_materials:
            report("blocks", "blocks without constants", "constants as well: Miner's sum needs lives")
        check_distances(self.grid, distances[0], report)
        report.refuse()
        names = tuple(dict.fromkeys((*names, *([YIELD] if strengths else ()))))
        grid = replace(self.grid, materials=materials, yield_strengths=strengths, blocks=sequence)
        warn_of_units(grid, self.moduli.young)
        return grid, Request(names, *distances, counts=bool(materials or grid.shear_materials))

    def optimise(
        self,
        over: Mapping[str, tuple[object, object]],
        minimise: str = "SWT",
        *,
        rtol: float = DEFAULT_RTOL,
        seed: int = 0,
        critical_distance: object = None,
        constants: FatigueConstants | Sequence[FatigueConstants] | None = None,
        yield_strength: float | Sequence[float] | None = None,
    ) -> xr.Dataset:
        """The load, or contact, with the least SWT or the longest life, and the other extreme.

        Parameters
        ----------
        over
            Ranges by name, ``(low, high)``, in your units, of parameters that are numbers; the others are
            those of this contact.
        minimise
            A data variable of `solve`: "SWT", "SWT_volume", "cycles_volume", "yield_ratio" … Of a life the
            best is the longest. Of both bodies, and of both directions, that counts which is worse.
        rtol, seed
            As for `swtstudy.optimise`.
        critical_distance, constants, yield_strength
            As for `solve`.

        Returns
        -------
        xarray.Dataset
            As of `swtstudy.optimise`, in your units.

        Raises
        ------
        StudyError
            A ValueError with every mistake.
        """
        from swtstudy.contacts.optimum import optimum

        self._one  # noqa: B018 – one contact only, or an error
        grid, asked = self._with_request(rtol, (), critical_distance, constants, yield_strength)
        return optimum(grid, over, minimise, float(rtol), seed, asked)
