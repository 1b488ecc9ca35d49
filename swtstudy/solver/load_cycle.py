"""The stationary load cycle of one point as plain arrays: for what is drawn, and to compare s with."""

from __future__ import annotations

from typing import Any

import numpy as np

from swtstudy.kernel.batch import OF_PROFILE
from swtstudy.kernel.compiled import new_record, new_records
from swtstudy.kernel.course import STATE, write_parts, write_springs, write_states, write_stress, write_values
from swtstudy.kernel.cusps import cusps
from swtstudy.kernel.field import open_cycle
from swtstudy.kernel.line import SEARCH
from swtstudy.kernel.planes import fill, swing_weights
from swtstudy.kernel.point import OF_POINT
from swtstudy.kernel.profile import place_of, radius_of
from swtstudy.kernel.records import Point
from swtstudy.kernel.shift import centre_of
from swtstudy.kernel.work import CONJUGATE, permanent_stick, tabulate_answer, tabulate_other
from swtstudy.solver.points import Points, arguments_of
from swtstudy.vocabulary.arrays import FloatArray

#: Series of what grew in stick, relative to dv/dn: to rounding.
GROWTH = 1e-11


class LoadCycle:
    """The cycle of one point, solved when it is made; without equilibrium there are the points alone.

    Parameters
    ----------
    points
        A batch of one point.

    Attributes
    ----------
    points
        The batch.
    point
        Its records; load, profile, ask, cycle, growth, history and curves are attributes, too.
    search, conjugate
        Records of the search along the line, and of the component that is not prescribed.
    largest
        Place s of the largest contact.
    equilibrium
        True if there is a cycle.
    moved
        True if a bulk stress moves the stick zone.
    """

    def __init__(self, points: Points) -> None:
        opened = open_cycle(GROWTH, **arguments_of(points), rtol=OF_PROFILE, reach=1.0)
        self.points, self.equilibrium = points, opened is not None
        if opened is None:
            return
        # Copies, which outlive the next cycle that the kernel opens.
        given = (each.copy() for each in opened.point[:5])
        self.point = Point(*given, *map(new_record, OF_POINT[2:]))
        self.load, self.profile, self.ask, self.cycle, self.growth, _, self.history, self.curves = self.point
        self.largest, self.moved = opened.largest, bool(self.cycle.shift != 0.0)
        self.search, self.conjugate = new_record(SEARCH), new_record(CONJUGATE)
        tabulate_other(self.conjugate, self.profile)
        tabulate_answer(self.conjugate, self.cycle, self.growth, self.profile)

    @property
    def radii(self) -> tuple[float, float, float]:
        """Radius of permanent stick, NaN where there is none; least and largest contact radius; in a_H."""
        stick = permanent_stick(self.load, self.profile, self.cycle.event, self.cycle.events)
        least, largest = (
            float(radius_of(self.profile, place_of(self.profile, value))) for value in self.load.normal_range
        )
        return float(stick), least if self.load.normal_range[0] > 0.0 else 0.0, largest

    @property
    def stick_zone(self) -> tuple[float, float]:
        """Ends x/a_H of the permanent stick zone, NaN where there is none."""
        radius = self.radii[0]
        off = self.centre(self.place(np.array([radius])))[0]
        return off - radius, off + radius

    def centre(self, place: FloatArray) -> FloatArray:
        """Centres x/a_H of stick zones of sizes s, (n,): off the axis where a bulk stress moves them."""
        own = self.profile, self.cycle.shift, self.cycle.largest, self.largest
        return np.array([centre_of(*own, float(s)) if self.moved else 0.0 for s in place])

    @property
    def oscillations(self) -> int:
        """Number of times that the load oscillates in a period, as its fastest component does."""
        if self.points.path is None:
            return int(max(self.points.p[0], self.points.q[0]))
        load, count = self.load, self.load.terms
        moves = (load.cosine[:2, :count] != 0.0) | (load.sine[:2, :count] != 0.0)
        return int(load.rounds * load.order[:count][moves.any(axis=0)].max(initial=1))

    def place(self, radius: FloatArray) -> FloatArray:
        """Places s of radii in a_H, negative under a flat face."""
        b = float(self.profile.flat_radius)
        square = (radius - b) * (radius + b)
        return np.sign(square) * np.sqrt(np.abs(square))

    def radius(self, place: FloatArray) -> FloatArray:
        """Radii in a_H of places s, which are negative under a flat face."""
        return np.sqrt(float(self.profile.flat_radius) ** 2 + place * np.abs(place))

    def states(self, instant: FloatArray) -> np.recarray[Any, Any]:
        """States of the contact, `swtstudy.kernel.course.STATE`, at angles φ of the common period, (T,)."""
        own = np.mod(instant * self.load.rounds, 2.0 * np.pi) * (float(self.load.period) / (2.0 * np.pi))
        found = new_records(len(instant), STATE)
        write_states(self.cycle, self.growth, self.profile, self.load, self.conjugate, own, found)
        return found

    def instants(self, steps: int, x: float | None = None) -> FloatArray:
        """Cosine-spaced angles φ between the events of the cycle, with the events at x/a_H; ascending."""
        load, times = self.load, self.cycle.time[: self.cycle.stretches]
        if x is not None:
            write_parts(self.point, *self._at(x))
            times = self.history.time[: self.history.parts]
        share = 0.5 - 0.5 * np.cos(np.pi / steps * np.arange(steps + 1))
        own_times = (times[:, :1] + np.diff(times) * share).ravel()
        if load.mirrored:
            own_times = np.append(own_times, own_times + 0.5 * load.period)
        turn = np.mod(own_times, load.period) / load.period
        every = (np.arange(load.rounds)[:, None] + np.append(turn, [0.0, 1.0])) / load.rounds
        return 2.0 * np.pi * np.unique(np.clip(every, 0.0, 1.0))

    def _at(self, x: float) -> tuple[float, float, float]:
        """Place s of x/a_H and of the largest contact, and the side of x."""
        return float(self.place(np.array(abs(x)))), self.largest, -1.0 if x < 0.0 else 1.0

    def stress(self, x: float, states: np.recarray[Any, Any]) -> dict[str, FloatArray]:
        """Stress at x/a_H on the line at T states, each (T,), in E* √(δ0/R).

        Returns
        -------
        dict
            ``xx``, ``yy``, ``zz``, ``xz``, tension positive, and ``bulk``, its part of xx.
        """
        place, largest, side = self._at(x)
        write_stress(self.point, states, place, largest, side)
        ν = float(self.ask.poisson_ratio)
        names = ("p", "within", "xx", "yy", "q", "bulk")
        p, within, xx, yy, q, bulk = (self.history[name][: len(states)].copy() for name in names)
        across = ν * bulk if self.profile.plane else 0.0
        return {
            "xx": within - p + side * xx + bulk,
            "yy": -within - 2.0 * ν * p + side * yy + across,
            "zz": -p,
            "xz": -q,
            "bulk": bulk,
        }

    def on_plane(
        self, x: float, double_angle: float, states: np.recarray[Any, Any]
    ) -> tuple[FloatArray, FloatArray]:
        """σ_n and the swing, ε_n or τ, on a plane through y at x/a_H and T states, each (T,)."""
        self.stress(x, states)
        fill(self.history, self.curves, np.sign(x), self.ask)
        C, S = np.cos(double_angle), np.sin(double_angle)
        of_b, of_c = swing_weights(self.ask, C, S)
        a, b, c, d = (self.curves[name][: len(states)] for name in "abcd")
        scale = 1.0 - float(self.ask.poisson_ratio) ** 2 if self.ask.criterion == 0 else 1.0
        return a + b * C + c * S, (d + of_b * b + of_c * c) / scale

    def along(self, radius: FloatArray) -> tuple[FloatArray, FloatArray]:
        """The criterion and 2θ of its plane at x = ±radius, each of shape (X, 2)."""
        values, angles = np.zeros((2, len(radius), 2))
        write_values(self.search, self.point, self.largest, self.place(radius), values, angles)
        return values, angles

    def springs(self, radius: FloatArray, states: np.recarray[Any, Any]) -> tuple[FloatArray, FloatArray]:
        """Compression and tangential force of springs, each (T, X).

        w in δ0, and τ = G* u_MDR/(μ E* δ0), |τ| ≤ w. In the plane, where strips have no springs, what the
        diagram has in their place: N − N(ξ) over P_0, and the tangential force over μP_0.
        """
        compression, force = np.zeros((2, len(states), len(radius)))
        place = np.maximum(self.place(radius), 0.0)
        own = self.cycle, self.growth, self.profile, self.load, self.conjugate
        write_springs(*own, states, place, self.largest, compression, force)
        return compression, force

    def cusps(self) -> FloatArray:
        """Ascending places s between which the criterion is smooth along the line."""
        count = cusps(self.search, self.cycle, self.profile, self.load, self.ask, self.largest)
        return self.search.cusp[:count].copy()
