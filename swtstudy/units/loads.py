"""Loops that were measured as loads: what a contact then lacks; the mean of a bulk stress from its ratio."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from typing import Any

from swtstudy.mechanics.load.load_path import LoadPath
from swtstudy.mechanics.load.loop import Loop
from swtstudy.points.values import Value
from swtstudy.units.rows import MEAN_LOADS
from swtstudy.vocabulary.parameters import LOOP_AMPLITUDE

#: A load that stands for one that is wrong.
ANY = LoadPath("any", [[0.0, 0.0], [0.0, 1.0]], 1.0)


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
    if not {"normal_amplitude", "normal_force_amplitude"} & {*given}:
        found["normal_force_amplitude"] = LOOP_AMPLITUDE
    if not {"tangential_amplitude", "tangential_force_amplitude"} & {*given}:
        kind = "" if "normal_amplitude" in given else "force_"
        found[f"tangential_{kind}amplitude"] = LOOP_AMPLITUDE
    return found


def ends_of_bulk(load: object) -> tuple[float, float]:
    """Least and largest value of what the amplitude of the bulk stress scales."""
    if isinstance(load, Loop):
        return (0.0, 0.0) if load.bulk is None else load.bulk.ends
    return -1.0, 1.0


def mean_of_bulk(ratio: Any, amplitude: Any, least: Any, largest: Any) -> Any:
    """The mean at which a bulk stress between these `ends_of_bulk` has a ratio of least over largest."""
    return amplitude * (ratio * largest - least) / (1.0 - ratio)
