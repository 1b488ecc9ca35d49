"""Spikes of a record: samples apart from the samples beside them, or from all other cycles."""

from __future__ import annotations

import numpy as np

from swtstudy.study.cycles import FEWEST_CYCLES, FEWEST_SAMPLES, MEDIAN, folded, repeated, step_of
from swtstudy.vocabulary.arrays import BoolArray, FloatArray, IndexArray

#: A spike stands out by so many standard deviations, and by a share of the range: of the median cycle for a
#: sample apart from the other cycles, of the record for a single sample apart from the samples beside it.
SPIKE, SPIKE_SHARE, SINGLE_SHARE = 10.0, 0.5, 0.05
#: A spike of several samples lasts a share of a cycle at most, and so many samples where no other cycles tell
#: it from a load. It stands out by a share of the range. At its phase one of so many cycles has a spike at
#: most: more of them are the load of a longer period. The step up and the step back differ by less than a
#: factor: after a step that stays, a load may swing.
LASTING, MOST_IN_A_ROW, LASTING_SHARE, RARE, UNEQUAL = 0.1, 5, 0.1, 12, 2.0


def spikes(
    time: FloatArray, values: FloatArray, period: float, count: int, numbers: IndexArray
) -> tuple[BoolArray, FloatArray]:
    """Samples that stand out from the samples beside them, or from the median of the cycles.

    Parameters
    ----------
    time, values, period, numbers
        As of `folded`.
    count
        Number of whole cycles.

    Returns
    -------
    out
        Shape (k, d), True for spikes.
    usual
        Shape (k, d): the value that the other samples suggest, which is on the line between the samples
        beside a spike, and the median of the cycles at the phase of a sample apart from other cycles.
    """
    out, usual = _single_spikes(time, values, period * count)
    cycle = np.median(folded(time, values, period, numbers), axis=0)
    longest = int(LASTING * len(cycle))
    if len(numbers) < FEWEST_CYCLES:
        for width in range(2, min(longest, MOST_IN_A_ROW) + 1):
            own, line = _steps_and_back(time, values, period * count, width)
            out, usual = out | own, np.where(own, line, usual)
    median = repeated(time, period, cycle)
    off = np.abs(values - median)
    if len(numbers) > 1:
        # A pulse of every cycle is a load. The median of two cycles has half of a spike.
        out &= off > (0.5 if len(numbers) >= FEWEST_CYCLES else 0.25) * np.abs(values - usual)
    if len(numbers) < FEWEST_CYCLES:
        return out, usual
    # Far from the median cycle, and outside of its range or of both samples beside: the steep side of a cycle
    # that comes a little late is no spike.
    least = _least_spike(off, SPIKE_SHARE * np.ptp(cycle, axis=0))
    padded = np.pad(values, ((1, 1), (0, 0)), "reflect")
    beside = np.stack([padded[:-2], padded[2:]])
    outside = np.zeros_like(out)
    for others in (cycle, beside):
        outside |= (values > others.max(axis=0) + least) | (values < others.min(axis=0) - least)
    apart = outside & (off > least)
    noise, least = _least_spike(off, np.zeros(1)), _least_spike(off, LASTING_SHARE * np.ptp(cycle, axis=0))
    rarely = np.quantile(folded(time, off, period, numbers), 1.0 - 1.0 / RARE, axis=0, method="lower")
    is_far = off > np.maximum(least, SPIKE * repeated(time, period, rarely))
    for column in range(values.shape[1]):
        side = np.where(is_far[:, column], np.sign(values - median)[:, column], 0.0)
        apart[:, column] |= _rows_apart(
            values[:, column], side, off[:, column] <= noise[column], least[column], longest
        )
    apart &= ~out
    return out | apart, np.where(out, usual, median)


def _rows_apart(
    values: FloatArray, side: FloatArray, is_usual: BoolArray, least: float, longest: int
) -> BoolArray:
    """Rows of samples on one side of the median cycle, up to the longest, between samples that are on it.

    Parameters
    ----------
    values, side, is_usual
        Shape (k,): a column, 1 or -1 for samples above or below the median cycle, and True for samples on it.
    least
        How far all samples of a row are outside of the range of the two samples beside it.
    longest
        Number of samples in a row.
    """
    begins = np.flatnonzero(np.diff(side, prepend=np.nan))
    ends = np.append(begins[1:], len(side))
    inner = (begins > 0) & (ends < len(side))
    before, after = np.where(inner, begins - 1, 0), np.where(inner, ends, 0)
    low, high = np.minimum.reduceat(values, begins), np.maximum.reduceat(values, begins)
    outer = np.maximum(values[before], values[after]), np.minimum(values[before], values[after])
    is_outside = np.where(side[begins] > 0.0, low > outer[0] + least, high < outer[1] - least)
    is_short = (ends - begins <= max(longest, 1)) & (side[begins] != 0.0)
    return np.repeat(inner & is_short & is_usual[before] & is_usual[after] & is_outside, ends - begins)


def _single_spikes(time: FloatArray, values: FloatArray, length: float) -> tuple[BoolArray, FloatArray]:
    """Single samples off the line between the samples beside them, and the values on these lines.

    A spike of height h is h above the line between the samples beside it, and takes each of these samples
    below its own line, by h times the share of the spike in it. All three must give the same sign, and the
    smallest of the three heights counts: the tip of a triangle leaves the samples beside it on their lines,
    and a smooth tip takes all three to one side. Of two samples in a row the higher one is the spike.
    """
    if len(values) < FEWEST_SAMPLES:
        return np.zeros_like(values, bool), values.copy()
    time, values = _closed(time, values, length)
    share = ((time[1:-1] - time[:-2]) / (time[2:] - time[:-2]))[:, None]  # of the later sample in a line
    usual = (1.0 - share) * values[:-2] + share * values[2:]
    off = values[1:-1] - usual
    sign = np.sign(off[1:-1])
    before, after = -off[:-2] / share[:-2], -off[2:] / (1.0 - share[2:])
    height = np.min([sign * off[1:-1], sign * before, sign * after], axis=0)
    out = height > _least_spike(np.abs(off), SINGLE_SHARE * np.ptp(values, axis=0))
    beside = np.pad(height, ((1, 1), (0, 0)), mode="wrap")
    return out & (height >= np.maximum(beside[:-2], beside[2:])), usual[1:-1]


def _steps_and_back(
    time: FloatArray, values: FloatArray, length: float, width: int
) -> tuple[BoolArray, FloatArray]:
    """Samples in a row between a step and an equal step back, and the values on the line between their sides.

    A step is what the sample next to it is off the line through the two samples on its other side; see
    `_single_spikes`. All samples of the row are as far off the line between the samples beside it.
    """
    out, usual = np.zeros_like(values, bool), values.copy()
    time, values = _closed(time, values, length)
    size = len(time) - width - 3

    def off(at: int, near: int, other: int) -> FloatArray:
        """Distances of samples from the lines through two others, all by their places in a window."""
        one, two, three = (slice(place, place + size) for place in (at, near, other))
        share = ((time[one] - time[two]) / (time[three] - time[two]))[:, None]
        return np.asarray(values[one] - (1.0 - share) * values[two] - share * values[three])

    before, after = 1, width + 2
    steps = np.stack([off(before + 1, before, before - 1), off(after - 1, after, after + 1)])
    sign = np.sign(steps[0])
    low, high = (sign * steps).min(axis=0), (sign * steps).max(axis=0)
    is_spike = (low > LASTING_SHARE * np.ptp(values, axis=0)) & (high < UNEQUAL * low)
    if not is_spike.any():
        return out, usual
    offs = np.stack([off(place, before, after) for place in range(before + 1, after)])
    least = _least_spike(np.abs(offs[0]), LASTING_SHARE * np.ptp(values, axis=0))
    rows, columns = np.nonzero(is_spike & (np.minimum(low, (sign * offs).min(axis=0)) > least))
    for k in range(width):
        out[rows + k, columns] = True
        usual[rows + k, columns] -= offs[k][rows, columns]
    return out, usual


def _closed(time: FloatArray, values: FloatArray, length: float) -> tuple[FloatArray, FloatArray]:
    """The record with two samples more at each end: it goes on with itself after the length of its cycles."""
    least = 1e-6 * step_of(time)
    first, last = np.searchsorted(time, [time[-1] - length + least, time[0] + length - least])
    rows = np.concatenate([[last - 2, last - 1], np.arange(len(time)), [first, first + 1]])
    turns = np.repeat([-1.0, 0.0, 1.0], [2, len(time), 2])
    return time[rows] + turns * length, values[rows]


def _least_spike(off: FloatArray, share: FloatArray) -> FloatArray:
    """The least height of a spike, by column: `SPIKE` standard deviations, or a share of a range.

    The median of the deviations gives the standard deviation of normal noise, whatever the spikes are.
    """
    return np.maximum(SPIKE * np.median(off, axis=0) / MEDIAN, share)
