"""A bulk stress: a uniaxial stress along x that one body carries besides the contact, B(t) in its σ_xx.

It is a component of the load's stationary cycle of which the contact knows nothing: the tractions are those
without it, and the stress is the sum of both.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.load.load import PERIOD, BulkCourse
from swtstudy.mechanics.numerics.arrays import align
from swtstudy.mechanics.planes.criterion import Criterion
from swtstudy.mechanics.points import BoolArray, FloatArray, Points, Rows


class BulkStress(Rows, ABC):
    """n bulk stresses of one kind, over the angle φ of the load's common period; in E* √(δ0/R)."""

    @abstractmethod
    def at(self, instant: FloatArray) -> FloatArray:
        """B at instants φ of shape (n, …)."""

    @property
    @abstractmethod
    def least(self) -> FloatArray:
        """Shape (n,): least B of the cycle."""

    @property
    @abstractmethod
    def largest(self) -> FloatArray:
        """Shape (n,): largest B of the cycle."""

    @abstractmethod
    def turning_instants(self) -> FloatArray:
        """Instants at which B turns but the load need not, shape (n, k), filled up with `PERIOD`."""

    @property
    def moves(self) -> BoolArray:
        """Shape (n,): which change over the cycle."""
        return np.asarray(self.largest > self.least)

    def far_field(
        self, poisson_ratio: FloatArray, criterion: Criterion, plane: bool
    ) -> tuple[FloatArray, FloatArray]:
        """The criterion far from the contact and 2θ of its plane, rad, each (n,): of the bulk stress alone.

        Alone it is uniaxial, or in a ``plane`` contact one of plane strain.
        """
        amplitude = 0.5 * (self.largest - self.least)
        return criterion.far_field(self.largest, amplitude, poisson_ratio, plane)


@dataclass(frozen=True)
class HarmonicBulk(BulkStress):
    """n bulk stresses that oscillate with the tangential load, B = mean + amplitude sin(pφ + phase).

    Attributes
    ----------
    mean, amplitude, phase
        Shape (n,).
    p
        Oscillations in a period.
    """

    mean: FloatArray
    amplitude: FloatArray
    phase: FloatArray
    p: int

    def at(self, instant: FloatArray) -> FloatArray:
        mean, amplitude, phase = (align(v, instant) for v in (self.mean, self.amplitude, self.phase))
        return mean + amplitude * np.sin(self.p * instant + phase)

    @property
    def least(self) -> FloatArray:
        return self.mean - self.amplitude

    @property
    def largest(self) -> FloatArray:
        return self.mean + self.amplitude

    def turning_instants(self) -> FloatArray:
        quarter = np.pi * (np.arange(2 * self.p) + 0.5)
        return np.sort(np.mod((quarter - self.phase[:, None]) / self.p, PERIOD), axis=1)


@dataclass(frozen=True)
class LoopBulk(BulkStress):
    """n bulk stresses that go with a loop, B = mean + amplitude c_b.

    Attributes
    ----------
    mean, amplitude
        Shape (n,).
    course
        c_b.
    """

    mean: FloatArray
    amplitude: FloatArray
    course: BulkCourse

    def at(self, instant: FloatArray) -> FloatArray:
        return align(self.mean, instant) + align(self.amplitude, instant) * self.course.value(instant)

    @property
    def least(self) -> FloatArray:
        return self.mean + self.amplitude * self.course.ends[0]

    @property
    def largest(self) -> FloatArray:
        return self.mean + self.amplitude * self.course.ends[1]

    def turning_instants(self) -> FloatArray:
        return np.tile(self.course.turns, (len(self.mean), 1))


def bulk_of(points: Points) -> BulkStress | None:
    """The bulk stresses of points with one course of the load; None where no point has any."""
    mean, amplitude = points.bulk_stress_mean, points.bulk_stress_amplitude
    if not (mean.any() or amplitude.any()):
        return None
    if points.path is not None and points.path.bulk is not None:
        return LoopBulk(mean, amplitude, points.path.bulk)
    return HarmonicBulk(mean, amplitude, points.bulk_stress_phase, int(points.p[0]))


def bulk_kind(points: Points) -> NDArray[np.int64]:
    """0 for points without bulk stress, 1 for a constant one, 2 for one that moves, shape (n,)."""
    steady = (points.bulk_stress_mean != 0.0).astype(np.int64)
    return np.where(points.bulk_stress_amplitude != 0.0, 2, steady)
