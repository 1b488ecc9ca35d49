"""Cosine-spaced places: dense at both ends, where functions may begin like square roots."""

from __future__ import annotations

import numpy as np

from swtstudy.mechanics.points import FloatArray


def between(low: FloatArray, high: FloatArray, angle: FloatArray) -> FloatArray:
    """Places between ``low`` (α = 0) and ``high`` (α = π) at the angle α."""
    return low + (high - low) * (0.5 - 0.5 * np.cos(angle))
