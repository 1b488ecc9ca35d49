"""Springs of a contact marched through any path of the load: an oracle apart from the solver."""

from __future__ import annotations

import numpy as np

from swtstudy.vocabulary.arrays import FloatArray


def march_springs(
    g: FloatArray, depth: FloatArray, displacement: FloatArray, periods: int = 2
) -> tuple[FloatArray, FloatArray]:
    """Compression w = δ − g and tangential force τ of springs by the clip rule |τ| ≤ w, shape (T, k).

    ``depth`` and ``displacement``, shape (T,), are one period from rest; the last of ``periods`` is returned.
    """
    w = np.maximum(depth[:, None] - g, 0.0)
    tau = np.zeros_like(w)
    rise, du = np.diff(depth), np.diff(displacement)
    for _ in range(periods):
        tau[0] = tau[-1]
        for i in range(1, len(depth)):
            # A spring that touches down within the step feels only what u does after that.
            part = w[i] / rise[i - 1] if rise[i - 1] > 0.0 else 0.0
            felt = np.where(w[i - 1] > 0.0, 1.0, part)
            tau[i] = np.clip(tau[i - 1] + felt * du[i - 1], -w[i], w[i])
    return w, tau
