"""Doubts of a record: cycles that are none or differ, and loads that its mean cycle leaves out."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from swtstudy.kernel.loops import slope_of
from swtstudy.solver.load_path import HIGHEST_ORDER
from swtstudy.study import cycles
from swtstudy.study.signal import NAMES, ROUNDING, Signal
from swtstudy.vocabulary.arrays import FloatArray
from swtstudy.vocabulary.mistakes import refused

#: Drift of the cycles all over a record, over the period, with which a harmonic load loses a hundredth of its
#: amplitude when they are folded, 1 − sin(πx)/πx.
MOST_DRIFT = 0.08
#: Differences of cycles over the movement of their mean that are told: of a wave whose phase changes, folding
#: has taken half a hundredth. Multiples of a period among which the right one is looked for, the share of the
#: differences that it leaves at most, and how often a drift corrects it.
UNLIKE, MOST_TIMES, ALIKE, CORRECTIONS = 0.1, 12, 0.3, 4
#: Shares that are told: of a load's movement that harmonics leave out, and of its amplitude that straight
#: lines cut off. Distance over a step by which samples of all cycles are at the same phases.
LEFT_OUT, CUT_OFF, ON_PLACE = 0.05, 0.01, 0.05
#: Standard deviations of noise to which ranges are known; a share by which noise raises an amplitude, told.
OF_NOISE, RAISED = 4.0, 0.02
#: Most samples of which it is asked whether harmonics leave some of the range out.
MOST_FITTED = 10_000
#: Range of the means of kept cycles over the largest range of a cycle: beyond, they ride on a slower one.
RIDING = 0.05
#: A normal load that moves by less, over its mean, may have been meant to be constant.
NEXT_TO_NOTHING = 0.02


def refuse_unlike(signal: Signal, key: str) -> None:
    """Raise if cycles have less in common than what tells them apart: their mean is not the load."""
    unlike, moves = signal.unlike, signal.mean_cycle.std(axis=0)
    if np.any(unlike > 1.0) or np.all(signal.scatter > moves):
        k = int(unlike.argmax())
        length = 1.0 / signal.period if key == "frequency" else signal.period
        found = f"{signal.count if key == 'recorded_cycles' else length:.7g}: the {NAMES[k]} loads of its "
        found += f"{signal.count} cycles differ by {signal.scatter[k]:.3g}, more than their mean moves by, "
        single = "keep_cycles = true in a block of single cycles"
        noise = f"scale = {{ {NAMES[k]} = 0 }} if that column is noise"
        allowed = f"that of the record{_better(signal, key)}; {single}; {noise}"
        if signal.gaps.size:
            gap = f"the gap in the time, at {signal.time[signal.gaps[0]]:.4g}"
            allowed += f"; a file of the rows on one side of {gap}"
        raise refused(key, f"{found}{moves[k]:.3g}", allowed)


def _better(signal: Signal, key: str) -> str:
    """The length of cycles that are alike, in words; empty if none is found.

    It is near the one that is given, the time after which the record repeats, or a multiple of the given one.
    """
    whole = signal.time[-1] - signal.time[0] + signal.step
    times = cycles.repeats(signal.time, signal.values)
    guesses = [signal.period, *([whole / times] if times else [])]
    guesses += [signal.period * times for times in range(2, min(signal.count // 2, MOST_TIMES) + 1)]
    for period in guesses:
        for correction in range(CORRECTIONS):
            if not 2.0 * signal.step <= period <= 0.5 * whole * (1.0 + ROUNDING):
                break
            other = replace(signal, period=period, count=int(whole / period + ROUNDING))
            # Neighbours first: a drift across a gap is known but for whole periods.
            longest = np.diff(other.known).max(initial=1) ** min(1.0, 2 * correction / CORRECTIONS)
            period *= 1.0 + cycles.drift(other.cycles, other.known, longest)
        else:
            if other.unlike.max() < min(UNLIKE, ALIKE * signal.unlike.max()):
                length = f"frequency = {1.0 / other.period:.7g}"
                return f", such as {length if key == 'frequency' else f'period = {other.period:.7g}'}"
    return ""


def doubts_of(signal: Signal, key: str, unsaid: bool, kept: bool) -> Iterator[str]:
    """Lines on a gap in the time, a closed record, one that repeats, and cycles that are none or differ.

    ``unsaid`` tells that nothing was said of cycles, and ``kept`` that they are used one by one.
    """
    values, steps, period, count = signal.values, np.diff(signal.time), signal.period, signal.count
    if gaps := len(signal.gaps):
        at, out = signal.gaps[0], (count - signal.whole.size) * bool(signal.whole.size)
        found = f"a gap of {steps[at]:.4g} in the time, at {signal.time[at]:.4g}"
        found += f" and {gaps - 1} more" * (gaps > 1) + f", where most steps are {np.median(steps):.4g}"
        left = f"{out} of {count} cycles are left out" if out else "the loads there are unknown"
        yield f"{found}: {left}"
        if not out:
            return
    if len(values) > 2 and signal.used == len(values) and np.array_equal(values[0], values[-1]):
        yield "the last sample is the first again: leave it out if closed"
    if key == "recorded_cycles" and unsaid and (times := cycles.repeats(signal.time, values)):
        if abs(times - round(times)) < 0.01 * times:
            yield f"the record repeats {times:.0f} times: recorded_cycles = {times:.0f}?"
        else:
            yield f"the record repeats {times:.1f} times: period = {period / times:.4g}?"
    elif (parts := cycles.repetitions(signal.cycles)) > 1:
        right = {"recorded_cycles": count * parts, "period": period / parts, "frequency": parts / period}
        each = "each cycle" if count > 1 else "the cycle"
        yield f"{each} repeats {parts} times: {key} = {right[key]:.6g}?"
        return
    # A load that is generated, without noise at most phases, may have flat tops.
    noisy = np.flatnonzero(np.median(signal.cycles.std(axis=0), axis=0) > signal.rounding)
    if cut := cycles.cut_tops(values[:, noisy]):
        column, end, at = cut
        found = f"{len(at)} samples of the {NAMES[noisy[column]]} load are at its end, {end:.6g}"
        yield f"{found}: is that the end of a load cell's range? Then the load is higher"
    yield from _on_stick_zone(signal)
    different = [*_differences(signal, key, kept)]
    yield from different or (_left_out(signal) if signal.highest else _cut_off(signal))


def _on_stick_zone(signal: Signal) -> Iterator[str]:
    """A line on a normal load that is constant but for noise, or for little, beside a bulk stress."""
    normal = signal.values[:, 0]
    if signal.is_steady and np.ptp(normal):
        yield f"the normal load is constant: it moves by {normal.std():.2g}, which is noise"
    if signal.pull and not signal.highest and slope_of(*signal.mean_cycle.T[1:])[0] == 0.0:
        yield "the bulk stress follows the tangential load but for noise, which is left out"
    if signal.is_steady or signal.values.shape[1] < len(NAMES) or signal.mean_normal is None:
        return
    moves = signal.mean_cycle[:, 0].std() / signal.mean_normal
    if moves < NEXT_TO_NOTHING and slope_of(*signal.mean_cycle.T[1:])[0] != 0.0:
        found = f"the normal load moves by {moves:.2g} of its mean, so the bulk stress leaves the stick zone"
        given = f"normal_force = {signal.mean_normal:.5g}, amplitudes of 1, and scale = {{ normal = 0 }}"
        yield f"{found} in place; if it is to be constant, give {given} instead of absolute"


def _differences(signal: Signal, key: str, kept: bool) -> Iterator[str]:
    """A line on cycles that drift, that are of a start-up, or that differ in another way."""
    shift, unlike = cycles.drift(signal.cycles, signal.known), signal.unlike
    is_gap = np.diff(signal.known, prepend=-2, append=signal.count + 1) > 1
    count = int(np.diff(np.flatnonzero(is_gap)).max())  # in a row
    better = _better(signal, key) if not kept and unlike.max() > UNLIKE else ""
    if abs(shift) * count > MOST_DRIFT and not (better and signal.gaps.size):
        found = f"its {count} cycles{' between gaps' * (count < signal.count)} come {abs(shift) * count:.1%}"
        found += " of a period"
        late, right = "late" if shift > 0.0 else "early", signal.period * (1.0 + shift)
        yield f"{found} {late} altogether; is the period {right:.7g} and not {signal.period:.7g}?"
    elif kept:
        means, single = np.ptp(signal.cycles.mean(axis=1), axis=0), np.ptp(signal.cycles, axis=1).max(axis=0)
        size = np.maximum(single, cycles.LEAST_LOAD * np.abs(signal.values).max(axis=0))
        for k in np.flatnonzero(means > RIDING * size)[:1]:
            found = f"means of the {NAMES[k]} load in its cycles range over {means[k]:.4g}, a cycle over "
            out = "a slower cycle on which these ride is lost: recorded_cycles = 1 is the record as one cycle"
            yield f"{found}{single[k]:.4g} at most; {out}"
    elif not better and (uneven := cycles.uneven_ends(signal.cycles)):
        column, ends, (first, last, mean), unsettled = uneven
        each = f"{ends} cycles have" if ends > 1 else "cycle has"
        found = f"the first {each} a {NAMES[column]} amplitude of {first:.4g}, the last of {last:.4g}"
        out = f"skip_cycles = {signal.known[unsettled]} leaves a start-up out; " if unsettled else ""
        out += "a block with keep_cycles = true runs all cycles"
        yield f"{found}, and their mean, {mean:.4g}, is the load: {out}"
    elif unlike.max() > UNLIKE:
        k = int(unlike.argmax())
        moves = signal.mean_cycle[:, k].std()
        found = f"the cycles' {NAMES[k]} loads differ by {signal.scatter[k]:.3g}"
        load = f"their mean, which is the load, moves by {moves:.3g} (standard deviations)"
        out = f"is the cycle another{better}?" if better else "a block with keep_cycles = true runs each"
        yield f"{found}, and {load}: {out}"


def _left_out(signal: Signal) -> Iterator[str]:
    """A line on what harmonics leave out, or add."""
    values = signal.values[: signal.used]
    left = cycles.beside(values, signal.fit)
    if left.max() > LEFT_OUT:
        k = int(left.argmax())
        out, moves = cycles.structure(values - signal.fit)[k], values[:, k].std()
        found = f"harmonics = {signal.highest} leaves out {out:.3g} of the {NAMES[k]} load, which moves"
        yield f"{found} by {moves:.3g} (standard deviations): more harmonics, or none"
        return
    range_left = _range_left_out(signal)
    k = int(np.abs(range_left).argmax())
    if (most := abs(range_left[k])) > CUT_OFF:
        change = "takes {:.1%} off" if range_left[k] > 0.0 else "adds {:.1%} to"
        found = f"harmonics = {signal.highest} {change.format(most)} the range of the {NAMES[k]} load"
        yield f"{found}: more harmonics, or none, as for a load with corners"


def _cut_off(signal: Signal) -> Iterator[str]:
    """A line on what straight lines between samples cut off, or on noise that raises tips."""
    samples, mean, count = signal.period / signal.step, signal.mean_cycle, len(signal.cycles)
    moving = np.flatnonzero(mean.std(axis=0) > cycles.noise_of_mean(signal.cycles))
    places = signal.phase / (2.0 * np.pi) * len(mean)
    off, order = cycles.cut_off(mean[:, moving], samples)
    tips, corner = cycles.cut_tips(mean[:, moving])
    white = cycles.white_noise(signal.cycles) / np.sqrt(count)
    noise, phases = np.fmax(white, signal.scatter / np.sqrt(count)), ", at other phases in each"
    if signal.is_one_cycle or np.abs(places - np.round(places)).max() < ON_PLACE:
        off, phases = tips * (tips * np.ptp(mean[:, moving], axis=0) > OF_NOISE * noise[moving]), ""
    if (most := off.max(initial=0.0)) > CUT_OFF:
        k = int(off.argmax())
        found = f"{samples:.4g} samples a cycle{phases}: straight lines between them take"
        way = "more samples are needed"
        if corner[k]:
            way += ", or vertices = its corners"
        elif order <= HIGHEST_ORDER:
            way = f"harmonics = {order} takes nothing off"
        yield f"{found} {most:.1%} off the {NAMES[moving[k]]} load; {way}"
        return
    size = np.append(np.abs(mean[:, 0]).max(), 0.5 * np.ptp(mean[:, 1:], axis=0))
    raised = cycles.raised_by(white / np.maximum(size, cycles.TINY), len(mean))
    raised *= mean.std(axis=0) > 2.0 * white
    if (most := raised.max()) > RAISED:
        k = int(raised.argmax())
        found = f"noise of {white[k]:.2g} raises the tips of the {NAMES[k]} load by some {most:.1%}"
        yield f"{found}: more cycles, or harmonics = {order} if it is smooth, average it out"


def _range_left_out(signal: Signal) -> FloatArray:
    """Share of the range of each column that its harmonics leave out, beyond its noise; < 0 if they add some.

    The range is that of as many harmonics as the samples determine beside their noise.
    """
    phase, found = signal.phase[:MOST_FITTED], np.zeros(signal.values.shape[1])
    orders = (HIGHEST_ORDER // part for part in (1, 2, 4, 8))
    orders = (order for order in orders if signal.highest < order <= len(phase) // 3)
    highest = next((order for order in orders if cycles.determined(phase, order)), 0)
    if not highest:
        return found
    fitted = (2.0 * highest + 1.0) / len(phase)
    for k, column in enumerate(signal.values[: len(phase)].T):
        fit, closer = (cycles.harmonics(phase, column, order)[1] for order in (signal.highest, highest))
        noise = (column - closer).std() * np.sqrt(fitted / (1.0 - fitted))
        change, size = np.ptp(closer) - np.ptp(fit), cycles.LEAST_LOAD * np.abs(column).max()
        share = max(abs(change) - OF_NOISE * noise, 0.0) / max(np.ptp(fit), size, cycles.TINY)
        found[k] = np.copysign(share, change)
    return found
