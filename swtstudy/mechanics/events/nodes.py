"""Cosine-spaced instants on the smooth stretches of the cycle."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.contact.cycle import Cycle
from swtstudy.mechanics.events.stretches import GAP, PER_INTERVAL, Stretches
from swtstudy.mechanics.numerics.arrays import gather, packed
from swtstudy.mechanics.numerics.cosine import between
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.rows import Rows

T = TypeVar("T", bound=np.generic)


@dataclass(frozen=True)
class Nodes(Rows):
    """Instants at n × X positions, T each.

    Where no event cuts an interval, all positions have the same instants: they are listed once.

    Attributes
    ----------
    interval, instant
        Shape (n, k): the distinct instants φ, and their intervals of the cycle.
    index
        Shape (n, X, T): which of the k.
    """

    interval: NDArray[np.intp]
    instant: FloatArray
    index: NDArray[np.intp]

    def spread(self, values: NDArray[T]) -> NDArray[T]:
        """Values at the distinct instants, shape (n, k), at the instants of each position, (n, X, T)."""
        return values.ravel().take(self._flat)

    @cached_property
    def _flat(self) -> NDArray[np.intp]:
        n, distinct = self.instant.shape
        return np.arange(n)[:, None, None] * distinct + self.index


@dataclass(frozen=True)
class Placed(Rows):
    """Where nodes lie, each of shape (n, X, T).

    Attributes
    ----------
    stretch
        Number of the stretch.
    place
        Number of the node in it, from 0 to the number of its steps.
    """

    stretch: NDArray[np.intp]
    place: NDArray[np.intp]

    @property
    def interval(self) -> NDArray[np.intp]:
        """Number of the interval of the cycle."""
        return self.stretch // PER_INTERVAL


def cosine_nodes(cycle: Cycle, parts: Stretches, count: int) -> tuple[Nodes, Placed]:
    """Cosine-spaced nodes on each stretch with a length, without repetitions where stretches meet.

    Parameters
    ----------
    cycle
        n cycles.
    parts
        At n × X positions.
    count
        Number of steps of each stretch.
    """
    placed = _places(parts, count)
    angle = np.pi * np.arange(count + 1) / count
    common = between(cycle.begin[..., None], cycle.end[..., None], angle).reshape(len(cycle.begin), -1)
    n, shape = len(common), placed.stretch.shape
    low, high = (gather(side, placed.stretch).reshape(n, -1) for side in (parts.low, parts.high))
    interval, place = placed.interval.reshape(n, -1), placed.place.reshape(n, -1)
    own = (low != gather(cycle.begin, interval)) | (high != gather(cycle.end, interval))
    # The common instants of all intervals come first, then those of the positions.
    index = np.where(own, common.shape[1] + np.cumsum(own, axis=1) - 1, interval * (count + 1) + place)
    # A row without instants of its own keeps one for the others' sake.
    own[:, 0] |= ~own.any(axis=1)
    (own_interval,), (own_instant,) = packed(own, interval), packed(own, between(low, high, angle[place]))
    of_common = np.broadcast_to(np.repeat(np.arange(cycle.begin.shape[1]), count + 1), common.shape)
    nodes = Nodes(
        np.concatenate([of_common, own_interval], axis=1),
        np.concatenate([common, own_instant], axis=1),
        index.reshape(shape),
    )
    return nodes, placed


def _places(parts: Stretches, count: int) -> Placed:
    """All nodes of the stretches with a length, but for the last one of each that meets the next."""
    total = parts.low.shape[-1]
    after = np.append(parts.next_real[..., 1:], np.full((*parts.low.shape[:-1], 1), total), axis=-1)
    gap = gather(parts.low, np.minimum(after, total - 1)) - parts.high
    keep = np.repeat(parts.real[..., None], count + 1, axis=-1)
    keep[..., -1] &= ~((after < total) & (gap <= GAP))
    keep = keep.reshape(*parts.low.shape[:-1], -1)
    (number,) = packed(keep, np.broadcast_to(np.arange(keep.shape[-1]), keep.shape))
    return Placed(number // (count + 1), number % (count + 1))
