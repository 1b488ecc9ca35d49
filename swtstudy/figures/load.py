"""A load of a study by itself: its course, its path, and how near friction comes to its end."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure

from swtstudy.figures.sheet import Sheet, Width, wrap_texts
from swtstudy.figures.style import Style, stroke, styled
from swtstudy.loads.loop import Loop
from swtstudy.points.values import as_number
from swtstudy.vocabulary.arrays import FloatArray
from swtstudy.vocabulary.mistakes import literal, nearest, refused
from swtstudy.vocabulary.parameters import Control
from swtstudy.vocabulary.wording import as_text

if TYPE_CHECKING:
    from swtstudy.study.definition import Study
    from swtstudy.study.signal import Signal


def draw_load(
    study: Study,
    name: str,
    signal: Signal | None = None,
    *,
    style: Style | None = None,
    width: Width | None = None,
) -> Figure:
    """A picture of a loop of a study: both loads and the bulk stress over a cycle, the path, the friction.

    Parameters
    ----------
    study
        The study; other parameters that vary have their first values.
    name
        Name of the loop.
    signal
        The record of the loop, whose cycles are drawn beneath.
    style, width
        As for `swtstudy.accessor.SwtAccessor.figure`.

    Returns
    -------
    matplotlib.figure.Figure
        The loads as the contact has them, in the units of the study, and where both are forces the friction
        margin ``|Q|/(μP)``, which must not exceed 1.

    Raises
    ------
    StudyError
        A ValueError, if the study has no such loop.
    """
    loops = {str(load): load for load in study.grid.loops}
    if name not in loops:
        raise refused("load", literal(name), nearest(name, loops, {}) if loops else "a loop")
    grid = study.grid
    # Loads are drawn as forces or displacements; one that rests is what its mean is given as.
    moves = any(map(as_number, grid.values(grid.control.given_for("normal_amplitude"))))
    rests_as_force = not moves and bool(grid.values("normal_force"))
    control = replace(grid.control, normal_force=True) if rests_as_force else grid.control
    names = (control.given_for("normal_amplitude"), control.given_for("tangential_amplitude"))
    labels = (grid.row(each).units for each in (*names, "bulk_stress_amplitude"))
    units = ["" if label in ("", "1") else f" ({as_text(label)})" for label in labels]
    loads = _loads(study, loops[name], "normal_force" if control.normal_force else "depth")
    record = signal if signal is not None and signal.is_absolute else None
    if record is not None:
        # A polygon begins at another vertex than its record: it is turned to the begin of a mean cycle.
        span = np.ptp(loads, axis=0)
        distance = (loads[:-1] - record.mean_cycle[0]) / np.where(span > 0.0, span, 1.0)
        rolled = np.roll(loads[:-1], -int((distance**2).sum(axis=1).argmin()), axis=0)
        loads = np.concatenate([rolled, rolled[:1]])
    phase, forces = np.linspace(0.0, 1.0, len(loads)), control == Control(True, True)
    # Tangential over normal load where friction ends: μ; 1 where loads are over μ F0 and F0.
    slope = _first(study, "friction", 1.0) if any(units) else 1.0
    with styled(style, width):
        sheet = Sheet(1, 3 if forces else 2, width)
        figure = sheet.figure()
        course, path, *margin = sheet.panels(figure, share_x="none", share_y="none")[0]
        for column, cycles in enumerate([] if record is None else np.moveaxis(record.cycles, 2, 0)):
            share = np.arange(cycles.shape[1]) / cycles.shape[1]
            course.plot(share, cycles.T, **stroke(f"C{column}", linewidth=0.5, alpha=0.25))
        for column, each in enumerate(("normal", "tangential", "bulk stress")[: loads.shape[1]]):
            course.plot(phase, loads[:, column], **stroke(f"C{column}", label=each + units[column]))
        course.set(xlabel="share of a cycle", ylabel="loads")
        course.set_title("course", loc="left")
        course.legend(frameon=False)
        path.plot(loads[:, 0], loads[:, 1], **stroke("C0"))
        path.set(xlabel=f"normal load{units[0]}", ylabel=f"tangential load{units[1]}")
        path.set_title("path", loc="left")
        if forces:
            ends = np.array([0.0, 1.05 * loads[:, 0].max()])
            for sign in (1.0, -1.0):
                path.plot(ends, sign * slope * ends, **stroke("0.5", "--", linewidth=0.8))
            with np.errstate(divide="ignore", invalid="ignore"):
                share = np.abs(loads[:, 1]) / (slope * loads[:, 0])
            margin[0].plot(phase, share, **stroke("C3"))
            margin[0].axhline(1.0, color="0.5", lw=0.8, ls="--")
            margin[0].set(xlabel="share of a cycle", ylabel="$|Q|/(\\mu P)$")
            which = f" at $\\mu$ = {slope:g}" * any(units)
            margin[0].set_title(f"friction, at most {np.nanmax(share):.2f}{which}", loc="left")
        figure.suptitle(as_text(f"{name}: {signal.words}" if signal else name))
        wrap_texts(figure)
    return figure


def _first(study: Study, name: str, otherwise: float) -> float:
    values = study.grid.values(name)
    return as_number(values[0]) if values else otherwise


def _loads(study: Study, loop: Loop, mean_name: str) -> FloatArray:
    """Both loads and the bulk stress over a cycle, the first instant again at the end, shape (k, 2 or 3)."""
    grid, course = study.grid, loop.course()
    # The mean normal load that a study has with a loop; 1 where nothing has units.
    means = grid.values(mean_name)
    along = len(means) > 1 and grid.dimension(mean_name) == "load"
    mean = as_number(means[list(grid.values("load")).index(loop) if along else 0]) if means else 1.0
    names = [grid.control.given_for(f"{each}_amplitude") for each in ("normal", "tangential")]
    factors = [_first(study, each, 1.0) for each in (*names, "bulk_stress_amplitude")]
    shift = np.array([mean, 0.0, _first(study, "bulk_stress_mean", 0.0)])
    columns = 2 if loop.bulk_ends is None else 3
    return np.asarray(shift[:columns] + np.array(factors)[:columns] * course[:, :columns])
