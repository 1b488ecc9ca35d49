"""The audit of one parameter point, and a dense look at its surface line.

The look is plain loops over positions, planes and instants in the place of the search. It shares with the
search the stress and the places of the cusps, and nothing else: every position is looked at on every plane,
at all instants, and the highest ones again on closer grids. What it finds is there: s must not be less.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from swtstudy.mechanics import solve_points
from swtstudy.mechanics.body.body_maximum import body_maximum
from swtstudy.mechanics.line.look import Look
from swtstudy.mechanics.line.positions import cusps
from swtstudy.mechanics.points import REGIMES, FloatArray
from swtstudy.mechanics.stress.scene import Scene, scene_of
from swtstudy.points.canonical import ROW, Definitions, points_from

#: Steps of each smooth part of the cycle, at first and in the first closer look: four and six times the
#: search's. Each further look has twice as many. With 4 at first it was itself 7e-4 low at a point, with 12
#: in each closer look 6e-4 at 1 of 66.
INSTANTS, CLOSER_INSTANTS = 8, 12
#: Digits of tables and series, at first and in the closer looks: stresses may be 1e4 times those that make
#: swt. 9 in the closer ones: 3e-6 too high at 3 of 1,473 points.
DIGITS, CLOSER_DIGITS = 6.0, 12.0
#: Local maxima that are looked at closer: so many, and this share of the highest. Each time on so many places
#: and planes about the best ones, NARROWER from one time to the next, until one stays below the share LOW.
KEPT, HIGH, ROUNDS, CLOSER, NARROWER, LOW = 8, 0.9, 5, 17, 0.25, 0.98
#: Pieces shorter than this share of the range are none.
NO_LENGTH = 1e-13
#: Positions times instants that are held at a time.
BLOCK = 300_000


def dense_look(scene: Scene, steps: int = 400, planes: int = 64) -> tuple[float, float]:
    """Largest swt on the surface line, and signed x/a_H there, of a batch of one point.

    Parameters
    ----------
    scene
        A batch of one point.
    steps
        Cosine-spaced steps of each piece between two cusps.
    planes
        Planes through y, evenly spaced.
    """
    scene = scene.split_at_breakpoints()
    ends = np.unique(cusps(scene.cycle, scene.coordinate, scene.critical_everywhere)[0])
    ends = ends[np.append(np.diff(ends) > NO_LENGTH * np.ptp(ends), True)]
    share = 0.5 - 0.5 * np.cos(np.pi / steps * np.arange(steps))
    r = np.append(ends[:-1, None] + np.diff(ends)[:, None] * share, ends[-1])
    turn = 2.0 * np.pi / planes
    angles = np.asarray(turn * np.arange(planes))
    best, position = 0.0, np.nan
    found: list[tuple[float, float, int, float]] = []
    sides = 1.0, -1.0
    looked = _highest(scene, r, sides, angles, INSTANTS, DIGITS)
    for side, swt, best_plane in zip(sides, *looked, strict=True):
        framed = np.pad(swt, 1, constant_values=-1.0)
        peak = (swt > framed[:-2]) & (swt >= framed[2:])
        found += [(swt[k], side, k, best_plane[k]) for k in np.flatnonzero(peak).tolist()]
    found.sort(reverse=True)
    for height, side, k, plane in found[:KEPT]:
        if height >= HIGH * found[0][0]:
            around = r[[max(k - 2, 0), k, min(k + 2, r.size - 1)]]
            closer = _closer(scene, ends, around, side, plane, turn, LOW * best)
            best, position = max((best, position), closer)
    return best, position


def _highest(
    scene: Scene, r: FloatArray, sides: tuple[float, ...], angles: FloatArray, count: int, digits: float
) -> tuple[FloatArray, FloatArray]:
    """Largest swt at each r over the planes at 2θ, and 2θ of that plane, both (sides, X)."""
    swt, best = np.zeros((2, len(sides), r.size))
    size = max(BLOCK // (3 * count * scene.cycle.begin.shape[1]), 1)
    for part in (slice(first, first + size) for first in range(0, r.size, size)):
        look = Look.at(scene, r[None, part], count, digits).history
        for k, side in enumerate(sides):
            history = scene.planes(look, side)
            for angle in angles:
                of_swt = history.criterion.curves(*history.on_plane(np.full((1, r[part].size), angle)))
                value = history.criterion.of_maxima(*(curve.max(axis=-1) for curve in of_swt))[0]
                best[k, part] = np.where(value > swt[k, part], angle, best[k, part])
                swt[k, part] = np.maximum(value, swt[k, part])
    return swt, best


def _closer(
    scene: Scene, ends: FloatArray, around: FloatArray, side: float, plane: float, turn: float, least: float
) -> tuple[float, float]:
    """The largest swt near a place, and signed x there, on ever closer grids of places, planes and instants.

    Parameters
    ----------
    ends
        Shape (k,): the cusps, which are looked at themselves.
    around
        Shape (3,): from where, about which place and up to where to look at first.
    """
    best, position = 0.0, np.nan
    down, up = np.diff(around)
    centre, count, half = around[1], CLOSER_INSTANTS, CLOSER // 2 + 1
    for _ in range(ROUNDS):
        low, high = max(centre - down, ends[0]), min(centre + up, ends[-1])
        within = ends[(ends > low) & (ends < high)]
        places = np.concatenate([np.linspace(low, centre, half), np.linspace(centre, high, half), within])
        places = np.unique(places)
        angles = plane + turn * np.linspace(-1.0, 1.0, CLOSER)
        swt, planes = (of[0] for of in _highest(scene, places, (side,), angles, count, CLOSER_DIGITS))
        k = int(swt.argmax())
        if swt[k] > best:
            best, position = float(swt[k]), float(side * places[k])
        centre, plane = places[k], planes[k]
        if best < least:
            break
        down, up, turn, count = NARROWER * down, NARROWER * up, NARROWER * turn, 2 * count
    return best, position


#: Which of the surface line's assumptions the body's maximum breaks, in the order of the flag values; the
#: last one is for points without a finite s, or with their maximum where the pressure is unbounded.
VERDICTS = ("none", "line_search", "plane_through_y", "symmetry_line", "surface", "not_finite")

#: Relative excess of the body's maximum that counts; s itself is computed to a tenth of this.
TOLERANCE = 1e-3
#: Distances and direction cosines that count as 0.
_ZERO = 1e-6


@dataclass(frozen=True)
class AuditedPoint:
    """One audited point.

    Attributes
    ----------
    s, s_error, s_surface, critical_x, regime
        From the solver: the maximum on the surface line and its error, the maximum on the circle through the
        critical point, the position of the former, and the name of the regime.
    s_dense
        What a dense look at the surface line finds; NaN without one.
    s_all_planes
        swt at that position over all plane orientations, from the field of the body.
    s_body
        Largest swt in the body.
    position, normal
        Shape (3,): where it is, and the normal of its plane.
    """

    s: float
    s_error: float
    s_surface: float
    critical_x: float
    regime: str
    s_dense: float
    s_all_planes: float
    s_body: float
    position: FloatArray
    normal: FloatArray

    @property
    def excess(self) -> float:
        """By how much the body's maximum exceeds s, relative."""
        return self.s_body / self.s - 1.0 if self.s != 0.0 else float(self.s_body > 0.0)

    @property
    def shortfall(self) -> float:
        """By how much s is below the dense look, relative; 0 within its error, NaN without a dense look."""
        if not np.isfinite(self.s_dense):
            return float("nan")
        return max(self.s_dense - self.s - self.s_error, 0.0) / self.s_dense if self.s_dense > 0.0 else 0.0

    @property
    def remainder(self) -> float:
        """By how much it exceeds s_surface, relative."""
        return self.s_body / self.s_surface - 1.0 if self.s_surface != 0.0 else float(self.s_body > 0.0)

    @property
    def verdict(self) -> str:
        """The first of the solver's assumptions that the body's maximum breaks."""
        if not np.isfinite(self.s_surface):
            return "not_finite"
        _, y, z = self.position
        if self.excess <= TOLERANCE:
            return "none"
        if z > _ZERO:
            return "surface"
        if abs(y) > _ZERO:
            return "symmetry_line"
        return "plane_through_y" if abs(self.normal[1]) > _ZERO else "line_search"


def audit_point(row: Sequence[float], definitions: Definitions, dense: bool = False) -> AuditedPoint:
    """Audit one canonical row (`swtstudy.points.canonical`), with what the user has defined by its code.

    With ``dense`` its surface line is looked at densely, too (`swtstudy.paper.audit.point`).
    """
    points = points_from(np.array([tuple(row)], ROW), definitions)
    line = solve_points(points, TOLERANCE / 10.0)
    s, x = float(line.s[0]), float(line.critical_x[0])
    regime, s_dense = REGIMES[int(line.regime[0])], float("nan")
    if dense and np.isfinite(s):
        with np.errstate(all="ignore"):
            s_dense = dense_look(scene_of(points))[0]
    solved = s, float(line.s_error[0]), float(line.s_surface[0]), x, regime, s_dense
    if not np.isfinite(line.s_surface[0]):
        return AuditedPoint(*solved, np.nan, np.nan, np.full(3, np.nan), np.full(3, np.nan))
    # The field handles gross slip and the 0/0 of a vanishing contact: NumPy's warnings would only alarm.
    with np.errstate(all="ignore"):
        body, at_line = body_maximum(scene_of(points), x)
    return AuditedPoint(*solved, float(at_line.swt), body.swt, body.position, body.normal)
