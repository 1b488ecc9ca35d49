"""The mean of a bulk stress from its stress ratio."""

from __future__ import annotations

from swtstudy.mechanics.load.loop import Loop


def ends_of_bulk(load: object) -> tuple[float, float]:
    """Least and largest value of what the amplitude of the bulk stress scales."""
    if isinstance(load, Loop):
        return (0.0, 0.0) if load.bulk is None else load.bulk.ends
    return -1.0, 1.0
