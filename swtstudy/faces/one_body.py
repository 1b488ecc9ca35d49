"""One body of one real contact: its parameters without units, and what is found with them, in its units."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cached_property
from typing import Any

import xarray as xr

from swtstudy.figures.words import Label
from swtstudy.points.solve import solve_grid
from swtstudy.points.validity import validity_lines
from swtstudy.study.units import rows as units
from swtstudy.study.units.at_rest import Contact
from swtstudy.study.units.grid import PhysicalGrid, are_measured
from swtstudy.study.units.results import scale_of
from swtstudy.vocabulary.choices import CRITERIA, SWT, family_of, is_plane
from swtstudy.vocabulary.definition import Definition
from swtstudy.vocabulary.mistakes import DEFAULT_RTOL, StudyError, refused
from swtstudy.vocabulary.parameters import LOOP_AMPLITUDE, PARAMETERS, SHIFT
from swtstudy.vocabulary.wording import place_words


def one_contact(grid: PhysicalGrid) -> Contact:
    """The contact at rest of a grid; a StudyError if there are several."""
    several = [name for name in grid.dims if name != "body"]
    if several:
        raise refused(", ".join(several), "several contacts", "one: a single value of each")
    contact: Contact = grid.at_rest.values.item()
    return contact


def given_values(grid: PhysicalGrid) -> dict[str, tuple[Any, ...]]:
    """The values of what is given of contacts, but for what goes without saying."""
    loads = grid.values("load")
    values = {name: grid.pairs.get(name) or grid.values(name) for name in grid.rows if name != "body"}
    unsaid = ["frequency_ratio", "phase"] if all(isinstance(load, Definition) for load in loads) else []
    if are_measured(loads):
        # Its amplitudes are factors of what was measured.
        factors = [name for name in values if grid.row(name).part in ("load", "bulk")]
        unsaid += [name for name in factors if {*values[name]} == {LOOP_AMPLITUDE}]
    return {
        name: each
        for name, each in values.items()
        if each and name not in unsaid and not all(map(grid.row(name).goes_without_saying, each))
    }


class OneBody:
    """One body of one real contact.

    Parameters
    ----------
    grid
        The contact, with any bodies.
    body
        1 or 2, or its name.

    Raises
    ------
    StudyError
        If there are several contacts, or no such body.
    """

    def __init__(self, grid: PhysicalGrid, body: int | str) -> None:
        self.contact = one_contact(grid)
        self.body = units.checked_body(body, names=grid.body_names)
        fixed = {name: value for name, value in grid.fixed.items() if name != "body"}
        self.grid = replace(grid, fixed=fixed, axes={**grid.axes, "body": (float(self.body),)})
        self.criterion = str(grid.values("criterion")[0])

    @property
    def parameters(self) -> dict[str, Any]:
        """The non-dimensional parameters, without those that go without saying."""
        grid, control, shape = self.grid, self.grid.control, family_of(self.contact.profile).shape
        names = ("frequency_ratio", "load", "criterion", SHIFT)
        own: dict[str, Any] = {name: grid.values(name)[0] for name in names}
        own["profile"] = self.contact.pure_profile
        for column, values in grid.numbers.items():
            if PARAMETERS[column].part != "shape" or column in shape:
                own[control.given_for(column)] = float(values.squeeze())
        # The scale of a loop is 1 unless it is given.
        needed = own["load"].scaled_by if isinstance(own["load"], Definition) else ()
        if is_plane(self.contact.profile):
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

    @cached_property
    def labels(self) -> dict[str, Label]:
        """By name of a variable what its numbers are in the units of the contact."""
        contact, words, index = self.contact, self.grid.labels.words, self.body - 1
        measured, row = units.TABLES["measured"].items(), CRITERIA[self.criterion]
        found = {n: Label(getattr(contact, by), symbol, words(kind)) for n, (by, kind, symbol) in measured}
        strain = contact.depth / contact.length_scale * contact.moduli.swt_share(index)
        found["normal_strain"] = Label(strain, r"\varepsilon_n", "1")
        found["s_local"] = Label(scale_of(row.scale)(contact, index), row.sign, words(row.unit))
        return found

    @property
    def validity(self) -> tuple[str, ...]:
        """Lines that say where the model does not hold."""
        grid = replace(self.grid, materials=(), shear_materials=(), blocks=())
        return validity_lines(solve_grid(grid, DEFAULT_RTOL, grid.request(())))

    def words(self, at_rest: bool = False) -> str:
        """The facts given of the body, with units; only those of the contact at rest if that is asked for."""
        grid, words = self.grid, {}
        for name, values in {"profile": grid.values("profile"), **given_values(grid)}.items():
            row = grid.row(name)
            of_other = row.part == "bulk" and self.body != grid.bulk_stress_body + 1
            if not of_other and (name in units.REST_DEPENDS_ON or not at_rest):
                value = values[self.body - 1 if name in grid.pairs else 0]
                value = str(value) if row.kind == "name" else value
                words[name] = place_words(name, value, {"symbol": row.symbol, "units": row.units})
        if grid.body_names and not at_rest:
            words["body"] = grid.body_names[self.body - 1]
        return ",  ".join(words.values())

    def found(self, function: Callable[..., xr.Dataset], **given: Any) -> xr.Dataset:
        """The non-dimensional results of a function of the parameters.

        Raises
        ------
        StudyError
            As of the function; that there is no equilibrium is said in the units of the contact.
        """
        try:
            return function(**given, **self.parameters)
        except StudyError as error:
            lost = [line for line in self.validity if line.startswith("no equilibrium")]
            if not lost:
                raise
            raise StudyError(replace(mistake, found=lost[0]) for mistake in error.mistakes) from None

    def with_units(self, dataset: xr.Dataset) -> xr.Dataset:
        """Non-dimensional results of the body in lengths, forces and stresses."""
        dataset, grid = dataset.copy(), self.grid
        labels = {name: each for name, each in self.labels.items() if name in dataset.variables}
        for name in (name for name, row in PARAMETERS.items() if row.scale and name in dataset.coords):
            by = units.SCALES[PARAMETERS[name].scale]
            labels[name] = Label(by.of(self.contact), grid.row(name).symbol, grid.labels.words(by.kind))
        for name, (scale, symbol, unit) in labels.items():
            old, own = dataset[name], {"symbol": symbol, "units": unit}
            if name in self.labels:
                words = str(old.attrs.get("long_name", name))
                own["long_name"] = words.partition(", in units of")[0].partition(" over E*")[0]
            dataset[name] = old.dims, old.values * scale, {**old.attrs, **own}
        return dataset
