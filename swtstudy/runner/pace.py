"""How long points take, and so how many of them make a chunk."""

from __future__ import annotations

from swtstudy.runner.chunk import Result

#: Seconds of work in a chunk: long against what it costs to send one, short enough to lose.
_CHUNK_SECONDS = 0.4

#: Points of the first chunk, solved to see how long they take.
PROBE_POINTS = 4

_LARGEST_CHUNK = 20_000


class Pace:
    """Running mean of the seconds that a point takes a worker."""

    def __init__(self) -> None:
        self.seconds_per_point = 0.0

    def update(self, result: Result) -> None:
        """Take the timing of one more result into account."""
        new = result.seconds / len(result)
        self.seconds_per_point = new if not self.seconds_per_point else (self.seconds_per_point + new) / 2

    def chunk_size(self) -> int:
        """Points that make a good chunk."""
        if not self.seconds_per_point:
            return PROBE_POINTS
        return max(1, min(_LARGEST_CHUNK, round(_CHUNK_SECONDS / self.seconds_per_point)))
