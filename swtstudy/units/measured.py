"""One contact in words, and its fields in lengths, forces and stresses."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from swtstudy.points.labelled import margins
from swtstudy.units.at_rest import Contact
from swtstudy.units.grid import PhysicalGrid, are_measured
from swtstudy.units.results import scale_of
from swtstudy.units.rows import REST_DEPENDS_ON, SCALES, UNIT_KINDS, Units, rows
from swtstudy.vocabulary.choices import CRITERIA, SWT
from swtstudy.vocabulary.definition import Definition
from swtstudy.vocabulary.parameters import LOOP_AMPLITUDE, PARAMETERS
from swtstudy.vocabulary.variables import ATTRIBUTES
from swtstudy.vocabulary.wording import place_words, plain_words

if TYPE_CHECKING:
    import xarray as xr

#: Sizes of a contact at rest, and scales of everything else.
_AT_REST = {
    "depth": "mean indentation depth δ0",
    "normal_force": "normal force F0",
    "contact_radius": "contact radius",
    "peak_pressure": "largest pressure",
    "length_scale": "a_H",
    "slip_scale": "μ E* δ0/G*, at which the whole contact slides",
    "stress_scale": "E* δ0/a_H",
}


def given_of(grid: PhysicalGrid) -> dict[str, tuple[Any, ...]]:
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


def headline(grid: PhysicalGrid, body: int, at_rest: bool) -> str:
    """List what is given of one contact with symbols and units: of one of its bodies, or of it at rest."""
    words = {}
    for name, values in {"profile": grid.values("profile"), **given_of(grid)}.items():
        row = grid.row(name)
        of_other = row.part == "bulk" and body != grid.bulk_stress_body + 1
        if not of_other and (name in REST_DEPENDS_ON or not at_rest):
            value: Any = values[body - 1 if name in grid.pairs else 0]
            value = str(value) if row.kind == "name" else value
            words[name] = place_words(name, value, {"symbol": row.symbol, "units": row.units})
    if grid.body_names and not at_rest:
        words["body"] = grid.body_names[body - 1]
    return ",  ".join(words.values())


def words_of(grid: PhysicalGrid, parameters: Mapping[str, Any]) -> Iterator[tuple[str, str, str, str]]:
    """Kind, name, value and meaning of all that is known of contacts without solving.

    Parameters
    ----------
    grid
        The contacts.
    parameters
        The parameters without units of a single one, to be said, too.
    """
    table = rows(Units(*(f"the unit of {kind}" for kind in UNIT_KINDS)))
    for name, each in given_of(grid).items():
        if name not in _AT_REST:
            yield "given", name, ", ".join(map(plain_words, each)), table[name].meaning
    for name, meaning in _AT_REST.items():
        found = np.unique(grid.each(lambda contact, name=name: getattr(contact, name)))  # type: ignore[misc]
        ends = dict.fromkeys(found[[0, -1]].tolist())
        yield "at rest", name, " to ".join(map(plain_words, ends)), meaning
    # How far the contacts are from where the model ends, as far as that is known without solving.
    for name, values in margins(grid).items():
        if name not in ("stick_zone", "bulk_shift") and np.isfinite(values).any():
            largest = plain_words(float(np.nanmax(values)))
            yield "margin", name, f"up to {largest}", ATTRIBUTES[name]["comment"]
    for name, value in parameters.items():
        if PARAMETERS[name].scale:
            yield "without units", name, plain_words(value), PARAMETERS[name].notation


#: Data variables and coordinates by what they are measured in, and the symbols that they have with a unit.
_LENGTHS = {
    **{"x": "x", "y": "y", "z": "z", "r": "r", "shown_x": "x", "critical_x": "x", "contact_radius": "a"},
    **{"slip_radius": "c", "permanent_stick_radius": "c", "least_radius": "a", "largest_radius": "a"},
    **dict.fromkeys(("stick_left", "stick_right", "stick_centre"), "x"),
}
_STRESSES = {
    **{f"sigma_{name}": rf"\sigma_{{{name}}}" for name in ("xx", "yy", "zz", "yz", "xz", "xy")},
    **{"normal_stress": r"\sigma_n", "bulk_stress": r"\sigma_B", "pressure": "p", "traction": "q"},
    "shear_stress": r"\tau",
}


class Measured(NamedTuple):
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
        The criterion of s.
    """

    contact: Contact
    body: int
    units: Units
    criterion: str = SWT

    def scales(self) -> dict[str, tuple[float, str, str]]:
        """By name of a variable the scale, the label of its unit, and its symbol."""
        contact, row = self.contact, CRITERIA[self.criterion]
        length, stress = contact.length_scale, contact.stress_scale
        found = {name: (length, "length", symbol) for name, symbol in _LENGTHS.items()}
        found |= {name: (stress, "stress", symbol) for name, symbol in _STRESSES.items()}
        found |= {
            "depth": (contact.depth, "length", r"\delta"),
            "displacement": (contact.slip_scale, "length", "u"),
            "normal_force": (contact.normal_force, "force", "F_N"),
            "tangential_force": (contact.friction * contact.normal_force, "force", "F_x"),
            "height": (contact.depth, "length", "-z"),
            "spring_depth": (contact.depth, "length", "g"),
            "normal_strain": (
                contact.depth / length * contact.moduli.swt_share(self.body),
                "1",
                r"\varepsilon_n",
            ),
            "s_local": (scale_of(row.scale)(contact, self.body), row.unit, row.sign),
            "dissipation": (contact.work_scale, "work", "W"),
            "dissipation_error": (contact.work_scale, "work", r"\Delta W"),
        }
        unit = {kind: self.units.label(kind) or f"unit of {kind}" for kind in (*UNIT_KINDS, "work")}
        return {name: (scale, unit.get(kind, kind), symbol) for name, (scale, kind, symbol) in found.items()}

    def with_units(self, dataset: xr.Dataset, names: Mapping[str, str] | None = None) -> xr.Dataset:
        """The same in lengths, forces and stresses; some under other names."""
        dataset, scales = dataset.copy(), {}
        for name, (scale, unit, symbol) in self.scales().items():
            if name in dataset.variables:
                words = str(dataset[name].attrs.get("long_name", name))
                words = words.partition(", in units of")[0].partition(" over E*")[0]
                scales[name] = scale, {"long_name": words, "symbol": symbol, "units": unit}
        for name, row in rows(self.units).items():
            by = PARAMETERS[name].scale if name in PARAMETERS else ""
            if by and name in dataset.coords:
                unit = row.units or f"unit of {SCALES[by].kind}"
                scales[name] = SCALES[by].of(self.contact), {"symbol": row.symbol, "units": unit}
        for name, (scale, own) in scales.items():
            attributes = {**dataset[name].attrs, **own}
            dataset[name] = dataset[name].variable * scale
            dataset[name].attrs = attributes
        return dataset.rename({old: new for old, new in (names or {}).items() if old in dataset})
