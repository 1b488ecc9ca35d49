"""A grid of real contacts, whose points are solved as non-dimensional ones.

A measured loop replaces a parameter of the contact: its mean is the mean load. The
loads of plane contacts are per length, unless their length is given.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, fields, replace
from functools import cache, cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from swtstudy.points.grid import GIVEN_COLUMNS, SHAPE_COLUMNS, Column, Grid, code_of, rounded
from swtstudy.points.values import Value, amplitudes_of, as_number, press_steadily
from swtstudy.solver.load_path import Loop
from swtstudy.solver.table import TabulatedProfile
from swtstudy.study.units.at_rest import Contact, Moduli, depth_at
from swtstudy.study.units.life import SCATTERED, Block, FatigueConstants, LifeCurve, Scatter, ShearConstants
from swtstudy.study.units.rows import AT_REST_NAMES, MEAN_LOADS, SCALES, SIMILAR, LineUnits, Units, rows
from swtstudy.vocabulary.choices import CRITERIA, SHARP, family_of, is_plane
from swtstudy.vocabulary.definition import Definition
from swtstudy.vocabulary.mistakes import StudyError, refused
from swtstudy.vocabulary.parameters import (
    LOOP_AMPLITUDE,
    NORMAL_AMPLITUDES,
    PARAMETERS,
    STRAIN_SHARE,
    Parameter,
)
from swtstudy.vocabulary.quantities import YIELD, Request

if TYPE_CHECKING:
    import xarray as xr


def are_measured(loads: Sequence[Value]) -> bool:
    """Return whether there are loads, of which each is a loop that knows its mean normal load."""
    known = [isinstance(load, Loop) and load.mean_normal is not None for load in loads]
    return bool(known) and all(known)


def mean_of_loads(given: Collection[str], loads: Sequence[Value]) -> str | None:
    """Which of `MEAN_LOADS` each load has the mean of; None where the load at rest is given by itself."""
    if {*MEAN_LOADS} & {*given} or not are_measured(loads):
        return None
    return "depth" if "normal_amplitude" in given else "normal_force"


def implied_amplitudes(given: set[str], loads: Sequence[Value], profiles: Iterable[Any]) -> dict[str, float]:
    """Amplitudes that contacts have unless they are given.

    The columns of measured loads are loads themselves: forces, if not told otherwise; beside a depth also a
    displacement. The normal load of a plane contact is constant.
    """
    found: dict[str, float] = {}
    if are_measured(loads):
        if NORMAL_AMPLITUDES.isdisjoint(given):
            found["normal_force_amplitude"] = LOOP_AMPLITUDE
        if not {"tangential_amplitude", "tangential_force_amplitude"} & given:
            kind = "" if "normal_amplitude" in given else "force_"
            found[f"tangential_{kind}amplitude"] = LOOP_AMPLITUDE
    elif NORMAL_AMPLITUDES.isdisjoint(given | scaling_of(loads)) and any(map(is_plane, profiles)):
        found["normal_force_amplitude"] = 0.0
    return found


def scaling_of(loads: Iterable[Value]) -> set[str]:
    """Names of the amplitudes that scale some of the loads that are loops; 0 times an amplitude is none."""
    names, loops = amplitudes_of(loads), [load for load in loads if isinstance(load, Loop)]
    return names - {"normal_amplitude"} if loops and press_steadily(loops) else names


def labels_of(units: Units, profiles: Iterable[object], given: Collection[str]) -> Units:
    """The labels of a study with these profiles, in which parameters of some names are given."""
    per_length = "contact_length" not in given and any(map(is_plane, profiles))
    return LineUnits(**vars(units)) if per_length else units


@dataclass(frozen=True)
class ContactDetails:
    """The facts that are given of contacts besides the values of their parameters.

    Attributes
    ----------
    units
        Labels of the units.
    pairs
        Properties in `OF_BODIES` that differ from body to body; they are not among the fixed values.
    materials
        Constants of both bodies; none if cycles are not asked for.
    similar
        Largest ``|β|/μ`` at which the bodies count as similar, β Dundurs' constant.
    bulk_stress_body
        0 or 1: the body that carries the bulk stress.
    blocks
        The sequence of loads of which Miner's sum is made; none if it is not asked for.
    yield_strengths
        One of each body; none if they are not given.
    body_names
        Names of both bodies; none if they are 1 and 2 alone.
    shear_materials
        Constants of both bodies in torsion; none if they are estimated from the others.
    findley_limits
        Limits of the Findley stress of each body; none if they are not given.
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

    def constants(
        self, criterion: str, poisson_ratios: Sequence[float]
    ) -> tuple[FatigueConstants | ShearConstants, ...]:
        """Constants of both bodies for lives by a criterion, estimated from the tensile ones unless given."""
        own: tuple[FatigueConstants | ShearConstants, ...] = getattr(self, CRITERIA[criterion].constants[-1])
        return own or tuple(map(ShearConstants.estimated, self.materials, poisson_ratios))

    def scatters(self, criterion: str) -> bool:
        """Return whether the constants of which a criterion makes lives scatter."""
        kinds = CRITERIA[criterion].constants
        if self.scatter is None or not kinds:
            return False
        torsion = bool(kinds[1:] and self.shear_materials)
        return any(SCATTERED[name].torsion == torsion for name in self.scatter.names)

    def curves(self, criterion: str, poisson_ratios: Sequence[float], drawn: bool) -> list[LifeCurve]:
        """The curve of lives of each body by a criterion, or its curves by each draw."""
        constants = self.constants(criterion, poisson_ratios)
        if not drawn or self.scatter is None:
            return [each.curve for each in constants]
        estimated = bool(CRITERIA[criterion].constants[1:]) and not self.shear_materials
        tensile = self.materials if estimated else (None, None)
        return [self.scatter.curve(each, body, tensile[body]) for body, each in enumerate(constants)]

    @property
    def has_lives(self) -> bool:
        """True if there are constants of a life."""
        return bool(self.materials or self.shear_materials)

    def request(
        self, names: Iterable[str], distances: tuple[float, ...] = (), is_axis: bool = False
    ) -> Request:
        """A request for these quantities, and for those that strengths and lives need."""
        needed = (YIELD,) if self.yield_strengths else ()
        return Request(tuple(dict.fromkeys((*names, *needed))), distances, is_axis, self.has_lives)

    @property
    def target_life(self) -> float:
        """The life before which the probability of a crack is asked for; 0 for none."""
        return self.scatter.target if self.scatter else 0.0


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

    @property
    def at_rest_dims(self) -> tuple[str, ...]:
        """The dimensions that its contacts at rest depend on."""
        varying = {self.dimension(name) for name in AT_REST_NAMES}
        return tuple(dim for dim in self.dims if dim in varying)

    @cached_property
    def at_rest(self) -> xr.Variable:
        """The contacts at rest over these dimensions; where there is none, the StudyError that says why."""
        import xarray as xr

        names = [name for name in AT_REST_NAMES if self.values(name)]

        @cache
        def contact(*values: Value) -> Contact | StudyError:
            try:
                return self._contact(dict(zip(names, values, strict=True)))
            except StudyError as error:
                return error

        values = [self.over_dimension(name, np.array(self.values(name), object)) for name in names]
        found = xr.apply_ufunc(contact, *values, vectorize=True, output_dtypes=[object])
        return found.transpose(*self.at_rest_dims)

    @property
    def distinct(self) -> list[Contact]:
        """The contacts at rest, each once."""
        return [*dict.fromkeys(self.at_rest.values.flat)]

    def each(self, value: Callable[[Contact], float], kind: type = float) -> xr.Variable:
        """A number of every contact at rest."""
        import xarray as xr

        return xr.apply_ufunc(cache(value), self.at_rest, vectorize=True, output_dtypes=[kind])

    def _contact(self, own: Mapping[str, Any]) -> Contact:
        """The contact with values of `AT_REST_NAMES`."""
        profile, of_bodies = own["profile"], ("young_modulus", "poisson_ratio")
        young, poisson = (self.pairs.get(name) or (float(own[name]),) * 2 for name in of_bodies)
        contact = Contact(
            Moduli(young, poisson),
            radius=own.get("radius"),
            depth=own.get("depth", 1.0),
            friction=own["friction"],
            profile=profile,
            shape={name: own[name] for name in family_of(profile).shape},
            contact_length=own.get("contact_length"),
        )
        if "normal_force" in own:
            contact = replace(contact, depth=depth_at(contact, own["normal_force"]))
        # No full disc up to its depth, or larger than the table.
        if isinstance(profile, TabulatedProfile) and (wrong := profile.refused_at(contact.depth)):
            raise refused("profile", str(profile), f"a lower load, or another table: {wrong}")
        return contact

    @property
    def definitions(self) -> dict[int, Definition]:
        """The user's definitions, by their codes in canonical rows: tables in a_H and δ0."""
        tables = (contact.pure_profile for contact in self.distinct)
        loads = {each.code: each for each in self.given if each.parameter == "load"}
        return loads | {table.code: table for table in tables if isinstance(table, Definition)}

    def along(self, name: str) -> xr.Variable:
        """The numbers of a parameter, over its dimension if it has one."""
        return self.over_dimension(name, np.array([as_number(value) for value in self.values(name)]))

    def of_bodies(self, value: Callable[[Contact, int], float]) -> xr.Variable:
        """A number of every contact and of each point's body, 0 or 1; over contacts if both are alike."""
        one, two = (self.each(lambda contact, k=k: value(contact, k)) for k in (0, 1))  # type: ignore[misc]
        return one if one.equals(two) else one.where(self.bodies == 0, two)

    def over_dimension(self, name: str, numbers: NDArray) -> xr.Variable:
        """Numbers that go with the values of a parameter."""
        import xarray as xr

        dim = self.dimension(name)
        return xr.Variable((dim,), numbers) if dim else xr.Variable((), numbers[0])

    @property
    def bodies(self) -> xr.Variable:
        """Indices of the bodies of the points, 0 or 1; the first one where they are alike."""
        labels = self.values("body") or (1.0,)
        return self.over_dimension("body", np.array([int(as_number(label)) - 1 for label in labels]))

    @cached_property
    def numbers(self) -> dict[str, xr.Variable]:
        """The non-dimensional parameters that are numbers, over the dimensions that each depends on."""
        found = {
            name: self.each(lambda contact, name=name: contact.shape_parameters.get(name, 0.0))  # type: ignore[misc]
            for name in SHAPE_COLUMNS  # 0 where the profile has none of it
        }
        found["poisson_ratio"] = self.of_body("poisson_ratio")
        found[STRAIN_SHARE] = self._strain_share
        for column, row in PARAMETERS.items():
            source, known = self.control.given_for(column), {*GIVEN_COLUMNS} - {*found}
            if row.kind == "number" and column in known and self.values(source):
                scale, values = PARAMETERS[source].scale, self.along(source)
                unit: Any = self.each(SCALES[scale].of) if scale else 1.0
                with np.errstate(divide="ignore", invalid="ignore"):
                    found[column] = (values / unit).where((values != 0.0) | (unit != 0.0), 0.0)
        if self.yield_strengths:
            # κ over k: the unit of stress over the strength of the body, or 1 where that does not count.
            share = self.of_bodies(lambda contact, body: contact.stress_scale / self.yield_strengths[body])
            is_ours = np.array([bool(CRITERIA[str(each)].normal_unit) for each in self.values("criterion")])
            scale_of_k = share.where(self.over_dimension("criterion", is_ours), 1.0)
            found["normal_sensitivity"] = found["normal_sensitivity"] * scale_of_k
        if self.values("bulk_stress_ratio"):
            found["bulk_stress_mean"] = self.mean_of_bulk(found["bulk_stress_amplitude"])
        if self.values("body"):
            carries = self.bodies == self.bulk_stress_body
            found["bulk_stress_mean"] = found["bulk_stress_mean"].where(carries, 0.0)
        return found

    def mean_of_bulk(self, amplitude: xr.Variable) -> xr.Variable:
        """The mean at which a bulk stress of this amplitude has its ratio of least over largest."""
        loads, ratio = self.values("load"), self.along("bulk_stress_ratio")
        ends = [(load.bulk_ends or (0.0, 0.0)) if isinstance(load, Loop) else (-1.0, 1.0) for load in loads]
        least, largest = (self.over_dimension("load", each) for each in np.array(ends).T)
        return amplitude * (ratio * largest - least) / (1.0 - ratio)

    def of_both(self, name: str) -> list[tuple[float, float]]:
        """The values of a property: one of each body, or all that both share."""
        alike = ((as_number(value),) * 2 for value in self.values(name))
        return [self.pairs[name]] if name in self.pairs else [*alike]

    def of_body(self, name: str) -> xr.Variable:
        """A parameter of the bodies, of each point's own body."""
        if name not in self.pairs:
            return self.along(name)
        return self.bodies.copy(data=np.array(self.pairs[name])[self.bodies.values])

    @cached_property
    def columns(self) -> dict[str, Column]:
        """See `Grid.columns`: in the units of the contacts at rest."""
        length = self.each(SCALES["a_H"].of)
        made = {
            "profile": self.each(lambda contact: code_of(contact.pure_profile), np.int64),
            "length_scale": length,
            # Tables have the R of the paraboloid with their a and δ0.
            "curvature": length / self.each(lambda own: own.radius or own.contact_radius**2 / own.depth),
            # With rounded edges: beside the face a/R is the slope.
            "face": self.each(lambda contact: contact.flat * (contact.profile != SHARP)) / length,
            "slip_scale": self.each(SCALES["μ E* δ0/G*"].of) / length,
            "body_share": self.numbers[STRAIN_SHARE],
        }
        for name, own in self.numbers.items():
            made[name] = own if PARAMETERS[name].units == "rad" else own.copy(data=rounded(own.values))
        columns: dict[str, Column] = {n: (tuple(map(str, v.dims)), v.values) for n, v in made.items()}
        return super().columns | columns

    def made(self, asked: Request) -> dict[str, tuple[str, ...]]:
        """See `Grid.made`."""
        from swtstudy.study.units.results import dims_of

        return super().made(asked) | dims_of(self, asked)

    @property
    def margins(self) -> tuple[str, ...]:
        """See `Grid.margins`."""
        return (*super().margins, "radius_ratio", *("slide_ratio",) * (not self.control.tangential_force))

    @property
    def is_pulled(self) -> bool:
        """True if a body carries a bulk stress at some point."""
        given = (self.values(name) for name in ("bulk_stress_amplitude", "bulk_stress_mean"))
        return any(value != 0.0 for values in given for value in values)

    @property
    def _strain_share(self) -> xr.Variable:
        """Strain of the body with the bulk stress over the mean of both; negative at the other body."""
        carrier, several = self.bulk_stress_body, bool(self.values("body"))

        def share(contact: Contact, body: int) -> float:
            found = contact.moduli.strain_share(carrier, contact.plane)
            if body == carrier or not several:
                return found
            # Divided as a shift in `a_H` is: by the number of this body over the number of the other one.
            of_both = [1.0 if contact.plane else (1.0 + ν) * (4.0 - 3.0 * ν) for ν in contact.moduli.poisson]
            return -found * (of_both[1 - carrier] / of_both[carrier])

        return self.of_bodies(share)

    def presented(self, dataset: xr.Dataset, asked: Request) -> xr.Dataset:
        """See `Grid.presented`."""
        from swtstudy.study.units.results import with_units

        return with_units(dataset, self, asked)
