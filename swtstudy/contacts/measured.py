"""One contact in lengths, forces and stresses: its stress, its SWT, its cycle; a table for notebooks."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from swtstudy.figures.quantity_words import Label
from swtstudy.points.canonical import Distinct
from swtstudy.points.labelled import margins
from swtstudy.points.validity import validity_lines
from swtstudy.solving import solve_grid
from swtstudy.units.at_rest import Contact
from swtstudy.units.bodies import checked_body
from swtstudy.units.grid import PhysicalGrid
from swtstudy.units.labels import UNIT_KINDS, Units
from swtstudy.units.loads import are_measured
from swtstudy.units.rows import REST_DEPENDS_ON, SCALES, rows
from swtstudy.units.variables import KINDS
from swtstudy.vocabulary.choices import FATEMI_SOCIE, FINDLEY, SWT, family_of, is_plane
from swtstudy.vocabulary.definition import Definition
from swtstudy.vocabulary.mistakes import DEFAULT_RTOL, Mistake, StudyError
from swtstudy.vocabulary.parameters import LOOP_AMPLITUDE, PARAMETERS, SHIFT
from swtstudy.vocabulary.quantities import YIELD, Request
from swtstudy.vocabulary.variables import ATTRIBUTES
from swtstudy.vocabulary.wording import html_table, place_words, plain_words

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

    from swtstudy.contacts.contact import PhysicalContact
    from swtstudy.figures.sheet import Width
    from swtstudy.figures.style import Style

#: What a contact is at rest, and what everything else is measured in.
_AT_REST = {
    "depth": "mean indentation depth δ0",
    "normal_force": "normal force F0",
    "contact_radius": "contact radius",
    "peak_pressure": "largest pressure",
    "length_scale": "a_H",
    "slip_scale": "μ E* δ0/G*, at which the whole contact slides",
    "stress_scale": "E* δ0/a_H",
}


def as_html(contact: PhysicalContact) -> str:
    """A table: what is given, the contact at rest, and the parameters without units of the first body."""
    return f"<div><b>Real contact</b>, in any consistent set of units{html_table(_rows(contact))}</div>"


def as_text(contact: PhysicalContact) -> str:
    """The same in lines: a name, its value and its meaning in columns."""
    rows = [*_rows(contact)]
    kinds, names, values = (max(len(row[column]) for row in rows) for column in range(3))
    return "\n".join(
        f"  {kind:<{kinds}}  {name:<{names}}  {value:>{values}}  {meaning}".rstrip()
        for kind, name, value, meaning in rows
    )


def headline(grid: PhysicalGrid, body: int, at_rest: bool) -> str:
    """List what is given of one contact with symbols and units: of one of its bodies, or of it at rest."""
    words = {}
    for name, values in {"profile": grid.values("profile"), **_given(grid)}.items():
        if grid.row(name).part == "bulk" and body != grid.bulk_stress_body + 1:
            continue
        if at_rest and name not in REST_DEPENDS_ON:
            continue
        row = grid.row(name)
        value: Any = values[body - 1 if name in grid.pairs else 0]
        value = str(value) if row.kind == "name" else value
        words[name] = place_words(name, value, {"symbol": row.symbol, "units": row.units})
    if grid.body_names and not at_rest:
        words["body"] = grid.body_names[body - 1]
    return ",  ".join(words.values())


def _given(grid: PhysicalGrid) -> dict[str, tuple[Any, ...]]:
    """The values of what is given of contacts, but for what goes without saying."""
    values = {name: grid.pairs.get(name) or grid.values(name) for name in grid.rows if name != "body"}
    unsaid, loads = [], grid.values("load")
    if all(isinstance(load, Definition) for load in loads):
        unsaid += ["frequency_ratio", "phase"]
    if are_measured(loads):
        # Its amplitudes are factors of what was measured.
        factors = [name for name in values if grid.row(name).part in ("load", "bulk")]
        unsaid += [name for name in factors if {*values[name]} == {LOOP_AMPLITUDE}]
    return {
        name: each
        for name, each in values.items()
        if each and name not in unsaid and not all(map(grid.row(name).goes_without_saying, each))
    }


def _rows(contact: PhysicalContact) -> Iterator[tuple[str, str, str, str]]:
    grid = contact.grid
    table = rows(Units(*(f"the unit of {kind}" for kind in UNIT_KINDS)))
    for name, each in _given(grid).items():
        if name not in _AT_REST:
            yield "given", name, ", ".join(map(plain_words, each)), table[name].meaning
    for name, meaning in _AT_REST.items():
        found = np.unique(getattr(contact, name))
        yield "at rest", name, " to ".join(map(plain_words, dict.fromkeys((found[0], found[-1])))), meaning
    yield from _margins(grid)
    if grid.dims not in ((), ("body",)):
        return
    for name, value in contact.parameters(grid.bulk_stress_body + 1).items():
        if PARAMETERS[name].scale:
            yield "without units", name, plain_words(value), PARAMETERS[name].notation


def _margins(grid: PhysicalGrid) -> Iterator[tuple[str, str, str, str]]:
    """Say how far the contacts are from where the model ends, as far as that is known without solving."""
    for name, values in margins(Distinct.of(grid), grid).items():
        if name not in ("stick_zone", "bulk_shift") and np.isfinite(values).any():
            largest = plain_words(float(np.nanmax(values)))
            yield "margin", name, f"up to {largest}", ATTRIBUTES[name]["comment"]


#: Data variables and coordinates by what they are measured in, and the symbols that they have with a unit.
_LENGTHS = {
    **{"x": "x", "y": "y", "z": "z", "r": "r", "contact_radius": "a", "slip_radius": "c", "shown_x": "x"},
    **{
        "stick_left": "x",
        "stick_right": "x",
        "stick_centre": "x",
        "permanent_stick_radius": "c",
        "least_radius": "a",
        "largest_radius": "a",
    },
    "critical_x": "x",
}
_STRESSES = {
    **{f"sigma_{name}": rf"\sigma_{{{name}}}" for name in ("xx", "yy", "zz", "yz", "xz", "xy")},
    **{"normal_stress": r"\sigma_n", "bulk_stress": r"\sigma_B", "pressure": "p", "traction": "q"},
    "shear_stress": r"\tau",
}


@dataclass(frozen=True)
class Measured:
    """The scales of one body of one contact.

    Attributes
    ----------
    contact
        The contact at rest.
    body
        0 or 1.
    units
        Labels.
    criterion
        Of which s is.
    """

    contact: Contact
    body: int
    units: Units
    criterion: str = SWT

    @property
    def swt(self) -> float:
        """SWT over s."""
        return self.contact.swt_scale * self.contact.moduli.swt_share(self.body)

    def scales(self) -> dict[str, tuple[float, str, str]]:
        """By name of a variable the scale, the kind of its unit, and its symbol."""
        contact = self.contact
        found = {name: (contact.length_scale, "length", symbol) for name, symbol in _LENGTHS.items()}
        found |= {name: (contact.stress_scale, "stress", symbol) for name, symbol in _STRESSES.items()}
        strain = contact.depth / contact.length_scale * contact.moduli.swt_share(self.body)
        return found | {
            "depth": (contact.depth, "length", r"\delta"),
            "displacement": (contact.slip_scale, "length", "u"),
            "normal_force": (contact.normal_force, "force", "F_N"),
            "tangential_force": (contact.friction * contact.normal_force, "force", "F_x"),
            "height": (contact.depth, "length", "-z"),
            "spring_depth": (contact.depth, "length", "g"),
            "normal_strain": (strain, "1", r"\varepsilon_n"),
            "s_local": self._local(),
            "dissipation": (contact.work_scale, "work", "W"),
            "dissipation_error": (contact.work_scale, "work", r"\Delta W"),
        }

    def _local(self) -> tuple[float, str, str]:
        """Of the value of the criterion at a place."""
        scales = {
            SWT: self.swt,
            FATEMI_SOCIE: self.contact.stress_scale / self.contact.moduli.shear[self.body],
            FINDLEY: self.contact.stress_scale,
        }
        kind = KINDS[self.criterion]
        return scales[self.criterion], kind.unit, kind.symbol

    def labels(self) -> dict[str, Label]:
        """By name of a variable what its numbers are in these units."""
        found = {
            name: Label(scale, symbol, self._unit(kind))
            for name, (scale, kind, symbol) in self.scales().items()
        }
        if self.criterion != SWT:
            found["normal_stress"] = found["normal_stress"]._replace(symbol=r"\sigma_n$, $\tau")
        return found

    def _unit(self, kind: str) -> str:
        return "1" if kind == "1" else self.units.label(kind) or f"unit of {kind}"

    def places(self, **given: Any) -> dict[str, Any]:
        """Places in lengths as those in a_H that the mechanics is asked for."""
        import xarray as xr

        from swtstudy.fields.one_point import read_places

        read_places(**given, allowed="finite positions, which are lengths")  # as they are given
        length = self.contact.length_scale
        return {
            name: (value if isinstance(value, xr.DataArray | float | int) else np.asarray(value)) / length
            for name, value in given.items()
        }

    def with_units(self, dataset: xr.Dataset, names: Mapping[str, str] | None = None) -> xr.Dataset:
        """The same in lengths, forces and stresses; some under other names."""
        dataset = dataset.copy()
        for name, (scale, kind, symbol) in self.scales().items():
            if name in dataset.variables:
                words = str(dataset[name].attrs.get("long_name", name))
                words = words.partition(", in units of")[0].partition(" over E*")[0]
                own = {"long_name": words, "symbol": symbol, "units": self._unit(kind)}
                _scale(dataset, name, scale, own)
        for name, row in rows(self.units).items():
            by = PARAMETERS[name].scale if name in PARAMETERS else ""
            if by and name in dataset.coords:
                units = row.units or f"unit of {SCALES[by].kind}"
                own = {"symbol": row.symbol, "units": units}
                _scale(dataset, name, SCALES[by].of(self.contact), own)
        return dataset.rename({old: new for old, new in (names or {}).items() if old in dataset})


def _scale(dataset: xr.Dataset, name: str, scale: float, own: Mapping[str, str]) -> None:
    """Multiply a variable of a Dataset, in place, and change some of its attributes."""
    attributes = {**dataset[name].attrs, **own}
    dataset[name] = dataset[name].variable * scale
    dataset[name].attrs = attributes


def require_swt(grid: PhysicalGrid) -> None:
    """Raise a StudyError, a ValueError, where no s of a grid is of SWT."""
    names = [str(each) for each in grid.values("criterion")]
    if SWT not in names:
        allowed = f"{SWT}; of others solve() has the values in units"
        raise StudyError([Mistake("criterion", ", ".join(names), allowed)])


class InUnits:
    """One contact: its parameters without units, and its fields and inspection in lengths and stresses."""

    grid: PhysicalGrid

    @cached_property
    def _one(self) -> Contact:
        """The contact at rest; a StudyError if there are several."""
        several = [name for name in self.grid.dims if name != "body"]
        if several:
            raise StudyError([Mistake(", ".join(several), "several contacts", "one: a single value of each")])
        return self.grid.at_rest.contacts.item()

    def parameters(self, body: int | str = 1) -> dict[str, Any]:
        """The non-dimensional parameters of one contact, for `swtstudy.solve` and all others.

        Parameters
        ----------
        body
            1 or 2, or its name. The bodies share all parameters but the Poisson ratio and the bulk stress:
            the tractions do not depend on these, and the stress beneath them on those of the body alone.
        """
        contact, grid = self._one, self._grid_of(self._body(body))
        control, shape = grid.control, family_of(contact.profile).shape
        names = ("frequency_ratio", "load", "criterion", SHIFT)
        own: dict[str, Any] = {name: grid.values(name)[0] for name in names}
        own["profile"] = contact.pure_profile
        for column, values in grid.numbers.items():
            if PARAMETERS[column].part != "shape" or column in shape:
                own[control.given_for(column)] = float(values.squeeze())
        # What scales a loop is 1 unless it is given.
        needed = own["load"].scaled_by if isinstance(own["load"], Definition) else ()
        if is_plane(contact.profile):
            # In the plane it is always a force, also where the normal load rests along a loop.
            needed = (*needed, "normal_force_amplitude")
            own.setdefault("normal_force_amplitude", own.pop("normal_amplitude", 0.0))
        if own["criterion"] == SWT:
            own.pop("normal_sensitivity", None)  # of others along the axis of the criterion
        else:
            needed = (*needed, "normal_sensitivity")
        return {
            name: own[name]
            for name, row in PARAMETERS.items()
            if name in own and (name in needed or not row.goes_without_saying(own[name]))
        }

    def _grid_of(self, body: int) -> PhysicalGrid:
        """The grid of one body."""
        fixed = {name: value for name, value in self.grid.fixed.items() if name != "body"}
        return replace(self.grid, fixed=fixed, axes={**self.grid.axes, "body": (float(body),)})

    def _body(self, body: int | str) -> int:
        """The label of a body, 1 or 2, from that or its name."""
        return checked_body(body, names=self.grid.body_names)

    def _measured(self, body: int | str) -> Measured:
        """The scales of one body of one contact."""
        criterion = str(self.grid.values("criterion")[0])
        return Measured(self._one, self._body(body) - 1, self.grid.labels, criterion)

    def _headlines(self, body: int | str, at_rest: bool = False) -> tuple[str, tuple[str, ...]]:
        """The facts given of one body, with units, and where the model does not hold unless it is at rest."""
        body = self._body(body)
        grid = replace(self._grid_of(body), materials=(), shear_materials=(), blocks=())
        asked = Request((YIELD,) if grid.yield_strengths else ())
        validity = () if at_rest else validity_lines(solve_grid(grid, DEFAULT_RTOL, asked))
        return headline(self.grid, body, at_rest), validity

    @contextmanager
    def _in_equilibrium(self, body: int | str) -> Iterator[None]:
        """Say in the units of the contact that it has no equilibrium, if that is why a cycle is refused."""
        try:
            yield
        except StudyError as error:
            lost = [line for line in self._headlines(body)[1] if line.startswith("no equilibrium")]
            if not lost:
                raise
            raise StudyError(replace(mistake, found=lost[0]) for mistake in error.mistakes) from None

    def stress_field(self, x: Any, y: Any, z: Any, *, body: int | str = 1, time: object = None) -> xr.Dataset:
        """`swtstudy.stress_field` of one contact: at lengths, stresses in the unit of stress, in one body."""
        from swtstudy.fields.stress import stress_field

        own = self._measured(body)
        places = own.places(x=x, y=y, z=z)
        with self._in_equilibrium(body):
            field = stress_field(**places, time=time, **self.parameters(body))
        return own.with_units(field)

    def swt_field(self, x: Any, y: Any, z: Any, *, body: int | str = 1) -> xr.Dataset:
        """`swtstudy.swt_field` of one contact: at lengths, SWT in the unit of stress, in one body.

        By a criterion of shear FS, a strain, or findley_stress.
        """
        from swtstudy.fields.stress import swt_field

        own = self._measured(body)
        places = own.places(x=x, y=y, z=z)
        with self._in_equilibrium(body):
            field = swt_field(**places, **self.parameters(body))
        return own.with_units(field, {"s_local": KINDS[own.criterion].name})

    def inspect_point(self, body: int | str = 1) -> xr.Dataset:
        """`swtstudy.inspect_point` of one contact, in lengths, forces and stresses, of one body."""
        from swtstudy.fields.inspection import inspect_point

        with self._in_equilibrium(body):
            return self._measured(body).with_units(inspect_point(**self.parameters(body)))

    def inspect(self, body: int | str = 1, style: Style | None = None, width: Width | None = None) -> Figure:
        """`swtstudy.inspect` of one contact, in lengths, forces and stresses, of one body."""
        from swtstudy.fields.inspection import inspect_point
        from swtstudy.figures.inspection import draw_inspection

        labels, headlines = self._measured(body).labels(), self._headlines(body)
        with self._in_equilibrium(body):
            return draw_inspection(inspect_point(**self.parameters(body)), style, width, labels, headlines)

    def draw_profile(self, style: Style | None = None, width: Width | None = None) -> Figure:
        """`swtstudy.draw_profile` of the profile of one contact at its mean load, in lengths and stresses."""
        from swtstudy.figures.profile import draw_shape

        shape = {n: value for n, value in self.parameters().items() if PARAMETERS[n].part == "shape"}
        given, _ = self._headlines(1, at_rest=True)
        return draw_shape(shape, style, width, self._measured(1).labels(), given)
