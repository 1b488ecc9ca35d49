"""Samples of points whose s, or what comes with it, shows what the constants of the mechanics do."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from accuracy import points_at_ends, random_points
from nonlocal_means import worn
from overlooked import CHUNK, drawn

from swtstudy.paper.maxima import body_maximum
from swtstudy.solver.load_path import LoadPath
from swtstudy.solver.points import Points, solve_points
from swtstudy.solver.quantities import quantities_of
from swtstudy.vocabulary.parameters import Control
from swtstudy.vocabulary.quantities import Request, error_of

SEED = 5
#: Values of some points at a tolerance, and their errors as far as they are known.
Values = tuple[np.ndarray, np.ndarray]


def random(profile: str, p: int, q: int) -> Callable[[int], Points]:
    """Points all over the parameters, of one frequency ratio, so that they are solved together."""
    return lambda count: _with_ratio(random_points(profile, count, SEED), p, q)


def at_ends(profile: str, p: int, q: int) -> Callable[[int], Points]:
    """Points that crowd at the ends of the allowed ranges."""
    return lambda count: _with_ratio(points_at_ends(profile, count, SEED), p, q)


def _with_ratio(points: Points, p: int, q: int) -> Points:
    return replace(points, p=np.full_like(points.p, p), q=np.full_like(points.q, q))


def of_law(scene: str) -> Callable[[int], Points]:
    """Points of a scene of ``overlooked.py``: small motions among them, which make narrow rings."""

    def first(count: int) -> Points:
        chunks = [drawn(scene, SEED, chunk) for chunk in range(-(-count // CHUNK))]
        columns = {name: [vars(points)[name] for points in chunks] for name in vars(chunks[0])}
        arrays = {n: np.concatenate(of) for n, of in columns.items() if isinstance(of[0], np.ndarray)}
        return replace(chunks[0], **arrays)[np.arange(count)]

    return first


def sliding_at_edge(count: int) -> Points:
    """Large friction and tangential amplitude at the sharp edge of a face."""
    points = random("truncated_paraboloid", 1, 2)(count)
    slides = 0.75 + 0.25 * points.friction, points.tangential_amplitude + 3.0
    return replace(points, friction=slides[0], tangential_amplitude=slides[1])


def of_table(count: int) -> Points:
    """A worn paraboloid, as a table."""
    return replace(random("paraboloid", 1, 2)(count), profile=worn())


def mixed(count: int) -> Points:
    """A normal force and a tangential displacement."""
    return replace(random("wavy_paraboloid", 1, 2)(count), control=Control(normal_force=True))


def forces(count: int) -> Points:
    """Both forces; small ones, so that most points have an equilibrium."""
    points = random("rounded_punch", 2, 1)(count)
    small = {name: 0.3 * getattr(points, name) for name in ("normal_amplitude", "tangential_amplitude")}
    return replace(points, control=Control(True, True), **small)


def with_bulk_stress(count: int) -> Points:
    """Bulk stress on a third of the scale of the contact's own."""
    points = random("paraboloid", 2, 1)(count)
    dice = np.random.default_rng(SEED).uniform(size=(3, count))
    scales = {"mean": 0.3 * (dice[0] - 0.5), "amplitude": 0.3 * dice[1], "phase": 6.0 * dice[2]}
    return replace(points, **{f"bulk_stress_{name}": values for name, values in scales.items()})


def smooth_loop(count: int) -> Points:
    """Major and minor cycles."""
    rows = [(1, 0.6, 0.3), (3, 0.3, 1.0)], [(1, 0.7, 0.0), (5, 0.3, 2.0)]
    return replace(random("paraboloid", 1, 1)(count), path=LoadPath.harmonic_sum("minor", *rows))


def polygon(count: int) -> Points:
    """An L with a minor turn."""
    vertices = [(0.0, 0.0), (1.0, 0.0), (1.0, 0.6), (0.9, 0.3), (1.0, 1.0), (-1.0, -1.0)]
    return replace(random("paraboloid", 1, 1)(count), path=LoadPath("turns", vertices))


def on_line(points: Points, rtol: float) -> Values:
    """The value s and its error."""
    solution = solve_points(points, rtol)
    return solution.s, solution.s_error


def on_circle(points: Points, rtol: float) -> Values:
    """The value s_surface and the error of s."""
    solution = solve_points(points, rtol)
    return solution.s_surface, solution.s_error


def in_body(points: Points, rtol: float) -> Values:
    """The parameter over all planes in every 16th body: its largest value, and that at the critical point."""
    some = points[np.arange(0, len(points), 16)]
    found = []
    for k, x in enumerate(solve_points(some, rtol).critical_x):
        if np.isfinite(x):
            largest, at_line = body_maximum(some[[k]], float(x))
            found += [largest.swt, float(at_line.swt)]
    return np.array(found), np.full(len(found), np.inf)


def nonlocal_means(points: Points, rtol: float) -> Values:
    """Means of every eighth point over two distances, and their errors."""
    return _quantities(points[np.arange(0, len(points), 8)], rtol, Request(distances=(0.05, 0.2)))


def work_and_force_ratio(points: Points, rtol: float) -> Values:
    """The dissipated work and its error, and the largest force ratio."""
    return _quantities(points, rtol, Request(("dissipation", "force_ratio")))


def _quantities(points: Points, rtol: float, asked: Request) -> Values:
    columns = quantities_of(points, asked, solve_points(points, rtol))
    values, errors = [], []
    for row in asked.rows:
        value = columns[row.name]
        values.append(value.ravel())
        errors.append((columns[error_of(row.name)] if row.has_error else np.full_like(value, np.inf)).ravel())
    return np.concatenate(values), np.concatenate(errors)


#: By the kind of a sample: where its points come from, and what is looked at.
KINDS: dict[str, tuple[list[Callable[[int], Points]], Callable[[Points, float], Values]]] = {
    "line": (
        [
            of_law("displacements"),
            of_law("forces"),
            of_law("truncated paraboloid"),
            of_law("next to no bulk stress"),
            of_law("phases next to 0 and π"),
            at_ends("paraboloid", 1, 1),
        ],
        on_line,
    ),
    "wavy": ([random("wavy_paraboloid", 1, 2)], on_line),
    "power": ([random("power_law", 1, 2), at_ends("power_law", 1, 1)], on_line),
    "table": ([of_table], on_line),
    "loop": ([smooth_loop, polygon], on_line),
    "force": ([mixed, forces], on_line),
    "bulk": ([with_bulk_stress], on_line),
    "circle": ([random("paraboloid", 1, 2)], on_circle),
    "edge": ([sliding_at_edge], on_line),
    "body": ([random("paraboloid", 1, 2), random("rounded_punch", 2, 1)], in_body),
    "means": (
        [random("paraboloid", 1, 2), random("truncated_paraboloid", 2, 1), with_bulk_stress],
        nonlocal_means,
    ),
    "work": ([random("paraboloid", 3, 2), of_table, mixed, smooth_loop], work_and_force_ratio),
}


def solved(kind: str, count: int, rtol: float) -> Values:
    """Values of a kind of sample, and their errors, from ``count`` points of each source."""
    sources, look = KINDS[kind]
    with np.errstate(all="ignore"):
        found = [look(source(count), rtol) for source in sources]
    values, errors = (np.concatenate(each) for each in zip(*found, strict=True))
    return values, errors
