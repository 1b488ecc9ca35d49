"""The stationary load cycle of one point as plain arrays: for what is drawn, and to compare s with."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from swtstudy.kernel.batch import OF_PROFILE, chunks
from swtstudy.kernel.compiled import new_record, new_records
from swtstudy.kernel.contact import solve_cycle
from swtstudy.kernel.course import STATE, write_parts, write_springs, write_states, write_stress, write_values
from swtstudy.kernel.growth import lay_out
from swtstudy.kernel.line import cusps
from swtstudy.kernel.planes import fill, swing_weights
from swtstudy.kernel.point import workspace
from swtstudy.kernel.profile import place_of, radius_of
from swtstudy.kernel.shift import centre_of, shift_of
from swtstudy.kernel.work import CONJUGATE, permanent_stick, tabulate_answer, tabulate_other
from swtstudy.solver.points import Points, arguments_of
from swtstudy.vocabulary.arrays import FloatArray

#: Series of what grew in stick, relative to dv/dn: to rounding.
GROWTH = 1e-11


@dataclass(frozen=True)
class LoadCycle:
    """The cycle of one point.

    Attributes
    ----------
    points
        A batch of one point.
    profile, load, ask
        Records of `swtstudy.kernel`.
    memory
        Cycle, growth, search, history, work and tables: records of `swtstudy.kernel.point.workspace`.
    conjugate
        Record of the component that is not prescribed.
    """

    points: Points
    profile: Any
    load: Any
    ask: Any
    memory: tuple[Any, ...]
    conjugate: Any

    @classmethod
    def of(cls, points: Points) -> LoadCycle:
        """Solve a batch of one point; without equilibrium there is no more than the load."""
        _, profiles, _, loads, asks = next(chunks(**arguments_of(points), rtol=OF_PROFILE, reach=1.0))
        memory, conjugate = workspace(), new_record(CONJUGATE)
        cycle, growth = memory[:2]
        load = loads[0].copy()
        solve_cycle(cycle, load)
        if not cycle.no_equilibrium:
            cycle.shift = shift_of(load, profiles[0], asks[0], cycle.event, cycle.events)
            lay_out(growth, cycle, profiles[0], load, GROWTH)
            tabulate_other(conjugate, profiles[0])
            tabulate_answer(conjugate, cycle, growth, profiles[0])
        if cycle.overflow:
            raise ArithmeticError("the load cycle has more pieces than the solver has room for")
        return cls(points, profiles[0], load, asks[0], memory, conjugate)

    @property
    def equilibrium(self) -> bool:
        """True if there is a cycle."""
        return not self.memory[0].no_equilibrium

    @property
    def largest(self) -> float:
        """Place s of the largest contact."""
        return float(place_of(self.profile, self.memory[0].largest))

    @property
    def radii(self) -> tuple[float, float, float]:
        """Radius of permanent stick, NaN where there is none; least and largest contact radius; in a_H."""
        cycle, profile = self.memory[0], self.profile
        stick = permanent_stick(self.load, profile, cycle.event, cycle.events)
        least, largest = (
            float(radius_of(profile, place_of(profile, value))) for value in self.load.normal_range
        )
        return float(stick), least if self.load.normal_range[0] > 0.0 else 0.0, largest

    @property
    def moved(self) -> bool:
        """True if a bulk stress moves the stick zone."""
        return bool(self.memory[0].shift != 0.0)

    @property
    def stick_zone(self) -> tuple[float, float]:
        """Ends x/a_H of the permanent stick zone, NaN where there is none."""
        radius = self.radii[0]
        off = self.centre(self.place(np.array([radius])))[0]
        return off - radius, off + radius

    def centre(self, place: FloatArray) -> FloatArray:
        """Centres x/a_H of stick zones of sizes s, (n,): off the axis where a bulk stress moves them."""
        cycle = self.memory[0]
        own = self.profile, cycle.shift, cycle.largest, self.largest
        return np.array([centre_of(*own, float(s)) if self.moved else 0.0 for s in place])

    @property
    def oscillations(self) -> int:
        """Number of times that the load oscillates in a period, as its fastest component does."""
        if self.points.path is None:
            return int(max(self.points.p[0], self.points.q[0]))
        load = self.load
        count = load.terms
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
        cycle, growth = self.memory[:2]
        own = np.mod(instant * self.load.rounds, 2.0 * np.pi) * (float(self.load.period) / (2.0 * np.pi))
        found = new_records(len(instant), STATE)
        write_states(cycle, growth, self.profile, self.load, self.conjugate, own, found)
        return found

    def instants(self, steps: int, x: float | None = None) -> FloatArray:
        """Cosine-spaced angles φ between the events of the cycle, also the events at x/a_H, ascending."""
        cycle, growth, _, history, _, tables = self.memory
        load = self.load
        times = cycle.time[: cycle.stretches]
        if x is not None:
            write_parts(history, cycle, growth, self.profile, tables, load, *self._at(x))
            times = history.time[: history.parts]
        share = 0.5 - 0.5 * np.cos(np.pi / steps * np.arange(steps + 1))
        own_times = (times[:, :1] + np.diff(times) * share).ravel()
        if load.mirrored:
            own_times = np.append(own_times, own_times + 0.5 * load.period)
        turn = np.mod(own_times, load.period) / load.period
        every = (np.arange(load.rounds)[:, None] + np.append(turn, [0.0, 1.0])) / load.rounds
        return 2.0 * np.pi * np.unique(np.clip(every, 0.0, 1.0))

    def _at(self, x: float) -> tuple[float, ...]:
        """Place s of x/a_H and of the largest contact, the side of x, ν and μ."""
        place, side = float(self.place(np.array(abs(x)))), -1.0 if x < 0.0 else 1.0
        return place, self.largest, side, float(self.ask.poisson_ratio), float(self.ask.friction)

    def stress(self, x: float, states: np.recarray[Any, Any]) -> dict[str, FloatArray]:
        """Stress at x/a_H on the line at T states, each (T,), in E* √(δ0/R).

        Returns
        -------
        dict
            ``xx``, ``yy``, ``zz``, ``xz``, tension positive, and ``bulk``, its part of xx.
        """
        cycle, growth, _, history, _, tables = self.memory
        ν, own = float(self.ask.poisson_ratio), self._at(x)
        write_stress(history, cycle, growth, self.profile, tables, states, *own)
        side, T = own[2], len(states)
        p, within, xx, yy, q, bulk = (
            history[name][:T].copy() for name in ("p", "within", "xx", "yy", "q", "bulk")
        )
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
        history, work, T = self.memory[3], self.memory[4], len(states)
        fill(history, work, np.sign(x), self.ask)
        C, S = np.cos(double_angle), np.sin(double_angle)
        of_b, of_c = swing_weights(self.ask, C, S)
        a, b, c, d = (work[name][:T] for name in "abcd")
        scale = 1.0 - float(self.ask.poisson_ratio) ** 2 if self.ask.criterion == 0 else 1.0
        return a + b * C + c * S, (d + of_b * b + of_c * c) / scale

    def along(self, radius: FloatArray) -> tuple[FloatArray, FloatArray]:
        """The criterion and 2θ of its plane at x = ±radius, each of shape (X, 2)."""
        cycle, growth, search, history, work, tables = self.memory
        values, angles = np.zeros((2, len(radius), 2))
        of_cycle = cycle, growth, self.profile, tables, self.load, self.ask
        write_values(search, history, work, *of_cycle, self.largest, self.place(radius), values, angles)
        return values, angles

    def springs(self, radius: FloatArray, states: np.recarray[Any, Any]) -> tuple[FloatArray, FloatArray]:
        """Compression and tangential force of springs, each (T, X).

        w in δ0, and τ = G* u_MDR/(μ E* δ0), |τ| ≤ w. In the plane, where strips have no springs, what the
        diagram has in their place: N − N(ξ) over P_0, and the tangential force over μP_0.
        """
        cycle, growth = self.memory[:2]
        compression, force = np.zeros((2, len(states), len(radius)))
        place = np.maximum(self.place(radius), 0.0)
        own = cycle, growth, self.profile, self.load, self.conjugate
        write_springs(*own, states, place, self.largest, compression, force)
        return compression, force

    def cusps(self) -> FloatArray:
        """Ascending places s between which the criterion is smooth along the line."""
        search, own = self.memory[2], (self.profile, self.load, self.ask, self.largest)
        count = cusps(search, self.memory[0], *own)
        return search.cusp[:count].copy()
