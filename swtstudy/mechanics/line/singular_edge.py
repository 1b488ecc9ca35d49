"""swt of the truncated paraboloid next to r = b, where the stress grows like L = ln(1/ε), r = b (1 + ε).

To the order ε the stress at r = b⁺ is a finite part plus L/2 times a logarithmic part, both in closed form:
for b⁺ all springs are outside of r but for those at G → 0⁺, whose pull is finite. L takes the place of the
position, so that distances far below what a number near b can hold cost nothing:

* |τ| = w at the innermost spring and μ > 1: a plane near 45° is in tension that grows like L. Short of that
  the maximum is where the permanent stick zone ends, and is given up once that is nearer than `NEAREST`.
* The whole contact slides and μ ≥ 1: besides, Δε_n grows like L; at μ = 1 the tension is finite.
* Contact is lost: springs that just touch at r pull with a finite stress before the pressure of −L comes.
  Short of that s ~ ln(1/(1 − δA/δ0)), at the least radius of the contact, and is given up once that is nearer
  than `NEAREST` (of the profile).
* Contact is lost and a bulk stress pulls meanwhile: that is the tension then, with friction or without.

In these cases s is not finite, for every exponent of the criterion. Else it is; if the whole contact slides,
σ_n falls like (1 − μ) L while Δε_n rises like L, and the maximum lies at an L of some γπ/(1 − μ).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from swtstudy.mechanics.control.coordinate import Coordinate, DepthCoordinate, ForceCoordinate
from swtstudy.mechanics.events.stretches import PER_INTERVAL
from swtstudy.mechanics.indenter.base import Primitives
from swtstudy.mechanics.indenter.paraboloid import SMALLEST_FACE, TruncatedParaboloid
from swtstudy.mechanics.line.look import SETTLED, Accuracy, Look
from swtstudy.mechanics.line.maximum import Maximum
from swtstudy.mechanics.line.refine import climb_over_planes
from swtstudy.mechanics.line.rounding import reach_of_edge
from swtstudy.mechanics.load.load import Load
from swtstudy.mechanics.numerics.arrays import SAME, align
from swtstudy.mechanics.points import BoolArray, FloatArray
from swtstudy.mechanics.stress.scene import Scene

#: Below this friction swt falls towards r = b from where the search over x ends. Half: no change at 32
#: points; 1.6, so that r = b is never looked at: 0.6 of s at 5 of 32.
LEAST_FRICTION = 0.8
#: Values of L of the first look and of each closer one, and how many of these there are. Half of them: 6e-7,
#: 4e-4 at 6 of 32 and 2e-4 at 6, at rtol 1e-5; 20–35 % faster.
FIRST_COUNT, NEXT_COUNT, ROUND_COUNT = 24, 9, 5
#: Steps of each smooth stretch of the cycle. Half: 1e-6, 40 % faster.
STEPS_PER_DIGIT = 3
#: So many times the steps check the value, one after the other until it changes little enough. The first
#: alone: 9e-6 at rtol 1e-5; from the second on: 3e-7, the same time.
FINER = 2, 4, 8, 16
#: The spring at r = b⁺ for the events of the cycle, by its w/b, and how exactly that is known. A hundredth or
#: a hundred times the first, half or twice the second: no change at 32 points.
ONSET, BESIDE = 1e-7, 0.3
#: Relative error by what is left out: of the orders ε and `ONSET`.
LEFT_OUT = 2.0 * ONSET


def not_finite(scene: Scene) -> BoolArray:
    """True where swt grows without bound towards r = b, or nearly, shape (n,); see the head of this file."""
    profile, cycle, friction = scene.profile, scene.cycle, scene.friction
    if not profile.has_singular_edge:
        return np.zeros(len(scene), dtype=bool)
    nearest = profile.singular_approach.min(axis=1, keepdims=True)
    tears = _innermost_spring_slips(cycle.load, scene.coordinate.of(nearest)) & (friction > 1.0)
    tears |= cycle.gross_slip & (friction >= 1.0)
    # Once contact is lost, or nearly, the maximum is where its edge turns.
    turn = scene.coordinate.radius(cycle.load.least_normal[:, None])
    lost = (turn <= nearest)[:, 0]
    tears |= lost
    tears &= (friction > 0.0) & cycle.load.has_tangential
    if scene.bulk is not None:
        # Pressure alone swings no strain at ν = 1/2.
        tears |= lost & (scene.poisson_ratio < 0.5) & _pulls_while_lost(scene, scene.coordinate.of(nearest))
    return np.asarray(tears & (profile.flat_radius > 0.0))


def _pulls_while_lost(scene: Scene, margin: FloatArray) -> BoolArray:
    """True where a bulk stress pulls at an instant without contact, or nearly, by a margin (n, 1)."""
    assert scene.bulk is not None
    # Within the intervals of the cycle both are monotone.
    ends = np.concatenate([scene.cycle.begin, scene.cycle.end], axis=1)
    pulls = scene.bulk.at(ends) > 0.0
    return np.asarray((pulls & (scene.cycle.load.normal(ends) <= margin)).any(axis=1))


def _innermost_spring_slips(load: Load, margin: FloatArray) -> BoolArray:
    """True where the spring at G → 0 ends on a slip line: |T| ≥ N at some instant, by a margin (n, 1)."""
    instants = load.turning_instants()
    normal, tangential = load.normal(instants), load.tangential(instants)
    return np.asarray(
        ((tangential - normal + margin).max(axis=1) >= 0.0)
        | ((tangential + normal - margin).min(axis=1) <= 0.0)
    )


def may_be_largest(scene: Scene) -> BoolArray:
    """True where the maximum may lie nearer to r = b than the search over x goes, shape (n,)."""
    profile, cycle = scene.profile, scene.cycle
    if not profile.has_singular_edge:
        return np.zeros(len(scene), dtype=bool)
    face = profile.flat_radius >= SMALLEST_FACE * profile.radius(profile.largest_depth)
    slides = cycle.gross_slip & (cycle.load.least_normal > 0.0)
    # The maximum is at an L in proportion to γ/(1 − μ), γ being half the power of the strain.
    _, power = scene.criterion.powers(np.ones(len(scene)), np.ones(len(scene)))
    least = 1.0 - (1.0 - LEAST_FRICTION) * power
    return np.asarray(face & slides & (scene.friction >= least))


def at_edge(scene: Scene, found: Maximum, accuracy: Accuracy) -> Maximum:
    """The maxima found along x of n truncated paraboloids that slide, μ < 1, or those next to r = b."""
    edge = _maximum_at_edge(scene, accuracy)
    distance = np.abs(found.position) / scene.profile.flat_radius - 1.0
    better = (edge.swt > found.swt) | ((distance > 0.0) & (distance < reach_of_edge(scene.profile)))
    return found.put(better, edge.take(better))


def _maximum_at_edge(scene: Scene, accuracy: Accuracy) -> Maximum:
    """Largest swt at 0 < ε ≤ `reach_of_edge`."""
    # The instant at which the front arrives at G = 0 is a breakpoint.
    scene = scene.split_at_breakpoints()
    n = len(scene)
    rows = np.arange(n)
    found = Maximum.unknown(n, 0.0)
    radius = scene.profile.radius(scene.profile.largest_depth)
    flat = scene.profile.flat_radius
    nearest = -np.log(reach_of_edge(scene.profile))
    # Beyond this no plane is in tension.
    farthest = nearest + 20.0 * (1.0 + radius / flat) / (1.0 - scene.friction)
    steps = STEPS_PER_DIGIT * math.ceil(-math.log10(accuracy.tolerance))
    digits = accuracy.check.digits
    for side in (1.0, -1.0):
        for start in (0.5 * np.pi, -0.5 * np.pi):
            low, high, count = nearest, farthest, FIRST_COUNT
            for _ in range(ROUND_COUNT):
                share = np.linspace(0.0, 1.0, count)
                distance = low[:, None] * (high / low)[:, None] ** share
                swt, angle = _swt(scene, distance, side, start, steps, digits)
                best = swt.argmax(axis=1)
                low = distance[rows, np.maximum(best - 1, 0)]
                high = distance[rows, np.minimum(best + 1, count - 1)]
                count = NEXT_COUNT
            there = distance[rows, best][:, None]
            value, change = _checked(scene, there, swt[rows, best], side, start, steps, accuracy)
            error = np.maximum(change + LEFT_OUT * value, accuracy.tolerance * value)
            larger = value > found.swt
            found = found.put(larger, Maximum(value, error, side * flat, angle[rows, best]).take(larger))
    return found


def _checked(
    scene: Scene,
    distance: FloatArray,
    swt: FloatArray,
    side: float,
    start: float,
    steps: int,
    accuracy: Accuracy,
) -> tuple[FloatArray, FloatArray]:
    """swt (n,) at L = ``distance`` (n, 1) with ever more steps, until it changes little; its last change."""
    value, change = swt.copy(), np.zeros_like(swt)
    rows = np.arange(len(swt))
    for times in FINER:
        finer, _ = _swt(scene.take(rows), distance[rows], side, start, times * steps, accuracy.check.digits)
        change[rows] = np.abs(finer[:, 0] - value[rows])
        value[rows] = finer[:, 0]
        rows = rows[change[rows] > SETTLED * accuracy.tolerance * value[rows]]
        if not rows.size:
            break
    return value, change


def _swt(
    scene: Scene, distance: FloatArray, side: float, start: float, steps: int, digits: float
) -> tuple[FloatArray, FloatArray]:
    """swt and 2θ at L = ``distance``, shape (n, X), on the best plane near 2θ = ``start``.

    Unlike `swtstudy.mechanics.line.refine.refine` this knows that the stress may jump at an event: an extreme
    is interpolated only where its neighbours belong to the same smooth stretch.
    """
    profile = scene.profile
    edge = _seen_from_edge(scene.coordinate, distance)
    position = np.broadcast_to(profile.flat_radius[:, None], distance.shape)
    look = Look.at(replace(scene, coordinate=edge), position, steps, digits)
    # The first of the three stretches of an interval ends at the onset; then T1 jumps, and the next begins.
    # Shortly before, the front passes r itself, where the pressure's logarithm ends at once: a kink, too.
    sticks = np.abs(look.history.traction) < (1.0 - SAME) * look.history.pressure
    sticks &= np.roll(sticks, 1, axis=-1) & np.roll(sticks, -1, axis=-1)
    inside = look.inside & (look.placed.stretch % PER_INTERVAL == 0) & sticks
    planes = scene.planes(look.history, side)
    return climb_over_planes(planes, inside, np.full(distance.shape, start))


class _SeenFromEdge(TruncatedParaboloid):
    """n truncated paraboloids whose stress is wanted at r = b⁺, at L of shape (n, X)."""

    __match_args__ = ("largest_depth", "flat_radius", "distance")

    def __init__(self, largest_depth: FloatArray, flat_radius: FloatArray, distance: FloatArray) -> None:
        super().__init__(largest_depth, flat_radius)
        self.distance = distance

    def primitives(self, position: FloatArray, digits: float) -> Primitives:
        return _EdgePrimitives(self)


class _EdgeCoordinate(DepthCoordinate):
    """The spring at r = b⁺ starts to slip when the one at w/b = `ONSET` does, the last that is a number."""

    def of(self, radius: FloatArray) -> FloatArray:
        return np.maximum(super().of(radius), ONSET * align(self.profile.flat_radius, radius) ** 2)


class _EdgeForceCoordinate(ForceCoordinate):
    """The same by the normal force, which is b² w/unit there."""

    def of(self, radius: FloatArray) -> FloatArray:
        onset = ONSET * self.profile.flat_radius**3 / self.unit
        return np.maximum(super().of(radius), align(onset, radius))


def _seen_from_edge(coordinate: Coordinate, distance: FloatArray) -> Coordinate:
    """The coordinate of n truncated paraboloids as it is seen from r = b⁺, at L of shape (n, X)."""
    profile = coordinate.profile
    seen = _SeenFromEdge(profile.largest_depth, profile.flat_radius, distance)
    if isinstance(coordinate, ForceCoordinate):
        return _EdgeForceCoordinate(seen, coordinate.unit)
    return _EdgeCoordinate(seen)


@dataclass(frozen=True)
class _EdgePrimitives(Primitives):
    """The limits of `TruncatedPrimitives` for r → b⁺, L = ln(b/(r − b)).

    A slip front passes the pressure's logarithm first and the springs at G → 0⁺ last: in between there is
    the instant at which the spring at r starts to slip.
    """

    edge: _SeenFromEdge

    def inner(self, radius: FloatArray) -> FloatArray:
        b, w = self.edge._face(radius), self.edge._rise(radius)
        pull = np.where(w > (1.0 - BESIDE) * ONSET * b, np.pi * b, 0.0)
        shape = np.broadcast_shapes(radius.shape, (*self.edge.distance.shape, *(1,) * (radius.ndim - 2)))
        return np.stack([np.broadcast_to(pull, shape)] * 2)

    def outer(self, radius: FloatArray) -> FloatArray:
        b, w = self.edge._face(radius), self.edge._rise(radius)
        half = 0.5 * self.edge.distance.reshape(self.edge.distance.shape + (1,) * (radius.ndim - 2))
        past = w > (1.0 + BESIDE) * ONSET * b
        finite = np.log(np.sqrt(2.0) * np.where(past, w, b) / b) - np.log(0.5 * (radius + b) / b)
        pressure = np.where(past, b * np.maximum(half + finite, 0.0) + 2.0 * (radius - b), 0.0)
        # ∫ (ξ − w) g′ dξ/b².
        load = w * ((2.0 / 3.0) * (w / b) ** 2 + 1.0) - (2.0 / 3.0) * (radius**3 - b**3) / b**2 + radius - b
        return np.stack([pressure, np.broadcast_to(np.where(past, load, 0.0), pressure.shape)])
