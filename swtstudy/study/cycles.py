"""Cycles of a record: folded to one, their scatter and drift, and the harmonics that fit them best."""

from __future__ import annotations

import numpy as np
from scipy.special import ndtri, stdtrit

from swtstudy.vocabulary.arrays import BoolArray, FloatArray, IndexArray

#: Least eigenvalue of the mean products of harmonics, 1/2 of samples at even phases: below this noise would
#: count seven times as much.
LEAST_EIGENVALUE = 0.01

#: A step longer than so many median ones is a pause.
PAUSE = 3.0
#: Cycles from which their median does not follow a spike of one of them.
FEWEST_CYCLES = 3
#: Fewest samples of a record, and of a cycle, of which it is asked whether they repeat.
FEWEST_SAMPLES, FEWEST_IN_CYCLE = 16, 4
#: Correlation of a repeating record with itself one cycle later, and of a column that is noise at most.
REPEATS, NOISE = 0.9, 0.5
#: Median of the distances of normal numbers from their mean, over their standard deviation.
MEDIAN = 0.6745
#: Quantiles to which samples are cut before.
TRIMMED = (0.005, 0.995)

#: The first and the last cycles are a tenth and a quarter of all. They differ by a share of the amplitude, or
#: of a tenth of the largest load, and by more than amplitudes scatter but for a chance of Student's t.
ENDS, UNEVEN, LEAST_LOAD, CHANCE = (10, 4), 0.05, 0.1, 1e-5
#: Standard deviations of the chance likeness of white noise to itself; an amplitude over the largest one that
#: counts; a divisor for 0.
WHITE, SMALL, TINY = 4.0, 0.03, 1e-300
#: Samples in a row of a cut top, and steps of rounding by which it falls beside them: a smooth top of which
#: so many samples are rounded to one value falls by (3/2)² steps at most.
IN_A_ROW, ROUNDED = 5, 2.25
#: Fewest samples of a cycle whose tips are looked at, and whose noise is. Changes of the slope beside a tip
#: over those at it: of a corner at most, and of a smooth tip at least; a sine of eight samples has 0.41.
FEWEST_AT_TIPS, FEWEST_SMOOTH, CORNER = 8, 32, (0.25, 0.35)
#: Share of a cycle's standard deviation, and standard deviations of its noise, by which parts of a cycle that
#: repeats may differ.
SAME, NOISE_OF_MEAN = 0.02, 3.0


def step_of(time: FloatArray) -> float:
    """Mean time from a sample to the next, pauses left out."""
    steps = np.diff(time)
    pauses = steps[steps > PAUSE * np.median(steps)]
    return float((time[-1] - time[0] - pauses.sum()) / (len(steps) - len(pauses)))


def folded(time: FloatArray, values: FloatArray, period: float, numbers: IndexArray) -> FloatArray:
    """Whole cycles of a record at even phases, as many as it has samples in a cycle.

    Parameters
    ----------
    time
        Shape (k,), ascending.
    values
        Shape (k, d).
    period, numbers
        Length of a cycle, and which cycles, from 0 on, shape (c,).

    Returns
    -------
    array
        Shape (c, m, d); straight lines between the samples.
    """
    phases = round(period / step_of(time))
    at = time[0] + period * (numbers[:, None] + np.arange(phases) / phases)
    return np.stack([np.interp(at, time, column) for column in values.T], axis=-1)


def scatter(cycles: FloatArray) -> FloatArray:
    """Standard deviation of cycles (c, m, d) from their mean, root mean square over phases, shape (d,)."""
    if len(cycles) < 2:
        return np.full(cycles.shape[-1], np.nan)
    return np.asarray(np.sqrt(cycles.var(axis=0, ddof=1).mean(axis=0)))


def structure(rest: FloatArray) -> FloatArray:
    """Root mean square of what is no white noise in columns (k, d) of even samples, by column, shape (d,).

    White noise has no likeness to itself one or two samples later. A record less a load that it does not
    follow has: the rest of a wave is alike one sample later, of a wave of four samples two samples later.
    """
    count, rest = len(rest), rest - rest.mean(axis=0)
    if count < FEWEST_SAMPLES:
        return np.zeros(rest.shape[1])
    alike = [np.abs((rest[lag:] * rest[:-lag]).sum(axis=0)) / (count - lag) for lag in (1, 2)]
    chance = WHITE / np.sqrt(count) * rest.var(axis=0)
    return np.asarray(np.sqrt(np.maximum(np.max(alike, axis=0) - chance, 0.0)))


def repeated(time: FloatArray, period: float, cycle: FloatArray) -> FloatArray:
    """The values at each time, (k, d), of a cycle (m, d) at even phases that repeats."""
    at, phase = np.arange(len(cycle)), np.mod((time - time[0]) / period, 1.0) * len(cycle)
    return np.stack([np.interp(phase, at, column, period=len(cycle)) for column in cycle.T], axis=-1)


def beside(values: FloatArray, load: FloatArray) -> FloatArray:
    """The rest of a record (k, d) beside a load (k, d), noise left out, over the load's movement, shape (d,).

    The movement is the standard deviation of the load, or a share of the largest value.
    """
    movement = np.maximum(load.std(axis=0), LEAST_LOAD * np.abs(values).max(axis=0))
    return np.asarray(structure(values - load) / np.maximum(movement, TINY))


def cut_off(cycle: FloatArray, samples: float) -> tuple[FloatArray, int]:
    """Share of amplitudes that straight lines between so many samples a cycle cut off, by column of (m, d).

    The lines meet a wave anywhere between its samples: on average they leave sinc²(order/samples) of it. The
    second result is the highest order with a share of the largest amplitude of a column.
    """
    squares = np.abs(np.fft.rfft(cycle - cycle.mean(axis=0), axis=0)) ** 2
    off = 1.0 - np.sinc(np.arange(len(squares)) / samples)[:, None] ** 2
    orders = np.flatnonzero((squares > SMALL**2 * squares.max(axis=0)).any(axis=1))
    return (off * squares).sum(axis=0) / np.maximum(squares.sum(axis=0), TINY), int(max([1, *orders]))


def cut_tips(cycle: FloatArray) -> tuple[FloatArray, BoolArray]:
    """Share of the range by which the tips of a load are beyond its samples, by column of a cycle (m, d).

    A tip is between the two highest of six samples in a row. Where the slope changes at these two alone, the
    tip is a corner, at which the lines through the samples on both sides meet. Where it changes on all four
    inner ones in one sense, the tip is that of the parabola through the highest three. At other tips, such
    as those of a load that is held, nothing is known to be cut off.

    Returns
    -------
    cut, corner
        Shape (d,): the shares, and whether there is a tip that is a corner.
    """
    count, columns = cycle.shape
    cut, corner = np.zeros(columns), np.zeros(columns, bool)
    for k in range(columns if count >= FEWEST_AT_TIPS else 0):
        for column in (cycle[:, k], -cycle[:, k]):
            at = column[(int(column.argmax()) + np.arange(-3, 4)) % count]
            at = at if at[4] >= at[2] else at[::-1]
            bends = np.diff(at, 2)[1:]
            inner, outer = -bends[1:3].sum(), np.abs(bends[[0, 3]]).sum()
            if outer <= CORNER[0] * inner and inner > 0.0:
                before, after = at[3] - at[2], at[5] - at[4]
                tip = at[3] + before * (at[4] - after - at[3]) / (before - after)
                corner[k] = True
            elif outer >= CORNER[1] * inner and (bends < 0.0).all():
                tip = at[3] - (0.5 * (at[4] - at[2])) ** 2 / (2.0 * bends[1])
            else:
                continue
            cut[k] += max(tip - at[3], 0.0) / max(np.ptp(column), TINY)
    return cut, corner


def white_noise(cycles: FloatArray) -> FloatArray:
    """Standard deviation of white noise in the columns of cycles, (c, m, d); 0 where samples are too few.

    From its third differences, in which a smooth wave of so many samples has little: 0.2 % of its amplitude.
    """
    if cycles.shape[1] < FEWEST_SMOOTH:
        return np.zeros(cycles.shape[2])
    third = np.diff(np.concatenate([cycles, cycles[:, :3]], axis=1), 3, axis=1)
    return np.asarray(np.median(np.abs(third), axis=(0, 1)) / (MEDIAN * np.sqrt(20.0)))


def raised_by(share: FloatArray, count: int) -> FloatArray:
    """Share of the amplitude of smooth loads by which noise raises their tips, (d,).

    The highest of the samples counts that are lower than the tip by less than the noise.

    Parameters
    ----------
    share, count
        Standard deviation of the noise over the amplitude, (d,), and samples in a cycle.
    """
    samples = count * np.sqrt(2.0 * share) / np.pi
    return np.asarray(share * np.maximum(ndtri(samples / (samples + 1.0)), 0.0))


def noise_of_mean(cycles: FloatArray) -> FloatArray:
    """The movement of the mean of cycles, (c, m, d), up to which it may be their noise, (d,); 0 for one."""
    return np.asarray(np.nan_to_num(NOISE_OF_MEAN * scatter(cycles) / np.sqrt(len(cycles))))


def drift(cycles: FloatArray, numbers: IndexArray, longest: float = 1) -> float:
    """Share of the period by which each of the cycles, (c, m, d), comes late; 0 for a single one.

    The shift with which the steps from cycle to cycle agree best, in the sense of least squares, of the first
    three harmonics of columns over their `scatter`: the period is longer by so much. What is shifted is the
    mean of the cycles in a row. Steps count between cycles whose numbers, (c,), differ by up to ``longest``.
    """
    size, apart = scatter(cycles), np.diff(numbers)
    some, near = size > 0.0, np.flatnonzero(apart <= longest)
    if not some.any() or not near.size:
        return 0.0
    waves = np.fft.rfft(cycles[..., some] / size[some], axis=1)[:, 1:4]
    rows = np.cumsum(apart > 1)  # the row of cycles that each cycle but the first is in
    begins = np.flatnonzero(np.append(True, apart > 1))
    means = np.add.reduceat(waves, begins, axis=0) / np.diff(begins, append=len(cycles))[:, None, None]
    mean = 0.5 * (means[np.append(0, rows)[near]] + means[rows[near]])
    slope = 2j * np.pi * np.arange(1, mean.shape[1] + 1)[:, None] * mean * apart[near, None, None]
    step = np.diff(waves, axis=0)[near]
    steepness, change = (np.abs(slope) ** 2).sum(), (np.abs(step) ** 2).sum()
    if steepness <= change * np.finfo(float).eps:  # the mean cycle does not move
        return 0.0
    return float(-(slope.conj() * step).sum().real / steepness)


def uneven_ends(cycles: FloatArray) -> tuple[int, int, list[float], int] | None:
    """The column in which amplitudes of the first or last cycles, (c, m, d), differ from all others.

    Returns
    -------
    tuple or None
        The column, the number of cycles at an end, the amplitudes of the first of them, the last of them, and
        of the mean cycle, and the number of cycles in the first half up to the last one that differs from the
        second half; None if amplitudes only scatter. The scatter is of the steps from cycle to cycle of all
        others: a slow drift has no share in it.
    """
    mean = cycles.mean(axis=0)
    wave, count, size = mean - mean.mean(axis=0), len(cycles), 0.5 * np.ptp(mean, axis=0)
    least = UNEVEN * np.maximum(size, LEAST_LOAD * np.abs(cycles).max(axis=(0, 1)))
    columns = np.flatnonzero(wave.std(axis=0) > 0.5 * scatter(cycles)) if count > FEWEST_CYCLES else ()
    for column in columns:
        own = size[column] * (cycles[..., column] @ wave[:, column]) / (wave[:, column] @ wave[:, column])
        for ends in dict.fromkeys(max(1, count // part) for part in ENDS):
            likely = stdtrit(count - ends - 2, 1.0 - CHANCE) * np.sqrt(0.5 / ends + 0.5 / (count - ends))
            for each in (own, own[::-1]):
                off = abs(each[:ends].mean() - each[ends:].mean())
                if off > max(least[column], likely * np.diff(each[ends:]).std(ddof=1)):
                    half = own[count // 2 :]
                    apart = np.abs(own[: count // 2] - np.median(half)) > max(least[column], np.ptp(half))
                    unsettled = int(np.flatnonzero(apart).max(initial=-1)) + 1
                    return int(column), ends, [own[:ends].mean(), own[-ends:].mean(), size[column]], unsettled
    return None


def repetitions(cycles: FloatArray) -> int:
    """Number of times that the mean of cycles, (c, m, d), repeats itself; 1 if it does not."""
    mean = cycles.mean(axis=0)
    wave, length = mean - mean.mean(axis=0), len(mean)
    size, noise = wave.std(axis=0), noise_of_mean(cycles)
    squares = 2.0 * np.abs(np.fft.rfft(wave, axis=0) / length) ** 2
    is_load = size > noise
    if not is_load.any():
        return 1
    order = int((squares[:, is_load] / size[is_load] ** 2).sum(axis=1).argmax())
    most = np.maximum(noise, SAME * size) ** 2
    for times in range(min(order, length // FEWEST_IN_CYCLE), 1, -1):
        if order % times == 0 and np.all(squares.sum(axis=0) - squares[::times].sum(axis=0) <= most):
            return times
    return 1


def cut_tops(values: FloatArray) -> tuple[int, float, IndexArray] | None:
    """A column of (k, d) whose tops are cut off, as at the end of a load cell's range.

    Its largest or smallest value is that of several samples in a row, beside which it falls by more than the
    steps in which a recorder rounds.

    Returns
    -------
    tuple or None
        The column, the value, and the samples that have it; None if there is none.
    """
    for column, own in enumerate(values.T):
        steps = np.diff(np.unique(own))
        for end in (own.max(), own.min()) if len(steps) else ():
            at = own == end
            rows = np.lib.stride_tricks.sliding_window_view(at, min(IN_A_ROW, len(at)))
            ends = np.flatnonzero(at[:-1] != at[1:])
            falls = np.abs(own[ends] - own[ends + 1])
            if rows.all(axis=1).any() and np.median(falls) > ROUNDED * steps.min():
                return column, float(end), np.flatnonzero(at)
    return None


def repeats(time: FloatArray, values: FloatArray) -> float | None:
    """Number of times a record (k, d) repeats itself; None if it does not, or holds less than two cycles."""
    size = len(time)
    if size < FEWEST_SAMPLES:
        return None
    even = np.linspace(time[0], time[-1], size)
    found = []
    for column in values.T:
        own = np.interp(even, time, np.clip(column, *np.quantile(column, TRIMMED)))  # a spike hides all else
        own = own - own.mean()
        if not own.any():
            continue
        power = np.abs(np.fft.rfft(own, 2 * size)) ** 2
        products = np.fft.irfft(power)[: size // 2 + 1]
        found.append(products / np.arange(size, size - len(products), -1) / own.var())
    found = [each for each in found if each[FEWEST_IN_CYCLE:].max() > NOISE]
    if not found:
        return None
    least = np.min(found, axis=0)
    inner = np.arange(FEWEST_IN_CYCLE, len(least))
    after = np.append(least, -np.inf)[inner + 1]
    # Next to the first sample all is alike: a cycle later it is again.
    again = (np.minimum.accumulate(least)[inner] < REPEATS) & (least[inner] > REPEATS)
    tops = inner[again & (least[inner] >= least[inner - 1]) & (least[inner] >= after)]
    if not tops.size:
        return None
    # The last top is so many cycles from the first sample: it tells the length of one best.
    cycles = round(tops[-1] / tops[0])
    return float(size / (tops[-1] / cycles))


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
    base = _waves(phase, highest)
    found = np.linalg.lstsq(base, values, rcond=None)[0]
    sine, cosine = found[1 : highest + 1], found[highest + 1 :]
    rows = np.stack([np.arange(1, highest + 1), np.hypot(sine, cosine), np.arctan2(cosine, sine)], axis=1)
    return np.concatenate([[[0.0, found[0], 0.5 * np.pi]], rows]), base @ found


def determined(phase: FloatArray, highest: int) -> bool:
    """Return whether samples tell harmonics apart: cycles sampled at the same phases count as one."""
    base = _waves(phase, highest)
    return bool(np.linalg.eigvalsh(base.T @ base / len(phase))[0] > LEAST_EIGENVALUE)


def _waves(phase: FloatArray, highest: int) -> FloatArray:
    """Shape (k, 2 · highest + 1): one, sines and cosines."""
    waves = np.outer(phase, np.arange(1, highest + 1))
    return np.concatenate([np.ones((len(phase), 1)), np.sin(waves), np.cos(waves)], axis=1)
