"""A grid of real contacts, whose points are solved as the non-dimensional ones that they are."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from swtstudy.points.canonical import GIVEN_COLUMNS, SHAPE_COLUMNS, code_of, rounded
from swtstudy.points.grid import Grid
from swtstudy.points.values import Value, as_number
from swtstudy.units.blocks import Block
from swtstudy.units.contacts_at_rest import ContactsAtRest, contacts_at_rest
from swtstudy.units.labels import Units
from swtstudy.units.life import FatigueConstants, ShearConstants
from swtstudy.units.loads import ends_of_bulk, labels_of, mean_of_bulk, mean_of_loads
from swtstudy.units.rows import SIMILAR, rows
from swtstudy.units.scatter import Scatter
from swtstudy.vocabulary.choices import FATEMI_SOCIE, is_plane
from swtstudy.vocabulary.definition import Definition
from swtstudy.vocabulary.parameter import Parameter
from swtstudy.vocabulary.parameters import PARAMETERS, STRAIN_SHARE
from swtstudy.vocabulary.quantities import Request

if TYPE_CHECKING:
    import xarray as xr

    from swtstudy.units.at_rest import Contact
    from swtstudy.vocabulary.arrays import FloatArray, IndexArray


@dataclass(frozen=True)
class ContactDetails:
    """The facts that are given of contacts besides the values of their parameters.

    Attributes
    ----------
    units
        Labels of the units.
    pairs
        What differs from body to body of `OF_BODIES`, which is not among the fixed values then.
    materials
        Constants of both bodies; none if cycles are not asked for.
    similar
        Largest ``|β|/μ`` at which the bodies count as similar, β Dundurs' constant.
    bulk_stress_body
        0 or 1: the body that carries the bulk stress.
    blocks
        The sequence of loads of which Miner's sum is made; none if it is not asked for.
    yield_strengths
        Of both bodies; none if they are not given.
    body_names
        What both are called; none if they are 1 and 2 alone.
    shear_materials
        Constants of both bodies in torsion; none if they are estimated from the others.
    findley_limits
        What the Findley stress of each body is compared with; none if they are not given.
    scatter
        Draws of the constants; None if these are single values.
    """

    units: Units = field(default_factory=Units)
    pairs: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    materials: tuple[FatigueConstants, ...] = ()
    similar: float = SIMILAR
    bulk_stress_body: int = 0
    blocks: tuple[Block, ...] = ()
    yield_strengths: tuple[float, ...] = ()
    body_names: tuple[str, ...] = ()
    shear_materials: tuple[ShearConstants, ...] = ()
    findley_limits: tuple[float, ...] = ()
    scatter: Scatter | None = None


@dataclass(frozen=True)
class PhysicalGrid(ContactDetails, Grid):
    """A grid of real contacts: a `Grid` in the units of the study.

    The body may be among its values, 1 or 2, and is the last axis where both bodies are asked for.
    """

    @property
    def of_loads(self) -> str | None:
        """The mean that each load gives, "depth" or "normal_force"; None where it is given by itself."""
        return mean_of_loads(self.names, super().values("load"))

    def values(self, name: str) -> tuple[Value, ...]:
        """See `Grid.values`."""
        if name == self.of_loads:
            return tuple(load.mean_normal for load in super().values("load"))  # type: ignore[union-attr]
        return super().values(name)

    def dimension(self, name: str) -> str | None:
        """See `Grid.dimension`."""
        return super().dimension("load" if name == self.of_loads else name)

    @property
    def labels(self) -> Units:
        """Labels of the units, which may be per length."""
        return labels_of(self.units, self.values("profile"), self.names)

    @property
    def plane(self) -> bool:
        """True if all its contacts are plane ones."""
        return all(map(is_plane, self.values("profile")))

    @property
    def about(self) -> ContactDetails:
        """The facts of the contacts besides the values of the parameters."""
        return ContactDetails(**{each.name: getattr(self, each.name) for each in fields(ContactDetails)})

    @cached_property
    def rows(self) -> dict[str, Parameter]:
        """The rows of the parameters, with their units."""
        return rows(self.labels)

    def row(self, name: str) -> Parameter:
        """See `Grid.row`."""
        return self.rows[name]

    @cached_property
    def at_rest(self) -> ContactsAtRest:
        """The contacts at rest."""
        return contacts_at_rest(self)

    @property
    def definitions(self) -> dict[int, Definition]:
        """The user's definitions, by their codes in canonical rows: tables in a_H and δ0."""
        tables = (contact.pure_profile for contact in self.at_rest.contacts.flat)
        loads = {each.code: each for each in self.given if each.parameter == "load"}
        return loads | {table.code: table for table in tables if isinstance(table, Definition)}

    def along(self, name: str) -> xr.DataArray:
        """The numbers of a parameter, over its dimension if it has one."""
        return self.over_dimension(name, np.array([as_number(value) for value in self.values(name)]))

    def over_dimension(self, name: str, numbers: NDArray) -> xr.DataArray:
        """Numbers that go with the values of a parameter."""
        import xarray as xr

        dim = self.dimension(name)
        return xr.DataArray(numbers, dims=dim) if dim else xr.DataArray(numbers[0])

    @property
    def bodies(self) -> xr.DataArray:
        """Indices of the bodies of the points, 0 or 1; the first one where they are alike."""
        return self.along("body").astype(int) - 1 if self.values("body") else _scalar(0)

    @cached_property
    def numbers(self) -> dict[str, xr.DataArray]:
        """The non-dimensional parameters that are numbers, over the dimensions that each depends on."""
        found = {name: self.at_rest.shape(name) for name in SHAPE_COLUMNS}
        found["poisson_ratio"] = self.of_body("poisson_ratio")
        found[STRAIN_SHARE] = self._strain_share
        for column, row in PARAMETERS.items():
            source = self._source(column)
            if (
                row.kind == "number"
                and column not in found
                and column in GIVEN_COLUMNS
                and self.values(source)
            ):
                scale = PARAMETERS[source].scale
                found[column] = _over(
                    self.along(source), self.at_rest.scale(scale) if scale else _scalar(1.0)
                )
        if self.yield_strengths:
            found["normal_sensitivity"] = found["normal_sensitivity"] * self._sensitivity_scale
        if self.values("bulk_stress_ratio"):
            ratio, amplitude = self.along("bulk_stress_ratio"), found["bulk_stress_amplitude"]
            found["bulk_stress_mean"] = mean_of_bulk(ratio, amplitude, *self.ends_of_bulk())
        if self.values("body"):
            carries = self.bodies == self.bulk_stress_body
            found["bulk_stress_mean"] = found["bulk_stress_mean"].where(carries, 0.0)
        return found

    @property
    def _sensitivity_scale(self) -> xr.DataArray:
        """κ over k: of Fatemi and Socie the unit of stress over the yield strength of the body, else 1."""
        one, two = (self.at_rest.scale("E* δ0/a_H") / strength for strength in self.yield_strengths)
        is_ours = np.array([value == FATEMI_SOCIE for value in self.values("criterion")])
        return one.where(self.bodies == 0, two).where(self.over_dimension("criterion", is_ours), 1.0)

    def ends_of_bulk(self) -> tuple[xr.DataArray, xr.DataArray]:
        """See `ends_of_bulk`, over the loads."""
        ends = np.array([ends_of_bulk(load) for load in self.values("load")])
        least, largest = (self.over_dimension("load", each) for each in ends.T)
        return least, largest

    def of_both(self, name: str) -> list[tuple[float, float]]:
        """The values of a property of both bodies: that of each, or all that are of both."""
        alike = ((as_number(value),) * 2 for value in self.values(name))
        return [self.pairs[name]] if name in self.pairs else [*alike]

    def of_body(self, name: str) -> xr.DataArray:
        """A parameter of the bodies, of each point's own body."""
        import xarray as xr

        if name not in self.pairs:
            return self.along(name)
        of_both = np.array(self.pairs[name])[self.bodies.values]
        return xr.DataArray(of_both, dims=self.bodies.dims)

    @cached_property
    def _codes_over(self) -> dict[str, tuple[tuple[str, ...], NDArray]]:
        """The numbers of each column of canonical rows, with their dimensions."""
        found: dict[str, tuple[tuple[str, ...], NDArray]] = {}
        for name in GIVEN_COLUMNS:
            if name in self.numbers:
                values, dims = self.numbers[name].values, tuple(map(str, self.numbers[name].dims))
                found[name] = dims, values if PARAMETERS[name].units == "rad" else rounded(values)
            elif name == "profile":
                contacts = self.at_rest.contacts
                profiles = np.array([code_of(contact.pure_profile, name) for contact in contacts.flat])
                found[name] = self.at_rest.dims, profiles.reshape(contacts.shape)
            else:
                dim = self.dimension(self._source(name))
                codes = self._codes[name]
                found[name] = ((dim,), codes) if dim else ((), codes[:1].reshape(()))
        return found

    def columns(self, places: IndexArray) -> dict[str, NDArray]:
        """See `Grid.columns`."""
        position = self._position(places)
        return {
            name: np.broadcast_to(values[tuple(position[dim] for dim in dims)], len(places))
            for name, (dims, values) in self._codes_over.items()
        }

    def made(self, asked: Request) -> dict[str, tuple[str, ...]]:
        """See `Grid.made`."""
        from swtstudy.units.variables import dims_of

        return super().made(asked) | dims_of(self, asked)

    @property
    def margins(self) -> tuple[str, ...]:
        """See `Grid.margins`."""
        return (*super().margins, "radius_ratio", *("slide_ratio",) * (not self.control.tangential_force))

    @property
    def curvatures(self) -> FloatArray:
        """a_H/R of each point; tables have the R of the paraboloid with their a and δ0. Shape (size,)."""
        return self._of_points(
            self.at_rest.each(
                lambda contact: (
                    contact.length_scale / (contact.radius or contact.contact_radius**2 / contact.depth)
                )
            )
        )

    @property
    def slip_scales(self) -> FloatArray:
        """See `Grid.slip_scales`."""
        return self._of_points(self.at_rest.each(lambda contact: contact.slip_scale / contact.length_scale))

    @property
    def strain_shares(self) -> FloatArray:
        """See `Grid.strain_shares`."""
        return self._of_points(self._strain_share)

    @property
    def _strain_share(self) -> xr.DataArray:
        """The same over the dimensions that it depends on: that of the body with the bulk stress."""
        body = self.bulk_stress_body
        share = self.at_rest.each(lambda contact: contact.moduli.strain_share(body, contact.plane))
        if not self.values("body"):
            return share

        def over_own(contact: Contact) -> float:
            """Number of the other body over that of this one, by which a shift in `a_H` is divided."""
            of_both = [1.0 if contact.plane else (1.0 + ν) * (4.0 - 3.0 * ν) for ν in contact.moduli.poisson]
            return of_both[1 - body] / of_both[body]

        return share.where(self.bodies == body, -share * self.at_rest.each(over_own))

    def _of_points(self, over: xr.DataArray) -> FloatArray:
        """Values over some of the dimensions for each point, shape (size,)."""
        over = over.transpose(*(dim for dim in self.dims if dim in over.dims))
        shape = [size if dim in over.dims else 1 for dim, size in zip(self.dims, self.shape, strict=True)]
        return np.broadcast_to(over.values.reshape(shape), self.shape).ravel()

    def presented(self, dataset: xr.Dataset, asked: Request) -> xr.Dataset:
        """See `Grid.presented`."""
        from swtstudy.units.results import with_units

        return with_units(dataset, self, asked)

    def distances(self, asked: Request) -> FloatArray:
        """See `Grid.distances`: the same length is another one in a_H from contact to contact."""
        if not asked.distances:
            return super().distances(asked)
        length = self._of_points(self.at_rest.scale("a_H"))
        return rounded(np.array(asked.distances) / length[:, None])


def _over(values: xr.DataArray, scale: xr.DataArray) -> xr.DataArray:
    """A ratio, 0 for nothing over nothing."""
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = values / scale
    return ratio.where((values != 0.0) | (scale != 0.0), 0.0)


def _scalar(value: float) -> xr.DataArray:
    import xarray as xr

    return xr.DataArray(value)
