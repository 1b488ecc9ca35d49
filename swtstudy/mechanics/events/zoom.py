"""Closer looks at the extremes over the cycle.

The extreme found at a node lies between the node's neighbours. Around a node inside of a stretch these are in
the same stretch; around the end of a stretch, where the stress may have a cusp, they are in two. Both sides
are walked in the angle α of their cosine-spaced nodes, in which the stress is smooth. Where a short stretch
meets a long one, what happened in the short one makes a thin layer in the long one, too: there the samples
are graded from its thickness on.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.events.stretches import PER_INTERVAL, Nodes, Stretches, meet
from swtstudy.mechanics.numerics.arrays import T, between, gather, pick
from swtstudy.mechanics.numerics.roots import parabola, polynomial_maximum, powers_from_values
from swtstudy.mechanics.points import BoolArray, FloatArray, IndexArray, Rows

#: Steps into which each side of a bracket is divided. One: 2e-3 at 18 of 128 points at rtol 1e-5; six: 2e-6,
#: no faster.
STEPS = 3
OFFSETS = np.arange(-STEPS, STEPS + 1) / STEPS
#: Number of the last sample.
LAST = 2 * STEPS
#: Where the first sample is in a layer, in α over that of the layer's thickness, and the share of an even
#: step below which a layer is thin. Without: 6e-4 at a point of tests/mechanics/test_narrow_maxima.py.
IN_LAYER, THIN = 2.0 / 3.0, 1.0 / 3.0


@dataclass(frozen=True)
class TimeBrackets(Rows):
    """Brackets of e extremes at n × X positions, walked by c from −1 (left neighbour) to 1 (right one).

    Attributes
    ----------
    low, high, interval, start
        Shape (n, X, e, 2), for the left and the right side: the ends of the stretch, its interval of the
        cycle, and the angle α at c = 0.
    step
        Change of α between c = 0 and 1.
    grading
        Shape (n, X, e, 2): by how much the logarithm of dα/dc grows from c = 0 to 1.
    corner
        Shape (n, X, e): whether stretches meet at c = 0.
    centre
        Shape (n, X, e): c of the best instant so far.
    width
        Half the width of the bracket in c.
    """

    low: FloatArray
    high: FloatArray
    interval: IndexArray
    start: FloatArray
    step: float
    grading: FloatArray
    corner: BoolArray
    centre: FloatArray
    width: float

    @classmethod
    def around(
        cls,
        parts: Stretches,
        count: int,
        stretch: IndexArray,
        place: IndexArray,
        falling: BoolArray | None = None,
    ) -> TimeBrackets:
        """Brackets around nodes of `swtstudy.mechanics.events.stretches.cosine_nodes`.

        Parameters
        ----------
        parts
            The stretches.
        count
            Number of steps of each stretch.
        stretch, place
            Shape (n, X, e): see `swtstudy.mechanics.events.stretches.Placed`.
        falling
            Shape (n, X, e, 2): on which sides the nodes show no maximum, so that the samples may be graded.
        """
        at_begin, at_end = place == 0, place == count
        before, after = _neighbours(parts, stretch, at_begin, at_end)
        alpha = place * (np.pi / count)
        left = np.where(at_begin & (before != stretch), np.pi, alpha)
        right = np.where(at_end & (after != stretch), 0.0, alpha)
        sides = np.stack([before, after], axis=-1)
        flat = sides.reshape(*sides.shape[:2], -1)
        low, high = (gather(ends, flat).reshape(sides.shape) for ends in (parts.low, parts.high))
        start, corner = np.stack([left, right], axis=-1), at_begin | at_end
        interval = sides // PER_INTERVAL
        step = np.pi / count
        grading = np.zeros(start.shape)
        if falling is not None:
            _grade(grading, high - low, corner, falling, step)
        return cls(low, high, interval, start, step, grading, corner, np.zeros(place.shape), 1.0)

    def or_other(self, own: BoolArray, other: TimeBrackets) -> TimeBrackets:
        """These brackets where ``own``, shape (n, X, e), elsewhere other ones of the same step and width."""
        two = own[..., None]
        return replace(
            self,
            low=np.where(two, self.low, other.low),
            high=np.where(two, self.high, other.high),
            interval=np.where(two, self.interval, other.interval),
            start=np.where(two, self.start, other.start),
            grading=np.where(two, self.grading, other.grading),
            corner=np.where(own, self.corner, other.corner),
            centre=np.where(own, self.centre, other.centre),
        )

    def samples(self) -> Nodes:
        """The samples of the extremes, index of shape (n, X, e · k)."""
        c = self.centre[..., None] + self.width * OFFSETS
        right = c > 0.0

        def side(values: NDArray[T]) -> NDArray[T]:
            return np.where(right, values[..., 1:], values[..., :1])

        alpha = np.clip(side(self.start) + self._walked(c) * self.step, 0.0, np.pi)
        n, columns = c.shape[:2]
        instant = between(side(self.low), side(self.high), alpha).reshape(n, -1)
        index = np.broadcast_to(np.arange(instant.shape[1]), instant.shape).reshape(n, columns, -1)
        return Nodes(side(self.interval).reshape(n, -1), instant, index)

    def _walked(self, c: FloatArray) -> FloatArray:
        """Steps of α from c = 0 to each c, shape (n, X, e, k)."""
        steps = c.copy()
        for side, sign in enumerate((-1.0, 1.0)):
            graded = np.nonzero(self.grading[..., side])
            growth, some = self.grading[(*graded, side)][:, None], c[graded]
            share = (np.exp(growth * np.maximum(sign * some, 0.0)) - 1.0) / (np.exp(growth) - 1.0)
            steps[graded] = np.where(sign * some > 0.0, sign * share, some)
        return steps

    def narrowed(self, best: IndexArray) -> TimeBrackets:
        """The brackets around the best samples, shape (n, X, e)."""
        width = self.width / STEPS
        centre = np.clip(self.centre + self.width * OFFSETS[best], width - 1.0, 1.0 - width)
        return replace(self, centre=centre, width=width)

    def weights_at_peak(self, curve: FloatArray) -> FloatArray:
        """Weights of the samples that interpolate them at the maximum of each curve.

        A polynomial goes through all samples. Where two stretches meet at c = 0, each side has its own.

        Parameters
        ----------
        curve
            Shape (n, X, e, k).

        Returns
        -------
        Shape (n, X, e, k).
        """
        best = curve.argmax(axis=-1)
        top, place, left = pick(curve, best), best.astype(float), best < STEPS
        corner = self.corner & (self.centre == 0.0)
        for lowest, highest in ((1, STEPS - 1), (STEPS + 1, LAST - 1)):
            # Away from a corner both are the parabola around the best sample.
            middle = np.where(corner, np.clip(best, lowest, highest), np.clip(best, 1, LAST - 1))
            before, centre, after = (pick(curve, middle + k) for k in (-1, 0, 1))
            shift, rise = parabola(before, centre, after)
            higher = centre + rise > top
            top = np.where(higher, centre + rise, top)
            place, left = np.where(higher, middle + shift, place), np.where(higher, middle < STEPS, left)
        low = np.maximum(place - 1.0, np.where(corner & ~left, STEPS, 0))
        high = np.minimum(place + 1.0, np.where(corner & left, STEPS, LAST))
        start, low, high = (v / STEPS - 1.0 for v in (place, low, high))
        series = np.einsum("pk,...k->p...", POWERS[0], curve)
        at = np.nonzero(corner)
        of_side = POWERS[np.where(left[at], 1, 2)]
        series[:, *at] = np.einsum("mpk,mk->pm", of_side, curve[at])
        u = polynomial_maximum(series, start, low, high)[..., None] ** np.arange(LAST + 1)
        weights = np.einsum("...p,pk->...k", u, POWERS[0])
        weights[at] = np.einsum("mp,mpk->mk", u[at], of_side)
        # Never below what has been seen.
        worse = (weights * curve).sum(axis=-1) <= pick(curve, best)
        return np.where(worse[..., None], np.arange(LAST + 1) == best[..., None], weights)


def _grade(
    grading: FloatArray, length: FloatArray, corner: BoolArray, falling: BoolArray, step: float
) -> None:
    """Put `TimeBrackets.grading` where stretches of lengths (n, X, e, 2) meet at a ``corner``, (n, X, e)."""
    at = np.nonzero(corner)
    own = length[at]
    # α² is what grows like time at the begin of a stretch.
    share = (2.0 * IN_LAYER / step) * np.sqrt(own[:, ::-1] / own)
    thin = falling[at] & (share < THIN / STEPS)
    # With the ratio g from sample to sample, 1 + g + g² of the first are the whole.
    ratio = np.sqrt(1.0 / np.where(thin, share, 1.0 / STEPS) - 0.75) - 0.5
    grading[at] = np.where(thin, STEPS * np.log(ratio), 0.0)


def _interpolation() -> FloatArray:
    """Matrices from samples to powers of u = −1 … 1: through all samples, and through those on either side.

    Shape (3, k, k).
    """
    matrices = np.zeros((3, LAST + 1, LAST + 1))
    for matrix, used in zip(matrices, (slice(None), slice(STEPS + 1), slice(STEPS, None)), strict=True):
        powers = powers_from_values(OFFSETS[used])
        matrix[: len(powers), used] = powers
    return matrices


POWERS = _interpolation()


def _neighbours(
    parts: Stretches, stretch: IndexArray, at_begin: BoolArray, at_end: BoolArray
) -> tuple[IndexArray, IndexArray]:
    """The stretches before and after each node: its own inside of one, and where none meets it."""
    total = parts.low.shape[-1]
    # The cycle is periodic: before its first stretch comes its last one.
    last, following = parts.last_real, parts.next_real
    last = np.where(last < 0, last[..., -1:], last)
    following = np.where(following == total, following[..., :1], following)
    before = gather(last, np.where(at_begin, (stretch - 1) % total, stretch))
    after = gather(following, np.where(at_end, (stretch + 1) % total, stretch))
    alone = at_begin & ~meet(gather(parts.high, before), gather(parts.low, stretch))
    open_ = at_end & ~meet(gather(parts.high, stretch), gather(parts.low, after))
    return np.where(alone, stretch, before), np.where(open_, stretch, after)
