"""Real contacts in physical units: their parameters, fields, SWT and lives, and results of both bodies."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from functools import lru_cache, partial
from operator import attrgetter
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from swtstudy.faces.one_body import OneBody, given_values, one_contact
from swtstudy.points.grid import SHAPE_COLUMNS
from swtstudy.points.reading import OF_POINTS, dimensions_of, listed, read_distances, read_grid, spanned
from swtstudy.points.rules import doubts
from swtstudy.points.solve import margins, solve_grid, values_along
from swtstudy.solver.table import TabulatedProfile
from swtstudy.study.units import rows as unit_rows
from swtstudy.study.units.at_rest import Moduli
from swtstudy.study.units.grid import ContactDetails, PhysicalGrid
from swtstudy.study.units.life import FatigueConstants, ShearConstants, checked_blocks, not_negative
from swtstudy.study.units.material import warn_of_units
from swtstudy.study.units.reading import check_distances, completed, doubts_of_units, read_contacts
from swtstudy.study.units.results import COMMENTS, attributes, derived
from swtstudy.vocabulary.arrays import FloatArray
from swtstudy.vocabulary.choices import CRITERIA, SWT, family_of, without_life
from swtstudy.vocabulary.derived import DERIVED, LIFE, lacking
from swtstudy.vocabulary.mistakes import (
    DEFAULT_RTOL,
    Mistake,
    Report,
    StudyError,
    literal,
    plain_number,
    refused,
)
from swtstudy.vocabulary.naming import with_parameters
from swtstudy.vocabulary.parameters import CONTACT_AXES, PAIRS, PARAMETERS
from swtstudy.vocabulary.quantities import ATTRIBUTES, COUNTED, DISTANCE, Request, read_quantities
from swtstudy.vocabulary.wording import html_table, plain_words

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from swtstudy.figures.sheet import Width
    from swtstudy.figures.style import Style

    #: Values with names for their dimensions keep them.
    Values = FloatArray | xr.DataArray

#: Sizes of a contact at rest.
AT_REST = (*unit_rows.TABLES["at_rest"], "mean_pressure", "swt_scale", "work_scale", "force_factor")


#: A table in other units: its fit takes time.
_scaled = lru_cache(maxsize=8)(TabulatedProfile.scaled)


@dataclass(frozen=True, repr=False)
class PhysicalContact:
    """A real contact, or contacts on the grid that sequences of values span, in any consistent set of units.

    Each parameter is an attribute, None where another one is given in its place; so is what the contact is
    at rest: ``depth`` δ0, ``normal_force``, ``contact_radius`` a, ``mean_pressure``, ``peak_pressure`` (inf
    at the edge of a truncated paraboloid), ``length_scale`` a_H, ``slip_scale`` μ E* δ0/G*,
    ``stress_scale`` E* δ0/a_H, ``swt_scale`` E* (δ0/a_H)², ``work_scale``, the unit of the work of friction,
    and ``force_factor``, the force over E* δ0 a_H. For several contacts these are DataArrays over the
    dimensions on which they depend.

    Attributes
    ----------
    grid
        Their parameters; the bodies, 1 and 2, are the last dimension unless one of them is asked for.
    """

    grid: PhysicalGrid

    def __repr__(self) -> str:
        several = {n: size for n, size in self.grid.sizes.items() if n != "body"}
        words = " × ".join(f"{size} {name}" for name, size in several.items()) or "one"
        count = f"{np.prod([*several.values()])} = " if len(several) > 1 else ""
        lines, rows = [f"<PhysicalContact: {count}{words}>"], [*self._words()]
        a, b, c, _ = (max(map(len, column)) for column in zip(*rows, strict=True))
        for kind, name, value, meaning in rows:
            lines.append(f"  {kind:<{a}}  {name:<{b}}  {value:>{c}}  {meaning}".rstrip())
        return "\n".join(lines)

    def _repr_html_(self) -> str:
        """A table for a notebook: what is given, the contact at rest, and the parameters without units."""
        return f"<div><b>Real contact</b>, in any consistent set of units{html_table(self._words())}</div>"

    def _words(self) -> Iterator[tuple[str, str, str, str]]:
        """Kind, name, value and meaning of all that is known without solving."""
        grid = self.grid
        for name, each in given_values(grid).items():
            if name not in unit_rows.TABLES["at_rest"]:
                yield "given", name, ", ".join(map(plain_words, each)), grid.row(name).meaning
        for name, meaning in unit_rows.TABLES["at_rest"].items():
            found = np.unique(grid.each(attrgetter(name)))
            ends = dict.fromkeys(found[[0, -1]].tolist())
            yield "at rest", name, " to ".join(map(plain_words, ends)), meaning
        # How far the contacts are from where the model ends, as far as that is known without solving.
        for name, values in margins(grid).items():
            if name not in ("stick_zone", "bulk_shift") and np.isfinite(values).any():
                largest = plain_words(float(np.nanmax(values)))
                yield "margin", name, f"up to {largest}", ATTRIBUTES[name]["comment"]
        single = grid.dims in ((), ("body",))
        for name, value in (self.parameters(grid.bulk_stress_body + 1) if single else {}).items():
            if PARAMETERS[name].scale:
                yield "without units", name, plain_words(value), PARAMETERS[name].notation

    def __getattr__(self, name: str) -> Any:
        if name in AT_REST:
            return self._plain(self.grid.each(attrgetter(name)))
        if name == "grid" or name not in self.grid.rows:
            raise AttributeError(f"a contact has no {name!r}")
        values = self.grid.values(name)
        if name == "bulk_stress_mean" and self.grid.values("bulk_stress_ratio"):
            return self._plain(self.grid.mean_of_bulk(self.grid.along("bulk_stress_amplitude")))
        if len(values) < 2:
            return values[0] if values else None
        kind = object if self.grid.row(name).kind == "name" else float
        return self._plain(self.grid.over_dimension(name, np.array(values, kind)))

    def _plain(self, values: xr.Variable) -> Any:
        """A number that does not vary as one of Python's, others with the values of their dimensions."""
        labels = {dim: values_along(self.grid, str(dim)) for dim in values.dims}
        return xr.DataArray(values, labels) if labels else values.values.item()

    def __dir__(self) -> list[str]:
        return sorted({*super().__dir__(), *AT_REST, *self.grid.rows})

    @property
    def units(self) -> dict[str, str]:
        """Labels of the units of length, force and stress; empty where nobody has said them."""
        return asdict(self.grid.units)

    @property
    def moduli(self) -> Moduli:
        """Elastic constants of the two bodies."""
        return self.grid.distinct[0].moduli

    @property
    def shape(self) -> dict[str, Any]:
        """Shape parameters of the profile, lengths but for the exponent."""
        profiles = {name for profile in self.grid.values("profile") for name in family_of(profile).shape}
        return {name: getattr(self, name) for name in PARAMETERS if name in profiles}

    def with_parameters(self, **parameters: Any) -> PhysicalContact:
        """The same bodies at the same R and δ0 with other non-dimensional parameters, which give its lengths.

        All others stay as they are without units: with another friction a tangential force that is given
        over μ F0 is another force. `physical` takes values with units. A ``normal_sensitivity`` is the
        contact's own k.

        Raises
        ------
        StudyError
            A ValueError with every mistake in the parameters.
        """
        if "poisson_ratio" in parameters:
            raise refused("poisson_ratio", "a parameter", "that of the bodies, which stays")
        rest, grid = one_contact(self.grid), self.grid
        shape = family_of(parameters.get("profile", rest.profile)).shape
        replaced = {name for pair in PAIRS.items() for name in pair if {*pair} & parameters.keys()}
        replaced |= {*SHAPE_COLUMNS} - {*shape}
        own = self.parameters(grid.bulk_stress_body + 1)
        found, report = read_grid({n: v for n, v in own.items() if n not in replaced} | parameters, {})
        if found is None:
            without = "; without units, as swtstudy.solve has it: swtstudy.physical takes units"
            raise StudyError([replace(each, allowed=each.allowed + without) for each in report])
        fixed: dict[str, Any] = {n: v for n, v in found.fixed.items() if n != "poisson_ratio"}
        if "profile" not in parameters:
            fixed["profile"] = rest.profile
        elif isinstance(fixed["profile"], TabulatedProfile):
            fixed["profile"] = _scaled(fixed["profile"], 1.0 / rest.length_scale, 1.0 / rest.depth)
        elif rest.radius is None:
            raise refused("profile", literal(parameters["profile"]), "a table: this contact has no radius")
        contact = replace(rest, friction=fixed["friction"], profile=fixed["profile"], shape={})
        # The shape, which the unit of force goes by; then in the order of the table: a length may be measured
        # in the one before it.
        order = [*shape, *PARAMETERS]
        for name in sorted(fixed, key=order.index):
            if PARAMETERS[name].scale:
                fixed[name] = contact.length_of(name, fixed[name])
            if name in shape:
                contact = replace(contact, shape={**contact.shape, name: fixed[name]})
        kept = {"young_modulus", "poisson_ratio", "radius", "body", "normal_sensitivity"} - {*parameters}
        kept |= {"contact_length"} if contact.plane else {*()}
        fixed |= {name: value for name, value in grid.fixed.items() if name in kept}
        axes = {name: values for name, values in grid.axes.items() if name == "body"}
        return PhysicalContact(completed(fixed | {"depth": rest.depth}, axes, {}, grid.about))

    def swt(self, s: ArrayLike | xr.DataArray, body: int | None = None) -> Values:
        """SWT of the bodies, in the unit of stress of the moduli, from s (eq. 19).

        Parameters
        ----------
        s
            From `parameters` of the body; also non-local values, or s_local of `swtstudy.swt_field`. In a
            DataArray with the coordinate ``body``, such as `solve` gives, each value belongs to its body.
            A DataArray over their dimensions for several contacts.
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
        return self._swt_of(s, self.moduli.alike, body)[0]

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
            Constants of both bodies, or a pair for bodies of different materials.
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
        report = Report()
        both = _of_both("constants", constants, report, FatigueConstants, needed=True)
        report.refuse()
        swt, bodies = self._swt_of(s, self.moduli.alike and both[0] == both[1], body)
        shares = [] if counted is None else [counted[name] for name in COUNTED]
        one, two = (each.curve.rounds("swt", swt, *shares) for each in both)
        lives = np.where(bodies == 2, two, one)
        if not hasattr(swt, "dims"):
            return lives
        words = attributes(DERIVED[LIFE], self.grid.labels)
        words |= {"comment": COMMENTS["uncounted" if counted is None else LIFE]}
        return one.copy(data=lives).assign_attrs(words)

    def _swt_of(self, s: ArrayLike | xr.DataArray, alike: bool, body: object) -> tuple[Any, NDArray[Any]]:
        """SWT from s, and the body of each value, 1 or 2, broadcastable to the values' shape.

        Raises
        ------
        StudyError
            If no s of the contacts is of SWT; if ``body`` and the coordinate ``body`` name it both, or
            neither and the bodies are not ``alike``; if s is negative or no number.
        """
        names = [str(each) for each in self.grid.values("criterion")]
        if SWT not in names:
            raise refused("criterion", ", ".join(names), f"{SWT}; of others solve() has the values in units")
        if isinstance(s, xr.DataArray) and "body" in s.coords:
            if body is not None:
                raise refused("body", literal(body), "nothing, since s has the coordinate body")
            if not np.isin(s.body, unit_rows.LABELS).all():
                raise refused("body", f"the coordinate {literal(s.body.values.tolist())}", "1 and 2")
            bodies = s.body.broadcast_like(s).transpose(*s.dims).values
        elif body is None and not alike:
            allowed = "1 or 2, since the bodies differ; or s over the dimension body, as solve() gives it"
            raise refused("body", "nothing", allowed)
        else:
            bodies = np.array(1 if body is None else unit_rows.checked_body(body))
        with np.errstate(over="ignore"):  # inf is an SWT that nothing lives with
            shares = np.where(bodies == 2, self.moduli.swt_share(1), self.moduli.swt_share(0))
            of_body = not_negative("s", s) * shares
            if not isinstance(s, xr.DataArray):
                return of_body * self.swt_scale, bodies
            swt = (s.copy(data=of_body) * self.swt_scale).transpose(*s.dims, ...)
        words = attributes(DERIVED["SWT"], self.grid.labels)
        return swt.rename("SWT").drop_attrs(deep=False).assign_attrs(words), bodies

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
            Constants of both bodies, or a pair for bodies of different materials: for cycles.
        yield_strength
            Strength of both bodies, or a pair: for von_mises and yield_ratio.
        blocks
            Rounds of each load, by its name, in a sequence of blocks that repeats: for Miner's sum.

        Returns
        -------
        xarray.Dataset
            As of a study with units. Its dimensions are the sequences, in the order given, and ``body``, 1
            and 2, unless the contact is given for one body.

        Raises
        ------
        StudyError
            A ValueError with every mistake.
        """
        grid, asked = self._request(rtol, critical_distance, constants, yield_strength, quantities, blocks)
        for words in (*doubts(grid), *doubts_of_units(grid)):
            warnings.warn(words, stacklevel=2)
        return solve_grid(grid, float(rtol), asked)

    def _request(
        self, rtol: Any, distance: Any, constants: Any, strength: Any, names: Any = (), blocks: Any = None
    ) -> tuple[PhysicalGrid, Request]:
        """The contacts with their materials, and what is asked of them; a StudyError with every mistake."""
        report, grid = Report(), self.grid
        fixed, axes = spanned({} if distance is None else {DISTANCE: distance}, report)
        if grid.samples and getattr(distance, "dims", ()) == (grid.sample_dim,):
            report(DISTANCE, *OF_POINTS)
        report.rtol(rtol)
        distances = read_distances(fixed, axes, report, grid.row(DISTANCE))
        names = read_quantities(names, "quantities", report)
        materials = _of_both("constants", constants, report, FatigueConstants)
        strengths = _of_both("yield_strength", strength, report) or grid.yield_strengths
        grid = replace(grid, materials=materials, yield_strengths=strengths)
        with report:
            grid = replace(grid, blocks=checked_blocks(blocks, grid.values("load")) if blocks else ())
        if constants is not None and (alone := without_life(grid.values("criterion"))):
            report("constants", f"constants with the criterion {alone} alone", "none: it has no life")
        if blocks and "load" in grid.samples:
            report(
                "blocks", "a load of each point", "loads along an axis of their own, of which a sum is made"
            )
        if blocks and constants is None and not grid.has_lives:
            report("blocks", "blocks without constants", "constants as well: Miner's sum needs lives")
        check_distances(grid, distances[0], report)
        report.refuse()
        warn_of_units(grid, self.moduli.young, table="")
        return grid, grid.request(names, *distances)

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
            the values of this contact.
        minimise
            A data variable of `solve`: "SWT", "SWT_volume", "cycles_volume", "yield_ratio" … Of a life the
            best is the longest. The worse of both bodies, and of both directions, counts.
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
        from swtstudy.results.optimise import check_asked, optimum_in, read_ranges

        one_contact(self.grid)
        grid, asked = self._request(rtol, critical_distance, constants, yield_strength)
        made = (each.name for each in derived(grid, asked) if each.of)
        known = dict.fromkeys(("s", "s_surface", *made, *grid.margins))
        if minimise not in known and (lacks := lacking(minimise, grid, grid.values("criterion"), asked)):
            raise refused("minimise", literal(minimise), f"with {' and '.join(lacks)}")
        report, corners = Report(), None
        numbers = [n for n, row in grid.rows.items() if row.kind == "number" and n not in (DISTANCE, "body")]
        with report:
            ranges, wrong = read_ranges(over, numbers)
            wrong.refuse()
            replaced = {*ranges}.union(*(pair for pair in unit_rows.ONE_OF if {*pair} & {*ranges}))
            given = {**grid.fixed, **{name: [*two] for name, two in grid.pairs.items()}}
            fixed = {name: value for name, value in given.items() if name not in replaced}
            along = ranges | {name: [*values] for name, values in grid.axes.items() if name == "body"}
            keys = {name: f"over.{name}" for name in ranges}
            corners, found = read_contacts(fixed, along, grid.about, lambda name: keys.get(name, name))
            found.refuse()
        check_asked(report, minimise, rtol, seed, [name for name in known if not name.endswith("_error")])
        if asked.is_axis:
            report(DISTANCE, "several", "one: what is made least is one value")
        report.refuse()
        assert corners is not None
        return optimum_in(corners, over, minimise, float(rtol), int(seed), asked)

    def parameters(self, body: int | str = 1) -> dict[str, Any]:
        """The non-dimensional parameters of one contact, for `swtstudy.solve` and all others.

        Parameters
        ----------
        body
            1 or 2, or its name. The bodies share all parameters but the Poisson ratio and the bulk stress:
            the tractions do not depend on these, and the stress beneath them on the body's alone.
        """
        return OneBody(self.grid, body).parameters

    def stress_field(self, x: Any, y: Any, z: Any, *, body: int | str = 1, time: object = None) -> xr.Dataset:
        """`swtstudy.stress_field` of one contact: at lengths, stresses in the unit of stress, in one body."""
        from swtstudy.results.stress import stress_field

        return self._field(partial(stress_field, time=time), body, x=x, y=y, z=z)

    def swt_field(self, x: Any, y: Any, z: Any, *, body: int | str = 1) -> xr.Dataset:
        """`swtstudy.swt_field` of one contact: at lengths, SWT in the unit of stress, in one body.

        By a criterion of shear FS, a strain, or findley_stress.
        """
        from swtstudy.results.stress import swt_field

        found = self._field(swt_field, body, x=x, y=y, z=z)
        return found.rename(s_local=CRITERIA[str(self.grid.values("criterion")[0])].name)

    def _field(self, field: Callable[..., xr.Dataset], body: int | str, **places: Any) -> xr.Dataset:
        """A field at places that are lengths, with units."""
        from swtstudy.results.one_point import read_places

        own = OneBody(self.grid, body)
        read_places(**places, allowed="finite positions, which are lengths")  # as they are given
        length = own.contact.length_scale
        in_a_h = {n: v / length if hasattr(v, "dims") else np.divide(v, length) for n, v in places.items()}
        return own.with_units(own.found(field, **in_a_h))

    def inspect_point(self, body: int | str = 1) -> xr.Dataset:
        """`swtstudy.inspect_point` of one contact, in lengths, forces and stresses, of one body."""
        from swtstudy.results.inspection import inspect_point

        own = OneBody(self.grid, body)
        return own.with_units(own.found(inspect_point))

    def inspect(self, body: int | str = 1, style: Style | None = None, width: Width | None = None) -> Figure:
        """`swtstudy.inspect` of one contact, in lengths, forces and stresses, of one body."""
        from swtstudy.figures.point import draw_inspection
        from swtstudy.results.inspection import inspect_point

        own = OneBody(self.grid, body)
        found, labels = own.found(inspect_point), own.labels
        if own.criterion != SWT:
            symbol = r"\sigma_n$, $\tau"
            labels = labels | {"normal_stress": labels["normal_stress"]._replace(symbol=symbol)}
        return draw_inspection(found, style, width, labels, (own.words(), own.validity))

    def draw_profile(self, style: Style | None = None, width: Width | None = None) -> Figure:
        """`swtstudy.draw_profile` of the profile of one contact at its mean load, in lengths and stresses."""
        from swtstudy.figures.definitions import draw_shape

        own = OneBody(self.grid, 1)
        shape = {n: value for n, value in own.parameters.items() if PARAMETERS[n].part == "shape"}
        return draw_shape(shape, style, width, own.labels, own.words(at_rest=True))


def _of_both(
    name: str, given: Any, report: Report, kind: type[Any] | None = None, needed: bool = False
) -> tuple[Any, ...]:
    """Constants of a kind, or else a stress, of each body: from one for both, or from a pair.

    Nothing, if that is not given or wrong; mistakes are added.
    """
    if given is None and not needed:
        return ()
    pair = tuple(given) if dimensions_of(given) == 1 and len(given) == 2 else (given, given)
    allowed = f"a {kind.__name__ if kind else 'positive stress'}, or a pair of them, one for each body"
    if kind is None:
        wrong = [each for stress in pair for each in unit_rows.wrong_size(name, stress, allowed)]
        pair = tuple(map(plain_number, pair))
    else:
        sound = all(isinstance(one, kind) for one in pair)
        wrong = [] if sound else [Mistake(name, literal(given), allowed)]
    report += dict.fromkeys(wrong)
    return () if wrong else pair


def contact_of(dataset: xr.Dataset) -> PhysicalContact:
    """The contacts of results.

    Raises
    ------
    StudyError
        If they have no units, or what a contact needs has been dropped.
    """
    from swtstudy.archive.recall import grid_of

    grid = grid_of(dataset)
    if not isinstance(grid, PhysicalGrid):
        raise refused("units", "results without units", "those of a study with [units]")
    return PhysicalContact(grid)


#: Keywords that ask for something; all others describe contacts.
_ASKED = ("rtol", "quantities", DISTANCE, "constants", "blocks")
#: Keywords that are no parameters.
_KEYWORDS = ("units", "yield_strength", "findley_limit", "shear_constants", *_ASKED)


@with_parameters(row for name, row in unit_rows.rows(unit_rows.Units()).items() if name != DISTANCE)
def physical(
    *,
    units: Mapping[str, str] | None = None,
    similar: Any = unit_rows.SIMILAR,
    bulk_stress_body: Any = None,
    bodies: Any = None,
    yield_strength: Any = None,
    findley_limit: Any = None,
    shear_constants: Any = None,
    **parameters: Any,
) -> PhysicalContact:
    """A real contact, in any consistent set of units: with N, mm and MPa, SWT comes in MPa.

    Each parameter but young_modulus, poisson_ratio, similar and bulk_stress_body may be a one-dimensional
    sequence of values; the result then covers every combination of the values. DataArrays that share a
    dimension are one list of contacts along this dimension.

    Parameters
    ----------
    units
        Labels of length, force and stress, such as {"length": "mm", "force": "N", "stress": "MPa"}, for
        results and figures; numbers are as they are.
    similar
        Largest ``|β|/μ`` at which the bodies count as similar (eq. 1); β is Dundurs' constant.
    bulk_stress_body
        1 or 2, or its name: the body that carries the bulk stress, the first unless given.
    bodies
        Names of the two bodies, such as ("pad", "specimen"), in results and figures beside 1 and 2.
    yield_strength
        A stress, of both bodies or a pair: the criterion "fatemi_socie" measures σ_n in it.
    findley_limit
        A stress, of both bodies or a pair: with the criterion "findley" results have findley_usage, the
        Findley stress divided by this limit.
    shear_constants
        `swtstudy.ShearConstants` of both bodies, or a pair: for FS_cycles by the criterion "fatemi_socie".
        By default they are estimated from the tensile constants of ``solve``.
    **parameters
        The names below. young_modulus and poisson_ratio are one value for two equal bodies, or a pair; these,
        radius, and either depth or normal_force must be given. The power law is f = rⁿ/(n Rⁿ⁻¹), with the
        slope 1 at r = R. There is no radius for a profile that is a `TabulatedProfile`: its radii and heights
        are lengths, the heights belong to both bodies together. With contact_length the loads of a plane
        contact are forces, without it forces per length. Plane contacts take only forces, with a constant
        normal load by default. bulk_stress_ratio replaces bulk_stress_mean.
        Parameters with a scale are lengths:
        tangential_amplitude uA of the relative displacement of the bodies far from the contact, which must be
        given as must be friction μ; normal_amplitude δA of the indentation depth, 0 unless given; instead of
        them the forces tangential_force_amplitude QA and normal_force_amplitude FA; and flat_radius b,
        waviness_amplitude h and wavelength λ of profiles that have them. bulk_stress_amplitude and
        bulk_stress_mean are stresses, 0 unless given, but the amplitude is 1 for a loop with a bulk stress:
        its column then has stresses. Angles, numbers, frequency_ratio, profile and exponent
        are as for `swtstudy.solve`.

    Returns
    -------
    PhysicalContact
        Its ``solve`` gives the Dataset of a study with units, of both bodies.

    Raises
    ------
    StudyError
        A ValueError with every mistake; also if the bodies are not similar.

    Examples
    --------
    >>> import swtstudy
    >>> contact = swtstudy.physical(
    ...     young_modulus=73.1e3, poisson_ratio=0.33, radius=50.0, normal_force=200.0,
    ...     friction=0.5, tangential_amplitude=0.002,
    ... )
    >>> round(contact.peak_pressure), round(contact.contact_radius, 3)
    (296, 0.568)
    >>> contacts = swtstudy.physical(
    ...     young_modulus=73.1e3, poisson_ratio=0.33, radius=50.0, normal_force=[100.0, 200.0],
    ...     friction=0.5, tangential_amplitude=0.002,
    ... )
    >>> repr(contacts).splitlines()[0]
    '<PhysicalContact: 2 normal_force>'
    >>> contacts.solve(rtol=1e-2).SWT.sel(body=1).round(2).values.tolist()
    [0.52, 0.58]
    """
    report, optional = Report(), (*CONTACT_AXES, *unit_rows.OF_BODIES)
    parameters = {n: value for n, value in parameters.items() if value is not None or n not in optional}
    for name in _ASKED:
        if name in parameters:
            report(name, "a keyword of a contact", f"one of its solve: physical(...).solve({name}=...)")
    about = ContactDetails(
        unit_rows.Units() if units is None else unit_rows.read_units(units, report),
        yield_strengths=_of_both("yield_strength", yield_strength, report),
        findley_limits=_of_both("findley_limit", findley_limit, report),
        shear_materials=_of_both("shear_constants", shear_constants, report, ShearConstants),
    )
    own = {name: value for name, value in parameters.items() if name not in _ASKED}
    pairs = {
        name: own.pop(name) for name in unit_rows.OF_BODIES if getattr(own.get(name), "dims", ()) == ("body",)
    }
    samples, dim, of_points, own = listed(own, report, unit_rows.rows(about.units))
    pairs |= {name: own.pop(name) for name in unit_rows.OF_BODIES if name in own}
    fixed, axes = spanned(own, report)
    fixed |= {name: list(raw) if dimensions_of(raw) == 1 else raw for name, raw in pairs.items()}
    if "body" not in parameters:
        axes["body"] = unit_rows.LABELS
    named = {unit_rows.NAMES_KEY: bodies, unit_rows.CARRIER_KEY: bulk_stress_body}
    named = {key: value for key, value in named.items() if value is not None}
    given = {**fixed, **named, unit_rows.SIMILAR_KEY: similar}
    grid, found = read_contacts(given, axes, about, samples=samples, keywords=_KEYWORDS)
    if grid is None or report:
        # Keywords are a table in a study.
        own = {"material": "shear_constants"} | {f"material.{name}": name for name in _KEYWORDS}
        raise StudyError([*report, *(replace(each, key=own.get(each.key, each.key)) for each in found)])
    return PhysicalContact(replace(grid, sample_dim=dim, sample_labels=of_points))
