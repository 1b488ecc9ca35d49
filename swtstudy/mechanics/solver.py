"""From parameter points to s: batches that share loads, bounded in memory."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from typing import Any

import numpy as np

from swtstudy.kernel.batch import solve_batch
from swtstudy.mechanics.contact.cycle import Cycle, out_of_equilibrium, solve_cycle
from swtstudy.mechanics.control.diagram import diagram, largest_depth
from swtstudy.mechanics.indenter import roughness
from swtstudy.mechanics.load.bimodal import alike, largest_turn_count, shared_load
from swtstudy.mechanics.load.load import Load
from swtstudy.mechanics.planes.criterion import SWT_EXPONENT
from swtstudy.mechanics.points import IndexArray, IntArray, Points, Solution
from swtstudy.mechanics.stress.bulk import bulk_kind
from swtstudy.mechanics.stress.scene import Scene

#: Points times turning instants of one batch, and with their square, which are instants and positions: enough
#: to hide the interpreter. Half of both: 13 % slower at long cycles; twice: no faster.
BATCH_SIZE, BATCH_SQUARES = 3200, 120_000
#: The profile whose stress has no bound at the edge of its face.
SINGULAR = "truncated_paraboloid"
#: So many batches may share the contact solutions that are held at a time. 1 or 32: the same time and memory
#: to 3 % and 22 MB at 1,600 points, whose loads differ.
SHARING = 8


def solve_points(points: Points, rtol: float = 1e-4) -> Solution:
    """s of every point (eqs. 7–20).

    Parameters
    ----------
    points
        n points of one profile family and control.
    rtol
        Relative accuracy asked for.

    Returns
    -------
    Solution
        Arrays of shape (n,), NaN where the body slides away. The value of a point does not depend on the
        others.

    Raises
    ------
    ArithmeticError
        If a load cycle has more pieces than the solver has room for.
    """
    found = solve_batch(**arguments_of(points), rtol=rtol)
    names = "s", "s_error", "critical_x", "critical_angle", "s_surface"
    s, error, x, angle, surface = (found[name].copy() for name in names)
    return Solution(s, error, x, angle, found["regime"].astype(np.int8), surface)


def arguments_of(points: Points) -> dict[str, Any]:
    """Points as arguments of `swtstudy.kernel.batch.chunks`."""
    return {
        "profile": points.profile,
        "poisson_ratio": points.poisson_ratio,
        "friction": points.friction,
        "normal_amplitude": points.normal_amplitude,
        "tangential_amplitude": points.tangential_amplitude,
        "frequency_ratio": [Fraction(int(p), int(q)) for p, q in zip(points.p, points.q, strict=True)],
        "phase": points.phase,
        "loops": None if points.path is None else [points.path] * len(points),
        "shape": points.shape,
        "control": (points.control.normal_force, points.control.tangential_force),
        "bulk_amplitude": points.bulk_stress_amplitude,
        "bulk_mean": points.bulk_stress_mean,
        "bulk_phase": points.bulk_stress_phase,
        "criterion": points.criterion,
        "walker_exponent": points.walker_exponent,
        "normal_sensitivity": points.normal_sensitivity,
    }


def scenes(points: Points) -> Iterator[tuple[IndexArray, Scene]]:
    """Indices of points that are solved together, and their scenes: each of one kind.

    Points that are in no equilibrium are in none of them.
    """
    for group in alike(points):
        turns = largest_turn_count(points.take(group))
        size = max(min(BATCH_SIZE // turns, BATCH_SQUARES // turns**2), 1)
        for sharing in _split(group, SHARING * size):
            load, number = shared_load(points.take(sharing))
            if not points.control.mixed:
                carried = ~out_of_equilibrium(load, points.control)[number]
                sharing, number = sharing[carried], number[carried]
            some = points.take(sharing)
            deepest = largest_depth(points.control, some.profile, some.shape, load.largest_normal[number])
            kind = _kinds(some, roughness(some.profile, some.shape, deepest))
            # One contact solution for all profiles.
            cycle = None if points.control.mixed else solve_cycle(load)
            for same in np.unique(kind):
                for rows in _split(np.flatnonzero(kind == same), size):
                    taken, scene = _scene(some.take(rows), load.take(number[rows]), cycle, number[rows])
                    if taken.size:
                        yield sharing[rows[taken]], scene


def _scene(points: Points, load: Load, shared: Cycle | None, number: IndexArray) -> tuple[IndexArray, Scene]:
    """The scene of those points that are in equilibrium, and which of the points these are.

    With a ``shared`` contact solution all are, and the points' cycles are those of the given numbers in it.
    """
    in_diagram, coordinate = diagram(points.control, points.profile, points.shape, load)
    every = np.arange(len(points))
    # Without a tangential load there is no traction, whatever the friction.
    friction = np.where(load.has_tangential, points.friction, 0.0)
    if shared is not None:
        scene = Scene(shared.take(number), coordinate, points.poisson_ratio, friction)
        return every, scene.with_own(points)
    carried = every[~out_of_equilibrium(in_diagram, points.control)]
    own = points.poisson_ratio[carried], friction[carried]
    # Loads out of equilibrium have a cycle too, of no meaning.
    scene = Scene(solve_cycle(in_diagram).take(carried), coordinate.take(carried), *own)
    return carried, scene.with_own(points.take(carried))


def _kinds(points: Points, level: IntArray) -> IntArray:
    """A number for each kind of scene: what has no bulk stress, or no powers, does not pay for those."""
    return 6 * level + 2 * bulk_kind(points) + (points.walker_exponent != SWT_EXPONENT)


def _split(index: IndexArray, size: int) -> list[IndexArray]:
    """The index in pieces of ``size`` at most, which are nearly equal."""
    return np.array_split(index, -(-len(index) // size))
