"""Loads with units: loops that were measured as such, the mean of a bulk stress by its ratio, plane contacts.

A loop that was measured lacks what the parameters of a contact say otherwise. The loads of plane contacts are
per length, unless their length is given.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass
from typing import Any

from swtstudy.loads.load_path import LoadPath
from swtstudy.loads.loop import Loop
from swtstudy.points.values import Value
from swtstudy.units.labels import Units
from swtstudy.units.rows import MEAN_LOADS
from swtstudy.vocabulary.choices import is_plane
from swtstudy.vocabulary.mistakes import Report
from swtstudy.vocabulary.parameters import LOOP_AMPLITUDE, NORMAL_AMPLITUDES

#: Loads that stand for wrong ones: one in shares of the mean load, and one that was measured.
ANY = LoadPath("any", [[0.0, 0.0], [0.0, 1.0]])
ANY_MEASURED = LoadPath("any", ANY.vertices, 1.0)


def are_measured(loads: Sequence[Value]) -> bool:
    """Return whether there are loads, of which each is a loop that knows its mean normal load."""
    known = [isinstance(load, Loop) and load.mean_normal is not None for load in loads]
    return bool(known) and all(known)


def mean_of_loads(given: Collection[str], loads: Sequence[Value]) -> str | None:
    """Which of `MEAN_LOADS` each load has the mean of; None where the load at rest is given by itself."""
    if {*MEAN_LOADS} & {*given} or not are_measured(loads):
        return None
    return "depth" if "normal_amplitude" in given else "normal_force"


def measured_amplitudes(given: Collection[str], loads: Sequence[Value]) -> dict[str, float]:
    """Factors of the columns of measured loads, unless they are given: the columns are loads themselves.

    Forces, if not told otherwise; beside a depth also a displacement.
    """
    found: dict[str, float] = {}
    if not are_measured(loads):
        return found
    if NORMAL_AMPLITUDES.isdisjoint(given):
        found["normal_force_amplitude"] = LOOP_AMPLITUDE
    if not {"tangential_amplitude", "tangential_force_amplitude"} & {*given}:
        kind = "" if "normal_amplitude" in given else "force_"
        found[f"tangential_{kind}amplitude"] = LOOP_AMPLITUDE
    return found


def ends_of_bulk(load: object) -> tuple[float, float]:
    """Least and largest value of what the amplitude of the bulk stress scales."""
    if isinstance(load, Loop):
        return load.bulk_ends or (0.0, 0.0)
    return -1.0, 1.0


def mean_of_bulk(ratio: Any, amplitude: Any, least: Any, largest: Any) -> Any:
    """The mean at which a bulk stress between these `ends_of_bulk` has a ratio of least over largest."""
    return amplitude * (ratio * largest - least) / (1.0 - ratio)


#: The length of a plane contact along its axis.
LENGTH = "contact_length"


@dataclass(frozen=True)
class LineUnits(Units):
    """Labels where forces, and work, are per length."""

    def label(self, kind: str) -> str:
        if kind == "force" and self.force:
            return f"{self.force}/{self.length}"
        return self.force if kind == "work" else super().label(kind)


def labels_of(units: Units, profiles: Iterable[object], given: Collection[str]) -> Units:
    """The labels of a study with these profiles, in which parameters of some names are given."""
    if LENGTH in given or not any(map(is_plane, profiles)):
        return units
    return LineUnits(**vars(units))


def check_lengths(profiles: Iterable[object], given: Collection[str], report: Report) -> None:
    """A depth of plane contacts, a length where none has one, and none where loads need it."""
    plane = [is_plane(profile) for profile in profiles]
    if any(plane) and "depth" in given:
        why = "a plane contact has no depth, only a load"
        report.of("depth", "a depth with a plane profile", f"normal_force: {why}")
    if LENGTH in given and not any(plane):
        report.of(LENGTH, "a length without a plane profile", "only with profiles such as cylinder")
    if any(plane) and not all(plane) and LENGTH not in given:
        allowed = "the length of the plane contacts: beside axisymmetric ones their loads are forces"
        report.of(LENGTH, "nothing", allowed)


def still_load(profiles: Iterable[object], given: Collection[str]) -> dict[str, float]:
    """A constant normal load of plane contacts, unless something is said of it."""
    silent = NORMAL_AMPLITUDES.isdisjoint(given)
    return {"normal_force_amplitude": 0.0} if silent and any(map(is_plane, profiles)) else {}
