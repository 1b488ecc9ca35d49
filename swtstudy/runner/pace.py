"""How long points take, and so how many of them make a chunk."""

from __future__ import annotations

from swtstudy.grid.cost import SECONDS_PER_WEIGHT
from swtstudy.records.result import Result

#: Seconds of work in a chunk: long against what it costs to send one, short enough to lose.
CHUNK_SECONDS = 0.7

#: More than this in one chunk would make a part of the archive that takes long to write.
_LARGEST_WEIGHT = 10_000

#: The first chunks are this part of the later ones: they are there to be timed, and to be saved soon.
_FIRST_PART = 0.2


class Pace:
    """Running mean of the seconds that points take a worker, by their weight."""

    def __init__(self) -> None:
        self.seconds_per_weight = SECONDS_PER_WEIGHT / _FIRST_PART
        self._first = True

    def update(self, result: Result, weight: int) -> None:
        """Take the timing of one more result into account."""
        timed = max(result.seconds, 1e-9) / weight
        self.seconds_per_weight = timed if self._first else (self.seconds_per_weight + timed) / 2
        self._first = False

    def chunk_weight(self) -> float:
        """Weight of a chunk that takes a good time."""
        return min(_LARGEST_WEIGHT, CHUNK_SECONDS / self.seconds_per_weight)
