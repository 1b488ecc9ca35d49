"""From parameter points to s: batches that share loads, bounded in memory."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.contact.cycle import Cycle, out_of_equilibrium, solve_cycle
from swtstudy.mechanics.control.diagram import diagram, largest_depth
from swtstudy.mechanics.indenter import resolved_shape, roughness
from swtstudy.mechanics.line.look import Accuracy
from swtstudy.mechanics.line.maximum import Maximum, maximum
from swtstudy.mechanics.line.singular_edge import at_edge, may_be_largest, not_finite
from swtstudy.mechanics.line.surface_circle import surface_maximum
from swtstudy.mechanics.load.bimodal import alike, largest_turn_count, shared_load
from swtstudy.mechanics.load.load import Load
from swtstudy.mechanics.numerics.arrays import SAME
from swtstudy.mechanics.planes.criterion import SWT_EXPONENT
from swtstudy.mechanics.points import REGIMES, BoolArray, FloatArray, IndexArray, IntArray, Points, Solution
from swtstudy.mechanics.stress.bulk import bulk_kind
from swtstudy.mechanics.stress.scene import Scene

#: Points times turning instants of one batch, and with their square, which are instants and positions: enough
#: to hide the interpreter. Half of both: 13 % slower at long cycles; twice: no faster.
BATCH_SIZE, BATCH_SQUARES = 3200, 120_000
#: Relative error of tables, series and rounding, which no rtol removes (results/accuracy.md, at 1e-7).
LEAST_ERROR = 1e-7
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
    """
    n = len(points)
    s, error, position, angle, surface = (np.full(n, np.nan) for _ in range(5))
    regime = np.full(n, REGIMES.index("no_equilibrium"), dtype=np.int8)
    accuracy = Accuracy.for_tolerance(rtol)
    for index, scene in scenes(points):
        lost = not_finite(scene)
        idle = _idle(scene) & ~lost
        found = _maximum(scene, np.flatnonzero(~(lost | idle)), accuracy)
        found = found.put(idle, Maximum.unknown(int(idle.sum()), 0.0))
        found = _or_far_field(scene, found)
        s[index] = found.swt
        shape = {name: values[index] for name, values in points.shape.items()}
        _, left_out = resolved_shape(points.profile, shape, scene.profile.largest_depth)
        error[index] = np.maximum(found.error + left_out * found.swt, LEAST_ERROR * found.swt)
        critical = found.swt > 0.0
        # Planes whose normals leave the section of a plane contact strain less.
        surface[index] = found.swt if scene.profile.plane else surface_maximum(scene, found)
        position[index] = np.where(critical, found.position, np.nan)
        angle[index] = np.where(critical, _fold_angle(np.degrees(found.double_angle) / 2.0), np.nan)
        regime[index] = _regime(scene.cycle, lost)
    return Solution(s, error, position, angle, regime, surface)


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


def _idle(scene: Scene) -> BoolArray:
    """Where s is 0: pressure alone makes no tension at ν = 1/2 or in the plane, rest no swing of strain."""
    load, frictionless = scene.cycle.load, scene.friction == 0.0
    rests = (load.largest_normal == load.least_normal) & (frictionless | ~load.moves_tangentially)
    if scene.bulk is not None:
        return np.asarray(rests & ~scene.bulk.moves)
    if not scene.criterion.needs_tension:
        return np.asarray(rests)
    return np.asarray(rests | (frictionless & ((scene.poisson_ratio == 0.5) | scene.profile.plane)))


def _or_far_field(scene: Scene, found: Maximum) -> Maximum:
    """The maxima, or swt far from the contact where no point exceeds it: there is no critical point then."""
    if scene.bulk is None:
        return found
    far, plane = scene.bulk.far_field(scene.poisson_ratio, scene.criterion, scene.profile.plane)
    # Not where s is not finite.
    higher = (far > 0.0) & (far >= (1.0 - SAME) * found.swt)
    none = np.zeros(len(far))
    return found.put(higher, Maximum(far, none, none + np.nan, plane).take(higher))


def _regime(cycle: Cycle, lost: BoolArray) -> NDArray[np.int8]:
    """Index into `REGIMES` of each point; those ``lost`` have no finite s."""
    state = np.where(cycle.slips(), "partial_slip", "stick")
    for name, where in (("gross_slip", cycle.gross_slip), ("lift_off", cycle.lift_off), ("not_finite", lost)):
        state = np.where(where, name, state)
    return np.array([REGIMES.index(name) for name in state], dtype=np.int8)


def _maximum(scene: Scene, finite: IndexArray, accuracy: Accuracy) -> Maximum:
    """The maximum of each point of the scene, NaN but for those at ``finite``."""
    found = Maximum.unknown(len(scene), np.nan)
    if finite.size:
        found = found.put(finite, maximum(scene.take(finite), accuracy))
    near = finite[may_be_largest(scene)[finite]]
    if near.size:
        found = found.put(near, at_edge(scene.take(near), found.take(near), accuracy))
    return found


def _fold_angle(degrees: FloatArray) -> FloatArray:
    """The same plane's angle in (−90, 90]."""
    return 90.0 - np.mod(90.0 - degrees, 180.0)
