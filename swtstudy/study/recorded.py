"""Averages of the cycles that a rig records: pure functions on arrays."""

from __future__ import annotations

import numpy as np

from swtstudy.mechanics.points import FloatArray

#: By what share of a step a record may be shorter than a whole number of periods.
ROUNDING = 1e-6


def period_of(time: FloatArray, recorded_cycles: int) -> float:
    """Period of a record that holds a number of cycles, each sample once: the first is not the last again."""
    return float((time[-1] - time[0]) * len(time) / (len(time) - 1) / recorded_cycles)


def whole_cycles(time: FloatArray, period: float) -> int:
    """Number of whole cycles in a record."""
    step = (time[-1] - time[0]) / (len(time) - 1)
    return int((time[-1] - time[0] + step * (1.0 + ROUNDING)) / period)


def folded(time: FloatArray, values: FloatArray, period: float, count: int) -> FloatArray:
    """The first whole cycles of a record at even phases, as many as it has samples in a cycle.

    Parameters
    ----------
    time
        Shape (k,), ascending.
    values
        Shape (k, d).
    period, count
        Length of a cycle, and how many.

    Returns
    -------
    array
        Shape (count, m, d); straight lines between the samples.
    """
    step = (time[-1] - time[0]) / (len(time) - 1)
    phases = max(2, round(period / step))
    at = time[0] + period * (np.arange(count)[:, None] + np.arange(phases) / phases)
    return np.stack([np.interp(at, time, column) for column in values.T], axis=-1)


def scatter(cycles: FloatArray) -> FloatArray:
    """Standard deviation of cycles (c, m, d) from their mean, root mean square over phases, shape (d,)."""
    count = len(cycles)
    if count < 2:
        return np.full(cycles.shape[-1], np.nan)
    variance = cycles.var(axis=0, ddof=1)
    return np.asarray(np.sqrt(variance.mean(axis=0)))


def mean_over(time: FloatArray, values: FloatArray, period: float) -> float:
    """Mean of one closed cycle over the time, by straight lines; the samples need not be even."""
    at, closed = np.append(time, time[0] + period), np.append(values, values[0])
    return float(np.sum(np.diff(at) * 0.5 * (closed[1:] + closed[:-1])) / period)


def harmonics(phase: FloatArray, values: FloatArray, highest: int) -> tuple[FloatArray, FloatArray]:
    """The harmonics that fit a column best, in the sense of least squares, and the fit.

    Parameters
    ----------
    phase
        Shape (k,): φ of each sample, rad.
    values
        Shape (k,).
    highest
        The highest order.

    Returns
    -------
    rows
        Shape (highest + 1, 3): order, amplitude and phase of amplitude · sin(order · φ + phase).
    fit
        Shape (k,).
    """
    order = np.arange(1, highest + 1)
    waves = np.outer(phase, order)
    base = np.concatenate([np.ones((len(phase), 1)), np.sin(waves), np.cos(waves)], axis=1)
    found = np.linalg.lstsq(base, values, rcond=None)[0]
    sine, cosine = found[1 : highest + 1], found[highest + 1 :]
    rows = np.stack([order, np.hypot(sine, cosine), np.arctan2(cosine, sine)], axis=1)
    return np.concatenate([[[0.0, found[0], 0.5 * np.pi]], rows]), base @ found
