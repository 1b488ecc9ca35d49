"""The memory diagram from what is prescribed: the load in its coordinate, and that coordinate.

A load whose normal component is prescribed in the other coordinate than the diagram's is mapped.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from swtstudy.mechanics.control.coordinate import (
    Coordinate,
    DepthCoordinate,
    ForceCoordinate,
    profile_up_to_force,
    unit_half_load,
)
from swtstudy.mechanics.control.normal_map import DepthOfForce, ForceOfDepth, NormalMap, TabledMap
from swtstudy.mechanics.indenter import make_profile
from swtstudy.mechanics.indenter.base import Profile
from swtstudy.mechanics.indenter.profile_table import AnyProfile
from swtstudy.mechanics.load.bimodal import BimodalLoad
from swtstudy.mechanics.load.load import PERIOD, Load
from swtstudy.mechanics.load.polygon import PolygonLoad
from swtstudy.mechanics.numerics.arrays import SAME, TINY, between, filled_rows
from swtstudy.mechanics.numerics.roots import Brackets, Function, monotone_roots, sign_changes
from swtstudy.mechanics.points import BoolArray, FloatArray, IndexArray, IntArray, Shape
from swtstudy.vocabulary.choices import is_plane
from swtstudy.vocabulary.parameters import Control

#: Instants between two turns of the normal load to look for turns of a slip line: so many, and for each
#: tangential oscillation, and wave passed. Half or twice: 1e-3 at 1 of 144 points; 1,000 more: 5e-3 there.
LEAST_COUNT, COUNT_PER_OSCILLATION, COUNT_PER_WAVE = 8, 32, 12
#: The first of them lies so far behind the turn, in shares of π of the cosine's angle: where contact is made
#: the map's derivative jumps. 1e-2: 6e-3 at 1 of 144 points; 1e-6: 2e-5 there.
INSIDE = 1e-4


@dataclass(frozen=True)
class MappedLoad(Load):
    """n harmonic loads with their normal components mapped.

    Attributes
    ----------
    given
        The loads as they are prescribed.
    map
        n monotone functions to the normal loads of the diagram.
    waves
        How many waves of the indenter the contact edge passes at most.
    """

    given: BimodalLoad
    map: NormalMap
    waves: float

    def __len__(self) -> int:
        return len(self.given)

    def normal(self, instant: FloatArray) -> FloatArray:
        return self.map.value(self.given.normal(instant))

    def tangential(self, instant: FloatArray) -> FloatArray:
        return self.given.tangential(instant)

    def normal_rate(self, instant: FloatArray) -> FloatArray:
        return self.map.slope(self.given.normal(instant)) * self.given.normal_rate(instant)

    def tangential_rate(self, instant: FloatArray) -> FloatArray:
        return self.given.tangential_rate(instant)

    @property
    def least_normal(self) -> FloatArray:
        return self.map.value(self.given.least_normal)

    @property
    def largest_normal(self) -> FloatArray:
        return self.map.value(self.given.largest_normal)

    @property
    def motion(self) -> FloatArray:
        return np.asarray(self.normal_motion + self.given.tangential_amplitude)

    @property
    def has_tangential(self) -> BoolArray:
        return self.given.has_tangential

    @property
    def moves_tangentially(self) -> BoolArray:
        return self.given.moves_tangentially

    @property
    def oscillations(self) -> tuple[int, int]:
        return self.given.oscillations

    @property
    def mirrored_half(self) -> bool:
        return self.given.mirrored_half

    def turning_instants(self) -> FloatArray:
        turns = self.given.normal_turning_instants()
        columns = [turns, *(self._turning_points_of_slip_line(sign, turns) for sign in (1.0, -1.0))]
        return np.sort(np.concatenate(columns, axis=1), axis=1)

    def branch(self, instant: FloatArray) -> IntArray:
        return self.given.branch(instant)

    def touch_down(self, normal: FloatArray, branch: IntArray) -> FloatArray:
        return self.given.touch_down(self.map.inverse(normal), branch)

    def growth_slope(self, normal: FloatArray, branch: IntArray) -> FloatArray:
        given, slope = self.map.inverse_and_slope(normal)
        rate, normal_rate = self.given.rates_at_touch_down(given, branch)
        normal_rate = normal_rate * slope
        ratio = np.divide(rate, normal_rate, out=np.zeros_like(rate), where=normal_rate > TINY)
        return -np.clip(ratio, -1.0, 1.0)

    def passage(self, normal: FloatArray, begin: FloatArray, end: FloatArray) -> FloatArray:
        return self.given.passage(self.map.inverse(normal), begin, end)

    def slip_line_brackets(self, sense: float, low: FloatArray, high: FloatArray) -> Brackets:
        return Brackets.of(self._slip_line(sense), low, high)

    def slip_line_instant(self, sense: float, goal: FloatArray, brackets: Brackets) -> FloatArray:
        return monotone_roots(self._slip_line(sense), goal, brackets)

    def _slip_line(self, sense: float) -> Function:
        """The slip line sense·tangential − normal of the loads, and two derivatives."""
        given, p, q = self.given, self.given.p, self.given.q

        def line(instant: FloatArray, active: IndexArray) -> tuple[FloatArray, FloatArray, FloatArray]:
            d, psi, u = (v[active] for v in (given.normal_amplitude, given.phase, given.tangential_amplitude))
            ground, own, u = q * instant + psi, p * instant, sense * u
            sine, rate, u_sine = d * np.sin(ground), q * d * np.cos(ground), u * np.sin(own)
            value, slope, bend = self.map.take(active).with_derivatives(1.0 + sine)
            first = p * u * np.cos(own) - slope * rate
            return u_sine - value, first, q * q * slope * sine - bend * rate * rate - p * p * u_sine

        return line

    def _turning_points_of_slip_line(self, sense: float, turns: FloatArray) -> FloatArray:
        """Zeros of d(sense·tangential − normal)/dφ in a period, shape (n, k), filled up with its end.

        Between two of the normal load's ``turns`` the rate is smooth but for its ends, where the map's
        derivative may have no bound: cosine-spaced instants resolve it.
        """
        n, m = turns.shape
        low = turns
        high = np.concatenate([turns[:, 1:], turns[:, :1] + PERIOD], axis=1)
        angle = np.pi * np.linspace(INSIDE, 1.0 - INSIDE, self._sample_count() + 1)
        instant = between(low[..., None], high[..., None], angle)
        samples = self._slip_line_rate(sense, instant.reshape(n, -1))
        row, first, last = sign_changes(angle, samples.reshape(n * m, -1))
        slip_line = self.take(row // m)._slip_line(sense)

        def rate(at: FloatArray, active: IndexArray) -> tuple[FloatArray, FloatArray, FloatArray]:
            _, slope, bend = slip_line(at, active)
            return slope, bend, np.zeros_like(slope)

        begin, end = (between(low.take(row), high.take(row), where) for where in (first, last))
        zero = np.zeros(len(row))
        roots = monotone_roots(rate, zero, Brackets.of(rate, begin, end), SAME)
        return filled_rows(row // m, np.mod(roots, PERIOD), n, PERIOD)

    def _slip_line_rate(self, sense: float, instant: FloatArray) -> FloatArray:
        return sense * self.tangential_rate(instant) - self.normal_rate(instant)

    def _sample_count(self) -> int:
        normal, tangential = self.oscillations
        count = LEAST_COUNT + COUNT_PER_OSCILLATION * max(0.5 * tangential / normal, 0.5)
        return math.ceil(count + COUNT_PER_WAVE * self.waves)


def largest_depth(control: Control, name: AnyProfile, shape: Shape, largest_normal: FloatArray) -> FloatArray:
    """Largest indentation depth over δ0 at the largest normal load, as it is prescribed; shape (n,)."""
    if not control.normal_force:
        return largest_normal
    return profile_up_to_force(name, shape, largest_normal)[0].largest_depth


def diagram(control: Control, name: AnyProfile, shape: Shape, load: Load) -> tuple[Load, Coordinate]:
    """The load in the coordinate of its memory diagram, and that coordinate.

    The coordinate is that of the tangential load, into which the normal load is mapped where the two differ.

    Parameters
    ----------
    control
        What is prescribed.
    name, shape
        Family and shape parameters, each of shape (n,), of n profiles of one roughness.
    load
        n loads as they are prescribed.

    Raises
    ------
    ValueError
        If a polygon is prescribed by a force and a displacement and its normal load is not constant: its
        sides are no straight lines of the diagram.
    """
    if control.normal_force or is_plane(name):
        profile, unit = profile_up_to_force(name, shape, load.largest_normal)
    else:
        profile = make_profile(name, shape, load.largest_normal)
        unit = unit_half_load(name, shape, len(load)) if control.tangential_force else np.ones(0)
    if profile.plane:
        # A load that rests may be said to be of displacements: there are only forces.
        return load, ForceCoordinate(profile, unit)
    coordinate = ForceCoordinate(profile, unit) if control.tangential_force else DepthCoordinate(profile)
    if not control.mixed:
        return load, coordinate
    force = ForceCoordinate(profile, unit)
    exact = DepthOfForce(force) if control.normal_force else ForceOfDepth(force)
    if not isinstance(load, BimodalLoad):
        return _mapped_polygon(load, exact), coordinate
    tables = profile.tables()
    return MappedLoad(
        load, exact if tables is None else TabledMap.of(exact, tables), _waves(profile)
    ), coordinate


def _mapped_polygon(load: Load, normal_map: NormalMap) -> Load:
    """The polygon with its normal component mapped."""
    if not isinstance(load, PolygonLoad) or np.any(load.largest_normal != load.least_normal):
        raise ValueError(
            "a loop whose normal load is not constant needs two displacements or two forces: "
            "with one of each its straight sides are curved in the memory diagram"
        )
    return load.with_normal(normal_map.value)


def _waves(profile: Profile) -> float:
    """Largest number of waves of the profiles that the edge passes."""
    reach = profile.radius(profile.largest_depth)
    return float(np.max(reach / profile.feature_length, initial=0.0))
