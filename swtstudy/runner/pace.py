"""The pace of a run: seconds per point, and from that the size of its chunks."""

from __future__ import annotations

from swtstudy.points.cost import SECONDS_PER_WEIGHT

#: Seconds of work in a chunk: long compared with the cost of sending one, short enough to lose.
CHUNK_SECONDS = 0.7

#: Largest weight of a chunk: the part of the archive that it becomes is written quickly.
_LARGEST_WEIGHT = 10_000

#: Size of the first chunks, as a fraction of later ones: they are timed, and soon saved.
_FIRST_FRACTION = 0.2

#: Shortest time that counts, in seconds, so that none is 0: a coarse clock.
_CLOCK_TICK = 1e-9


class Pace:
    """Running mean of a worker's seconds per unit of weight."""

    def __init__(self) -> None:
        self.seconds_per_weight = SECONDS_PER_WEIGHT / _FIRST_FRACTION
        self._first = True

    def update(self, seconds: float, weight: int) -> None:
        """Take the timing of one more chunk into account."""
        timed = max(seconds, _CLOCK_TICK) / weight
        self.seconds_per_weight = timed if self._first else (self.seconds_per_weight + timed) / 2
        self._first = False

    def chunk_weight(self) -> float:
        """Weight of a chunk that takes `CHUNK_SECONDS`, within bounds."""
        return min(_LARGEST_WEIGHT, CHUNK_SECONDS / self.seconds_per_weight)
