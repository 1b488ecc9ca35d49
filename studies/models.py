"""Error of s against processor time for a ladder of models: which step matters in which scene?

Random points of three boxes are solved by each model, and compared with the largest SWT of the whole body.
Run from the project's folder: ``python studies/models.py``. It writes models.md and models.png into
``--results``.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from numpy.typing import NDArray

from swtstudy.figures.sheet import WIDTHS, new_figure, place_legend
from swtstudy.figures.style import save_figure, stroke, styled
from swtstudy.kernel.batch import chunks
from swtstudy.kernel.compiled import jit, new_record, new_records
from swtstudy.kernel.contact import solve_cycle
from swtstudy.kernel.course import STATE, write_states, write_stress
from swtstudy.kernel.criterion import lifted, swing_weights, value_of
from swtstudy.kernel.cusps import cusps
from swtstudy.kernel.dense import highest_on_planes
from swtstudy.kernel.growth import lay_out
from swtstudy.kernel.line import SEARCH
from swtstudy.kernel.planes import extremes, fill
from swtstudy.kernel.point import OF_POINT, RESULT, solve_points
from swtstudy.kernel.profile import place_of
from swtstudy.kernel.records import Point
from swtstudy.kernel.shift import shift_of
from swtstudy.kernel.work import CONJUGATE
from swtstudy.paper.maxima import body_maximum
from swtstudy.solver.means import worst_means
from swtstudy.solver.points import Points, arguments_of
from swtstudy.solver.points import solve_points as solve
from swtstudy.vocabulary.parameters import Control

Array = NDArray[np.float64]
Model = Callable[[Points], Array]
#: A box: batches of points.
Draw = Callable[[np.random.Generator, int], list[Points]]

SEED, POINTS = 64, 200
#: Relative accuracy of s, and ℓ/a_H of the nonlocal mean.
RTOL, DISTANCE = 1e-4, 0.05
#: Errors below this are drawn here.
SMALLEST = 1e-5
#: Search on grids: places on each smooth piece of the line, planes, local maxima that get closer grids, the
#: number of closer grids, and how each narrows.
STEPS, PLANES, SUMMITS, CLOSER, NARROWER = 6, 32, 4, 5, 0.25
FORCES = Control(True, True)


def _common(rng: np.random.Generator, count: int) -> tuple[Array, Array, Array]:
    """Poisson's ratio, friction and phase."""
    return rng.uniform(0.0, 0.5, count), rng.uniform(0.05, 1.0, count), rng.uniform(0.0, 2.0 * np.pi, count)


def paper(rng: np.random.Generator, count: int) -> list[Points]:
    """Paraboloid, two oscillations: displacements for half of the points, forces for the others."""
    drawn = []
    for forces in (False, True):
        n = -(-count // 2)
        ν, μ, ψ = _common(rng, n)
        normal = rng.uniform(0.0, 0.95, n)
        tangential = rng.uniform(0.05, 0.95, n) * (1.0 - normal) if forces else rng.uniform(0.05, 1.2, n)
        p, q = rng.integers(1, 6, (2, n))
        gcd = np.gcd(p, q)
        own = {"control": FORCES} if forces else {}
        drawn.append(Points("paraboloid", ν, μ, normal, p // gcd, q // gcd, tangential, ψ, **own))
    return drawn


def constant_load(rng: np.random.Generator, count: int) -> list[Points]:
    """Cylinder and sphere under a constant normal force; a bulk stress in phase moves the stick zone."""
    drawn = []
    for profile, pressure in (("cylinder", 0.5), ("paraboloid", 2.0 / np.pi)):
        n = -(-count // 2)
        ν, μ = rng.uniform(0.25, 0.35, n), rng.uniform(0.3, 1.0, n)
        force = rng.uniform(0.1, 0.9, n)
        points = _rig(profile, ν, μ, np.zeros(n), force, np.zeros(n))
        size, per_bulk = _stick(points), _shift_per_bulk(points)
        amplitude = rng.uniform(0.02, 0.95, n) * (1.0 - size) / per_bulk
        ratio = rng.uniform(-1.0, 0.5, n)
        mean = amplitude * (1.0 + ratio) / (1.0 - ratio)
        # Beyond some times the contact's pressure no specimen lasts.
        share = np.minimum(1.0, 2.0 * pressure / (amplitude + mean))
        bulk = {"bulk_stress_amplitude": share * amplitude, "bulk_stress_mean": share * mean}
        drawn.append(replace(points, **bulk))
    return drawn


def varying_load(rng: np.random.Generator, count: int) -> list[Points]:
    """The same rigs with a normal force that varies by 2 to 20 %; the stick zone is not moved."""
    drawn = []
    for points in constant_load(rng, count):
        n = len(points)
        normal, phase = rng.uniform(0.02, 0.2, n), rng.uniform(0.0, 2.0 * np.pi, n)
        force = points.tangential_amplitude * (1.0 - normal)
        own = {"normal_amplitude": normal, "tangential_amplitude": force, "phase": phase}
        drawn.append(replace(points, **own, bulk_strain_share=np.zeros(n)))
    return drawn


def _rig(profile: str, ν: Array, μ: Array, normal: Array, force: Array, phase: Array) -> Points:
    one = np.ones(len(ν), dtype=np.int64)
    return Points(profile, ν, μ, normal, one, one, force, phase, control=FORCES)


def _stick(points: Points) -> Array:
    """Radius of the stick zone under a constant normal force, over the contact radius."""
    power = 0.5 if points.profile == "cylinder" else 1.0 / 3.0
    return np.asarray((1.0 - points.tangential_amplitude) ** power)


def _shift_per_bulk(points: Points) -> Array:
    """Shift of the stick zone, over the contact radius, by a bulk stress of 1."""
    ν, μ = points.poisson_ratio, points.friction
    if points.profile == "cylinder":
        return np.asarray(1.0 / (2.0 * μ))
    return np.asarray(2.0 / (μ * (1.0 + ν) * (4.0 - 3.0 * ν)))


def closed_form(points: Points, largest: bool = False) -> Array:
    """Cattaneo and Mindlin's contact: constant normal load, stress at the edge, plane normal along x.

    The stress there under the full tangential load, forwards and backwards, is Hertz's with the traction of
    full slip minus the traction of the stick zone. A bulk stress is added, and moves the stick zone.

    Parameters
    ----------
    points
        Points; their normal load is held at its mean.
    largest
        Whether it is held at its maximum instead.
    """
    ν, μ = points.poisson_ratio, points.friction
    load = 1.0 + points.normal_amplitude if largest else np.ones(len(points))
    share = np.minimum(points.tangential_amplitude / load, 1.0)
    bulk, mean = points.bulk_stress_amplitude, points.bulk_stress_mean
    if points.profile == "cylinder":
        a = np.sqrt(load)
        stick, shift = a * np.sqrt(1.0 - share), points.bulk_strain_share * bulk / (2.0 * μ)
        # A traction μ p0 √(1 - x²/c²) has 2 μ p0 (|x| - √(x² - c²))/c outside of c; p0 = a/2.
        stick = np.where(shift + stick < a, stick, a)
        edge = a + shift
        tension = μ * (a - (edge - np.sqrt(edge**2 - stick**2)))
        return np.asarray((tension + bulk + mean) * (tension + bulk))
    forces = points.control.tangential_force
    depth = load ** (2.0 / 3.0) if forces else load
    a = np.sqrt(depth)
    stick = a * ((1.0 - share) ** (1.0 / 3.0) if forces else np.sqrt(1.0 - share))
    edge = a + points.bulk_strain_share * bulk * _shift_per_bulk(points)
    along, across = np.subtract(_in_plane(ν, a, 1.0), _in_plane(ν, edge, stick / edge)) * μ * 4.0 / np.pi
    pressed = (1.0 - 2.0 * ν) / 3.0 * 2.0 / np.pi * a
    tension, swing = pressed + along + bulk + mean, along + bulk - ν * across
    return np.asarray(np.maximum(tension, 0.0) * swing / (1.0 - ν**2))


def _in_plane(ν: Array, r: Array, share: Array | float) -> tuple[Array, Array]:
    """σ_xx and σ_yy at r of a paraboloid's full slip within the radius share · r, in 4μ/π."""
    φ = np.arcsin(share)
    i, j = 0.5 * φ - 0.25 * np.sin(2.0 * φ), 0.125 * φ - np.sin(4.0 * φ) / 32.0
    return np.asarray(r * (i + ν * j)), np.asarray(r * ν * (i - j))


#: Memory for the kernel.
_SEARCH, _ROOM, _CONJUGATE = new_record(SEARCH), tuple(map(new_record, OF_POINT)), new_record(CONJUGATE)


@jit
def highest_at_states(point, largest, places, cosines, sines, states, found):  # type: ignore[no-untyped-def]
    """`swtstudy.kernel.dense.highest_on_planes` of the states alone, instead of the whole cycle."""
    ask, history, curves = point.ask, point.history, point.curves
    for i in range(places.shape[0]):
        for side in range(2):
            sign = 1.0 - 2.0 * side
            write_stress(point, states, places[i], largest, sign)
            fill(history, curves, sign, ask)
            found[i, side, 0], found[i, side, 1] = 0.0, 0.0
            for k in range(cosines.shape[0]):
                of_b, of_c = swing_weights(ask, cosines[k], sines[k])
                top, high, low = extremes(curves, history.instants, cosines[k], sines[k], of_b, of_c)
                value = value_of(ask, lifted(ask, top, high - low, 0.0))
                if value > found[i, side, 0]:
                    found[i, side, 0], found[i, side, 1] = value, k


def on_grids(points: Points, fixed_plane: bool, extremes_alone: bool) -> Array:
    """Largest value on the line by grids that close in, with a plane or with instants left out.

    Parameters
    ----------
    points
        A batch.
    fixed_plane
        Whether there is one plane alone, with its normal along x.
    extremes_alone
        Whether the instants are the extremes of the tangential load alone, instead of the whole cycle.
    """
    return np.array([_on_grids(points[[k]], fixed_plane, extremes_alone) for k in range(len(points))])


def _on_grids(point: Points, fixed_plane: bool, extremes_alone: bool) -> float:
    _, profiles, _, loads, asks = next(chunks(**arguments_of(point), rtol=RTOL))
    load, profile, ask, cycle, growth, *_ = records = Point(loads[0], profiles[0], asks[0], *_ROOM)
    solve_cycle(cycle, load)
    cycle.shift = shift_of(load, profile, ask, cycle.event, cycle.events)
    lay_out(growth, cycle, profile, load, float(ask.growth))
    largest = float(place_of(profile, cycle.largest))
    states = None
    if extremes_alone:
        # u = u_A sin(ω2 t): two in each of the p periods of u in the common period.
        turns = 2 * int(point.p[0])
        states = new_records(turns, STATE)
        instants = np.mod((np.arange(turns) + 0.5) / turns * float(load.rounds), 1.0) * float(load.period)
        write_states(cycle, growth, profile, load, _CONJUGATE, instants, states)

    def values(places: Array, angles: Array, halved: int) -> tuple[Array, Array]:
        found = np.empty((len(places), 2, 2))
        grid = places, np.cos(angles), np.sin(angles)
        if states is None:
            highest_on_planes(records, largest, *grid, np.int64(halved), found)
        else:
            highest_at_states(records, largest, *grid, states, found)
        return found[..., 0], angles[found[..., 1].astype(np.intp)]

    ends = _SEARCH.cusp[: cusps(_SEARCH, cycle, profile, load, ask, largest)]
    ends = ends[np.append(np.diff(ends) > 1e-9 * np.ptp(ends), True)]
    share = 0.5 - 0.5 * np.cos(np.pi / STEPS * np.arange(STEPS))
    places = np.append((ends[:-1, None] + np.diff(ends)[:, None] * share).ravel(), ends[-1])
    turn = 2.0 * np.pi / PLANES
    every = np.zeros(1) if fixed_plane else turn * np.arange(PLANES)
    seen, angles = values(places, every, 1)
    best = float(seen.max())
    for index in np.argsort(-seen, axis=None)[:SUMMITS]:
        k, side = np.unravel_index(index, seen.shape)
        around, angle, width = places[[max(k - 1, 0), k, min(k + 1, len(places) - 1)]], angles[k, side], turn
        (down, up), centre = np.diff(around), around[1]
        for closer in range(CLOSER):
            own = np.unique(np.append(np.linspace(centre - down, centre + up, 9), centre))
            own = own[(own >= ends[0]) & (own <= ends[-1])]
            tried = np.zeros(1) if fixed_plane else angle + width * np.linspace(-1.0, 1.0, 9)
            near, at = values(own, tried, 2 + closer // 2)
            top = int(near[:, side].argmax())
            best, centre, angle = max(best, float(near[top, side])), own[top], at[top, side]
            down, up, width = NARROWER * down, NARROWER * up, NARROWER * width
    return best


def line(points: Points) -> Array:
    """The largest value on the line y = 0 over all planes through y: s."""
    found = np.empty(len(points))
    for rows, profiles, which, loads, asks in chunks(**arguments_of(points), rtol=RTOL):
        out = new_records(len(which), RESULT)
        solve_points(_SEARCH, _ROOM, profiles, which, loads, asks, out)
        found[rows] = out["s"]
    return found


def circle(points: Points) -> Array:
    """The largest value on the circle through the critical point over all planes: s_surface."""
    return solve(points, RTOL).s_surface


def body(points: Points) -> Array:
    """The largest value of the whole body, over all planes."""
    x = solve(points, RTOL).critical_x
    return np.array([body_maximum(points[[k]], float(x[k]))[0].swt for k in range(len(points))])


def mean(points: Points) -> Array:
    """The largest mean over a half sphere, or a half disc, about a local maximum."""
    return np.asarray(worst_means(points, solve(points, RTOL), np.array([DISTANCE]))["s_volume"][:, 0])


def without_bulk(points: Points) -> Array:
    """The line, with the bulk stress left out."""
    none = np.zeros(len(points))
    return line(replace(points, bulk_stress_amplitude=none, bulk_stress_mean=none))


def in_place(points: Points) -> Array:
    """The line, with a stick zone that the bulk stress does not move."""
    return line(replace(points, bulk_strain_share=np.zeros(len(points))))


MODELS: dict[str, Model] = {
    "closed form, mean load": closed_form,
    "closed form, largest load": partial(closed_form, largest=True),
    "without bulk stress": without_bulk,
    "stick zone not moved": in_place,
    "tangential extremes only": partial(on_grids, fixed_plane=False, extremes_alone=True),
    "plane fixed along x": partial(on_grids, fixed_plane=True, extremes_alone=False),
    "line: s": line,
    "circle: s_surface": circle,
    "nonlocal mean": mean,
    "whole body": body,
}
REFERENCE, TARGET = "whole body", "nonlocal mean"
BOXES: dict[str, tuple[Draw, tuple[str, ...]]] = {
    "paper: two oscillations": (paper, ("without bulk stress", "stick zone not moved")),
    "rig: constant normal force": (constant_load, ("closed form, largest load",)),
    "rig: normal force varies": (varying_load, ("stick zone not moved",)),
}


def timed(model: Model, batches: list[Points]) -> tuple[Array, float]:
    """Values of all points, and processor seconds per value; the quick closed form is repeated."""
    repeats = 100 if getattr(model, "func", model) is closed_form else 1
    begin = time.process_time()
    for _ in range(repeats):
        values = np.concatenate([model(points) for points in batches])
    return values, (time.process_time() - begin) / (repeats * len(values))


def rows(draw: Draw, left_out: tuple[str, ...], count: int) -> Iterator[tuple[str, float, Array]]:
    """For each model of a box: its name, seconds per value, and signed relative errors."""
    batches = draw(np.random.default_rng(SEED), count)
    found = {name: timed(model, batches) for name, model in MODELS.items() if name not in left_out}
    largest = np.maximum(found[REFERENCE][0], found["circle: s_surface"][0])
    for name, (values, seconds) in found.items():
        error = np.zeros(len(largest)) if name == REFERENCE else values / largest - 1.0
        yield name, seconds, error


COLUMNS = ("median", "95 %", "most too low", "most too high")


def quantiles(error: Array) -> tuple[float, ...]:
    """Median and 95 % quantile of the magnitude, and the largest error of each sign, as magnitudes."""
    median, most = np.quantile(np.abs(error), [0.5, 0.95])
    return float(median), float(most), float(max(-error.min(), 0.0)), float(max(error.max(), 0.0))


def table(found: dict[str, list[tuple[str, float, Array]]]) -> str:
    """A table for each box."""
    count = len(next(iter(found.values()))[0][2])
    lines = [
        "# Errors of models",
        "",
        "Relative differences from the largest SWT of the whole body, at random points of each box",
        f"({count} points each). The nonlocal mean, with ℓ = {DISTANCE:g} a_H, is another quantity: its",
        "difference shows by how much a mean is lower. `python studies/models.py`",
    ]
    for box, models in found.items():
        lines += ["", f"## {box}", ""]
        lines += ["| model | processor time, ms | " + " | ".join(COLUMNS) + " |", "|---" * 6 + "|"]
        for name, seconds, error in models:
            cells = " | ".join(percent(each) for each in quantiles(error))
            lines.append(
                f"| {name} | {1e3 * seconds:.2g} | {cells if name != REFERENCE else '– | – | – | –'} |"
            )
    return "\n".join(lines) + "\n"


def percent(share: float) -> str:
    """A share in per cent, with two digits or whole."""
    return f"{100.0 * share:.0f} %" if share >= 0.995 else f"{100.0 * share:.2g} %"


def draw(found: dict[str, list[tuple[str, float, Array]]]) -> Figure:
    """Errors of the models of each box, one panel below the other, with the times at their right."""
    with styled(width="column"):
        heights = [len(models) for models in found.values()]
        figure = new_figure((WIDTHS["column"], 0.7 + 0.17 * sum(heights) + 0.3 * len(found)), "column")
        panels = figure.subplots(len(found), 1, sharex=True, squeeze=False, height_ratios=heights)[:, 0]
        for axes, (box, models) in zip(panels, found.items(), strict=True):
            beside = {"va": "center", "fontsize": "small"}
            for row, (name, seconds, error) in enumerate(models):
                if name != REFERENCE:
                    _draw_model(axes, row, error, "0.6" if name == TARGET else "black")
                axes.text(1.03, row, in_words(seconds), transform=axes.get_yaxis_transform(), **beside)
            axes.set(xscale="log", xlim=(0.7 * SMALLEST, 5.0), ylim=(len(models) - 0.4, -0.6))
            axes.set_yticks(range(len(models)), [name for name, *_ in models])
            axes.set_xticks([1e-4, 1e-2, 1.0], ["0.01 %", "1 %", "100 %"])
            axes.minorticks_off()
            axes.set_title(box)
            axes.grid(axis="y", visible=False)
        panels[0].text(1.03, 1.03, "time", transform=panels[0].transAxes, va="bottom", fontsize="small")
        panels[-1].set_xlabel("error of the largest SWT")
        names = "median", "worst, too low", "to 95 % of the points", "worst, too high"
        looks = [
            stroke("black", "none", marker="o", markersize=5.0),
            stroke("black", "none", marker="<", markersize=4.5),
            stroke("black", linewidth=3.0),
            stroke("black", "none", marker=">", markersize=4.5, markerfacecolor="white"),
        ]
        place_legend(figure, [Line2D([], [], **look) for look in looks], list(names))
    return figure


def _draw_model(axes: Axes, row: int, error: Array, colour: str) -> None:
    """A dot at the median, a bar up to 95 % of the points, and the largest errors of both signs."""
    median, most, low, high = np.maximum(quantiles(error), SMALLEST)
    axes.plot([median, most], [row, row], **stroke(colour, linewidth=3.0, solid_capstyle="butt"))
    axes.plot(median, row, **stroke(colour, "none", marker="o", markersize=5.0))
    for value, marker, face in ((low, "<", colour), (high, ">", "white")):
        if value > SMALLEST:
            look = {"marker": marker, "markersize": 4.5, "markerfacecolor": face}
            axes.plot(value, row, **stroke(colour, "none") | look)


def in_words(seconds: float) -> str:
    """Seconds as milliseconds or microseconds, with two digits."""
    if seconds >= 0.0995:
        return f"{1e3 * seconds:.0f} ms"
    return f"{1e3 * seconds:.2g} ms" if seconds >= 1e-4 else f"{1e6 * seconds:.2g} µs"


def main() -> None:
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--results", type=Path, default=Path("results"), help="folder for what it writes")
    arguments.add_argument("--quick", action="store_true", help="few points, to see that it runs")
    given = arguments.parse_args()
    count = 4 if given.quick else POINTS
    for draw_box, left_out in BOXES.values():
        list(rows(draw_box, left_out, 2))  # all is compiled before it is timed
    found = {box: list(rows(*how, count)) for box, how in BOXES.items()}
    text = table(found)
    print(text)
    (given.results / "models.md").write_text(text, encoding="utf-8")
    save_figure(draw(found), given.results / "models.png")


if __name__ == "__main__":
    main()
