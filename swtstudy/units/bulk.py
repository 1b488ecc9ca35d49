"""The mean of a bulk stress from its stress ratio."""

from __future__ import annotations

from typing import Any

from swtstudy.mechanics.load.loop import Loop


def ends_of_bulk(load: object) -> tuple[float, float]:
    """Least and largest value of what the amplitude of the bulk stress scales."""
    if isinstance(load, Loop):
        return (0.0, 0.0) if load.bulk is None else load.bulk.ends
    return -1.0, 1.0


def mean_of_bulk(ratio: Any, amplitude: Any, least: Any, largest: Any) -> Any:
    """The mean at which a bulk stress between these `ends_of_bulk` has a ratio of least over largest."""
    return amplitude * (ratio * largest - least) / (1.0 - ratio)
