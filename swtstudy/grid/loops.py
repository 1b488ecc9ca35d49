"""The loops of a grid: that their amplitudes are known, and that what is prescribed suits them."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from swtstudy.grid.grid import Grid
from swtstudy.grid.values import Value
from swtstudy.mistakes import Report, literal
from swtstudy.named import Named
from swtstudy.parameters import HARMONIC, PAIRS


def check_amplitudes(
    fixed: Mapping[str, Value],
    axes: Mapping[str, tuple[Value, ...]],
    keys: Callable[[str], str],
    report: Report,
) -> None:
    """An amplitude that is not given is 1 for a loop, and that of Table 1 for two oscillations."""
    loads = axes.get("load", (fixed.get("load", HARMONIC),))
    if len({isinstance(load, Named) for load in loads}) < 2:
        return
    given = {*fixed, *axes}
    for force, name in PAIRS.items():
        if not {force, name} & given:
            allowed = "a value: it scales the loops, and is the amplitude of the harmonic load"
            report(keys(name), "nothing", allowed)


def check_loops(grid: Grid, keys: Callable[[str], str], report: Report) -> None:
    """With a force and a displacement the straight sides of a loop are curved in the memory diagram.

    Nor has a loop a frequency with which a bulk stress could oscillate.
    """
    _check_bulk_stress(grid, keys, report)
    if not grid.control.mixed or not any(grid.values(grid.control.given_for("normal_amplitude"))):
        return
    from swtstudy.mechanics.load.loop import Loop

    moving = [load for load in grid.values("load") if isinstance(load, Loop) and not load.is_steady]
    if moving:
        names = ", ".join(literal(load.name) for load in moving)
        found = f"{names} with a normal load that is not constant, and {grid.control.name}"
        report(keys("load"), found, "two displacements or two forces")


def _check_bulk_stress(grid: Grid, keys: Callable[[str], str], report: Report) -> None:
    loops = [load for load in grid.values("load") if not isinstance(load, str)]
    oscillating = [value for value in grid.values("bulk_stress_amplitude") if value != 0.0]
    if loops and oscillating:
        found = f"{literal(oscillating[0])} with a loop, which has no frequency"
        report(
            keys("bulk_stress_amplitude"), found, "0, or the load harmonic; bulk_stress_mean goes with both"
        )
