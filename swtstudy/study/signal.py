"""Measured signals: the loads that a rig has recorded over some cycles, their means, and their loops."""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from swtstudy.kernel.loops import slope_of
from swtstudy.solver.load_path import HIGHEST_ORDER, LoadPath, Loop, checked_name
from swtstudy.study import cycles
from swtstudy.study.columns import read_columns
from swtstudy.study.keys import SignalTable, with_keys
from swtstudy.study.spikes import spikes
from swtstudy.study.units.rows import Units
from swtstudy.vocabulary.arrays import FloatArray, IndexArray
from swtstudy.vocabulary.mistakes import literal, refused
from swtstudy.vocabulary.wording import number_of

#: By what share of a step a record may be shorter than a whole number of periods.
ROUNDING = 1e-6
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
#: A normal load that moves by less, over its mean, may have been meant to be constant. Share of its amplitude
#: by which noise takes a bulk stress off the tangential load that it follows, at most.
NEXT_TO_NOTHING, NOISY = 0.02, 0.5

#: The loads of a signal, one that it may have, and the time.
COLUMNS, BULK, TIME = ("normal", "tangential"), "bulk", "time"
NAMES = (*COLUMNS, BULK)
#: Kinds of columns, with units.
KINDS = {"normal": "force", "tangential": "force", "bulk": "stress"}


@dataclass(frozen=True, eq=False)
class Signal:
    """Loads that a rig has recorded.

    Attributes
    ----------
    name
        Name of the loop.
    time
        Shape (k,): the time of each sample; its number, from 0 on, if none was recorded.
    values
        Shape (k, 2) or (k, 3): normal and tangential load, and the bulk stress, as they are in the file.
    period
        Length of a cycle, in the unit of the time.
    count
        Number of whole cycles, those with a gap in the time among them.
    is_absolute
        Whether the normal load is the load itself, not its deviation from the mean.
    highest
        Order of the highest harmonic of the loop; 0 for straight lines between the samples.
    """

    name: str
    time: FloatArray
    values: FloatArray
    period: float
    count: int
    is_absolute: bool
    highest: int

    def __repr__(self) -> str:
        return f"<Signal {self.name}: {self.words}>"

    @cached_property
    def gaps(self) -> IndexArray:
        """Samples after which the time has a gap: a quarter of a cycle, or three steps, if that is longer."""
        steps = np.diff(self.time)
        return np.flatnonzero(steps > max(0.25 * self.period, cycles.PAUSE * float(np.median(steps))))

    @cached_property
    def whole(self) -> IndexArray:
        """The cycles without a gap, by their numbers from 0 on."""
        ends = (self.time[np.stack([self.gaps, self.gaps + 1])] - self.time[0]) / self.period
        begins, ends = [0, *np.ceil(ends[1])], [*np.floor(ends[0]), self.count]  # of the cycles between gaps
        pairs = zip(begins, np.minimum(ends, self.count), strict=True)
        return np.concatenate([np.arange(*pair, dtype=np.intp) for pair in pairs])

    @cached_property
    def known(self) -> IndexArray:
        """The cycles without a gap; if each has one, those that have samples."""
        sampled = np.unique((self.phase / (2.0 * np.pi) + ROUNDING).astype(np.intp))
        return self.whole if self.whole.size else np.minimum(sampled, self.count - 1)

    @cached_property
    def cycles(self) -> FloatArray:
        """The cycles without a gap at even phases, shape (c, m, d); a single one at its own samples."""
        if self._is_one_cycle:
            return self.values[None]
        return cycles.folded(self.time, self.values, self.period, self.known)

    @cached_property
    def mean_cycle(self) -> FloatArray:
        """The mean of the cycles, shape (m, d)."""
        return np.asarray(self.cycles.mean(axis=0))

    @property
    def scatter(self) -> FloatArray:
        """Standard deviation of the cycles from their mean, by column; NaN for a single one."""
        return cycles.scatter(self.cycles)

    @cached_property
    def unlike(self) -> FloatArray:
        """The rest of the record beside its mean cycle, over the movement of that; 0 for a single one."""
        if self.count < 2:
            return np.zeros(self.values.shape[1])
        load = cycles.repeated(self.time, self.period, self.mean_cycle)
        return cycles.beside(self.values[: self._used], load[: self._used])

    @cached_property
    def mean_normal(self) -> float | None:
        """The mean normal load; None where the column is its deviation from that.

        Raises
        ------
        StudyError
            A ValueError, if it is not positive.
        """
        if not self.is_absolute:
            return None
        if self.highest:
            mean = float(self._fits[0][0][0, 1])
        elif self._is_one_cycle:
            # Over the time, by straight lines: the samples need not be even.
            at = np.append(self.time, self.time[0] + self.period)
            sums = self.values[:, 0] + np.roll(self.values[:, 0], -1)
            mean = float(np.sum(np.diff(at) * 0.5 * sums) / self.period)
        else:
            mean = float(self.cycles[..., 0].mean())
        lowest, least = self.values[:, :2].min(axis=0).tolist()
        if not mean > 0.0 or lowest < 0.0 < least:
            hint = "where compression is negative: scale = { normal = -1 }, or minus its scale"
            if least > 0.0:
                hint = f"tangential loads are {least:.3g} and more: are the columns exchanged?"
            found = f"a mean normal load of {mean:.3g}, down to {lowest:.3g}"
            raise refused("absolute", found, f"a mean above 0; {hint}")
        return mean

    @cached_property
    def is_steady(self) -> bool:
        """True if a normal load beside a bulk stress moves by no more than its noise: it is constant.

        Under a constant load the stick zone is known to move with the bulk stress; any motion hides that.
        """
        if self.values.shape[1] < len(NAMES):
            return False
        if np.ptp(self.values[:, 0]) == 0.0:
            return True
        is_noise = len(self.values) >= cycles.FEWEST_SAMPLES and cycles.structure(self.values)[0] == 0.0
        moves = self.mean_cycle[:, 0].std()
        return bool(is_noise and (self.count == 1 or moves <= cycles.noise_of_mean(self.cycles)[0]))

    @cached_property
    def pull(self) -> float:
        """Factor with which a bulk stress beside a constant normal load follows the tangential load.

        0 where it does not follow but for noise.
        """
        if not self.is_steady:
            return 0.0
        _, tangential, bulk = self.mean_cycle.T
        slope = float(slope_of(tangential, bulk, NOISY)[0])
        rest = self.values[:, 2:] - slope * self.values[:, 1:2]
        return slope if cycles.structure(rest)[0] == 0.0 else 0.0

    @cached_property
    def loop(self) -> Loop:
        """The loop of the mean cycle, for a study's ``load``."""
        if not self.highest:
            return self._polygon(self.name, self.mean_cycle)
        columns = [[(int(order), *rest) for order, *rest in rows.tolist()] for rows, _ in self._fits]
        if self.is_steady:
            del columns[0][1:]
        if self.is_absolute:
            del columns[0][0]  # of the order 0, which is the mean
        return LoadPath.harmonic_sum(self.name, *columns, mean_normal=self.mean_normal)

    @property
    def loops(self) -> tuple[LoadPath, ...]:
        """The loop of each cycle, named by their numbers, about their common mean."""
        named = zip(self.known + 1, self.cycles, strict=True)
        return tuple(self._polygon(f"{self.name} {number}", one) for number, one in named)

    @property
    def missed(self) -> FloatArray:
        """Root mean square of what the harmonics leave out of the samples, by column; 0 without them."""
        if not self.highest:
            return np.zeros(self.values.shape[1])
        return np.asarray(np.sqrt(np.mean((self.values[: self._used] - self.fit) ** 2, axis=0)))

    @property
    def words(self) -> str:
        """Cycles, samples, scatter, in a line."""
        said = [f"{number_of(self.count, 'cycle')} of {self.cycles.shape[1]} samples"]
        if self.mean_normal is not None:
            said.append(f"mean normal load {self.mean_normal:.5g}")
        for verb, found in (("the cycles scatter by", self.scatter), ("the harmonics miss", self.missed)):
            if np.any(found > self.rounding):
                each = zip(NAMES, found, strict=False)
                said.append(f"{verb} {', '.join(f'{value:.2g} ({name})' for name, value in each)}")
        return "; ".join(said)

    @property
    def rounding(self) -> FloatArray:
        """Scatter and misses that are rounding, by column."""
        return np.asarray(np.finfo(float).eps * self.count * np.abs(self.values).max(axis=0))

    @property
    def step(self) -> float:
        """Mean time from a sample to the next."""
        return cycles.step_of(self.time)

    @property
    def fit(self) -> FloatArray:
        """The harmonics at each sample within the whole cycles, (k, d)."""
        return np.stack([fit for _, fit in self._fits], axis=1)

    @property
    def _used(self) -> int:
        """Samples within the whole cycles."""
        end = self.time[0] + self.count * self.period
        return int(np.searchsorted(self.time, end - ROUNDING * self.period))

    @property
    def _is_one_cycle(self) -> bool:
        """True if all samples are one cycle, which keeps them as they are."""
        return self.count == 1 and self._used == len(self.time)

    @property
    def phase(self) -> FloatArray:
        """φ of each sample within the whole cycles, rad, from 0 on."""
        return 2.0 * np.pi * (self.time[: self._used] - self.time[0]) / self.period

    @cached_property
    def _fits(self) -> list[tuple[FloatArray, FloatArray]]:
        return [cycles.harmonics(self.phase, column, self.highest) for column in self.values[: self._used].T]

    def _polygon(self, name: str, cycle: FloatArray) -> LoadPath:
        off = np.eye(1, cycle.shape[1]) * (self.mean_normal or 0.0)
        if self.is_steady:
            mean = self.cycles[..., 0].mean() if self.mean_normal is None else self.mean_normal
            cycle = np.insert(cycle[:, 1:], 0, mean, axis=1)
        if self.pull:
            cycle[:, 2] = cycle[:, 2].mean() + self.pull * (cycle[:, 1] - cycle[:, 1].mean())
        return LoadPath(name, cycle - off, self.mean_normal)


@with_keys(SignalTable)
def read_signal(path: str | PathLike[str], *, name: str | None = None, **given: Any) -> Signal:
    """Loads that a rig has recorded, from a table with a header in a text file or a workbook.

    Parameters
    ----------
    path
        The file.
    name
        Name of the loop; the file's name unless given.
    columns
        Headers of the columns ``normal``, ``tangential`` and, optionally, ``bulk``, where they are not these
        words.
    absolute
        Whether the normal column is the load itself, as it is measured: its mean is taken off, and is the
        mean normal load of contacts without a given one.
    separator, decimal
        Between cells (",", ";", a tab, "|", or a blank for any number of blanks) and in numbers ("." or ",");
        found from the file unless given.
    encoding
        Encoding of the text, UTF-8 unless given.
    scale
        Factors of columns, such as ``{"normal": 1000}`` for kN.
    skip_rows, units_row
        Number of lines above the header, and whether a row of units follows it; found from the file unless
        given, with a warning.
    sheet
        Name or number of a sheet of an Excel workbook, for which openpyxl must be installed.
    time
        Header of the time; without it samples are even.
    recorded_cycles
        Number of cycles that the file holds. They are folded into their mean.
    period, frequency
        Length of a cycle instead of their number, in the unit of the time, or in samples without one; or one
        divided by this length.
    skip_cycles
        Number of cycles at the begin of the record, such as a start-up, that are left out.
    harmonics
        Highest order, up to 64, of a fit by harmonics, which is a smooth loop; without it straight lines
        join the samples.
    despike
        Whether spikes are taken out: a sample, or a few in a row, apart from the samples beside them take the
        values on the line between these, and samples apart from all other cycles take their median; without
        it a warning names the spikes.

    Returns
    -------
    Signal
        Its ``loop`` is a value of ``load``; ``loops`` are its cycles one by one.

    Raises
    ------
    StudyError
        A ValueError with what is wrong, and where in the file.
    """
    own = Path(path).stem or str(path) if name is None else name
    return signal_from(Path(path), checked_name(own), SignalTable.of(given))


def signal_from(
    path: Path,
    name: str,
    given: SignalTable,
    units: Units | None = None,
    kinds: Mapping[str, str] = KINDS,
    kept: bool = False,
) -> Signal:
    """The signal in a file; see `read_signal`, and `read_columns` for kinds and units.

    ``kept`` tells that its cycles are used one by one: they need not be alike.
    """
    keys = ("recorded_cycles", "period", "frequency")
    lengths = [key for key in keys if getattr(given, key) is not None]
    if len(lengths) > 1:
        raise refused(", ".join(lengths), "both", "one of the two: the other follows")
    if given.frequency is not None and given.time is None:
        allowed = "time = the header of the time, in whose unit a cycle takes 1/frequency; or recorded_cycles"
        raise refused("frequency", literal(given.frequency), allowed)
    form = given.model_copy(update={"columns": given.columns | ({TIME: given.time} if given.time else {})})
    names = (*(TIME,) * bool(given.time), *COLUMNS, *(BULK,) * (BULK in given.columns))
    optional = () if BULK in given.columns else (BULK,)
    values, rows = read_columns(path, names, optional, form, kinds, units, gaps=given.time is not None)
    time = np.arange(len(values), dtype=np.float64)
    if given.time:
        time, values = values[:, 0], values[:, 1:]
        for row in np.flatnonzero(np.diff(time) <= 0.0)[:1]:
            found = f"{time[row + 1]:g} after {time[row]:g}"
            raise refused(f"line {rows[row + 1]}, time", found, "times that ascend", str(path))
    if len(values) < 2:
        raise refused("", f"{len(values)} samples", "2 at least", str(path))
    length, step = time[-1] - time[0], cycles.step_of(time)
    key = (*lengths, "recorded_cycles")[0]
    if key == "recorded_cycles":
        count = given.recorded_cycles or 1
        # Each sample is there once: the first is not the last again.
        period = float(length * len(time) / (len(time) - 1) / count)
    else:
        period = given.period or 1.0 / float(given.frequency or 1.0)
        count = int((length + step * (1.0 + ROUNDING)) / period)
    samples, highest = period / step, given.harmonics or 0
    if count < 1:
        own = given.frequency or period
        raise refused(key, f"{own:g}, and a record of {length:g}", "a whole cycle at least")
    if samples < 2.0 - 1e-9:
        found = f"{samples:.2g} samples a cycle: a cycle takes {period:.3g}, the time steps by {step:.3g}"
        one_unit = "; both in one unit, such as scale = { time = 1e-6 } for µs beside Hz"
        raise refused(key, found, f"2 samples a cycle at least{one_unit * bool(given.time)}")
    if given.skip_cycles >= count:
        found = f"{given.skip_cycles} of {number_of(count, 'cycle')}"
        raise refused("skip_cycles", found, "fewer than all")
    begin = np.searchsorted(time, time[0] + (given.skip_cycles + ROUNDING) * period, "right") - 1
    time, values, rows, count = time[begin:], values[begin:], rows[begin:], count - given.skip_cycles
    raw = Signal(name, time, values, period, count, given.absolute, highest)
    if key == "recorded_cycles" and count > 1 and raw.gaps.size:
        at = raw.gaps[0]
        found = f"{count}, and a gap of {time[at + 1] - time[at]:.4g} in the time, at {time[at]:.4g}"
        likely = f"{step * len(time) / count:.5g} if nothing else is lost"
        raise refused(key, found, f"period = the length of a cycle, {likely}")
    signal = replace(raw, values=_without_spikes(raw, rows, given.despike))
    if highest and not cycles.determined(signal.phase, highest):
        allowed = "less than half as many as samples at different phases of the cycle"
        if key == "period" and not given.time:
            allowed += f"; a period of {period:g} is one of samples, without the column of the time"
        raise refused("harmonics", f"{highest} with {samples * count:.0f} samples", allowed)
    if signal.count > 1 and not kept:
        _refuse_unlike(signal, key)
    for line in _doubts(signal, key, given.recorded_cycles is None, kept):  # spikes are told already
        warnings.warn(f"{name}: {line}", stacklevel=2)
    return signal if given.despike else raw


def _refuse_unlike(signal: Signal, key: str) -> None:
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


def _doubts(signal: Signal, key: str, unsaid: bool, kept: bool) -> Iterator[str]:
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
    if len(values) > 2 and signal._used == len(values) and np.array_equal(values[0], values[-1]):
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
    yield from different or _losses(signal)


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


def _losses(signal: Signal) -> Iterator[str]:
    """Lines on what straight lines between samples cut off, and on what harmonics leave out."""
    if signal.highest:
        values = signal.values[: signal._used]
        left = cycles.beside(values, signal.fit)
        range_left = _range_left_out(signal)
        if left.max() > LEFT_OUT:
            k = int(left.argmax())
            out, moves = cycles.structure(values - signal.fit)[k], values[:, k].std()
            found = f"harmonics = {signal.highest} leaves out {out:.3g} of the {NAMES[k]} load, which moves"
            yield f"{found} by {moves:.3g} (standard deviations): more harmonics, or none"
        elif (most := np.abs(range_left).max()) > CUT_OFF:
            k = int(np.abs(range_left).argmax())
            change = "takes {:.1%} off" if range_left[k] > 0.0 else "adds {:.1%} to"
            found = f"harmonics = {signal.highest} {change.format(most)} the range of the {NAMES[k]} load"
            yield f"{found}: more harmonics, or none, as for a load with corners"
        return
    samples, mean = signal.period / signal.step, signal.mean_cycle
    moving = np.flatnonzero(mean.std(axis=0) > cycles.noise_of_mean(signal.cycles))
    places = signal.phase / (2.0 * np.pi) * len(mean)
    off, order = cycles.cut_off(mean[:, moving], samples)
    tips, corner = cycles.cut_tips(mean[:, moving])
    white, scatter = (
        each / np.sqrt(len(signal.cycles)) for each in (cycles.white_noise(signal.cycles), signal.scatter)
    )
    noise = np.fmax(white, scatter)
    phases = ", at other phases in each"
    if signal._is_one_cycle or np.abs(places - np.round(places)).max() < ON_PLACE:
        off, phases = tips * (tips * np.ptp(mean[:, moving], axis=0) > OF_NOISE * noise[moving]), ""
    if (most := off.max(initial=0.0)) > CUT_OFF:
        k = int(off.argmax())
        found = f"{samples:.4g} samples a cycle{phases}: straight lines between them take"
        way = (
            f"harmonics = {order} takes nothing off" if order <= HIGHEST_ORDER else "more samples are needed"
        )
        way = "more samples are needed, or vertices = its corners" if corner[k] else way
        yield f"{found} {most:.1%} off the {NAMES[moving[k]]} load; {way}"
        return
    size = np.append(np.abs(mean[:, 0]).max(), 0.5 * np.ptp(mean[:, 1:], axis=0))
    raised = cycles.raised_by(white / np.maximum(size, cycles.TINY), len(mean)) * (
        mean.std(axis=0) > 2.0 * white
    )
    if (most := raised.max()) > RAISED:
        k = int(raised.argmax())
        found = f"noise of {white[k]:.2g} raises the tips of the {NAMES[k]} load by some {most:.1%}"
        yield f"{found}: more cycles, or harmonics = {order} if it is smooth, average it out"


def _range_left_out(signal: Signal) -> FloatArray:
    """Share of the range of each column that its harmonics leave out, beyond its noise; < 0 if they add some.

    The range is that of as many harmonics as the samples determine beside their noise.
    """
    phase, found = signal.phase[:MOST_FITTED], np.zeros(signal.values.shape[1])
    orders = (order for order in (64, 32, 16, 8) if signal.highest < order <= len(phase) // 3)
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


def _without_spikes(signal: Signal, lines: IndexArray, despike: bool) -> FloatArray:
    """The values, spikes replaced by the values that other samples suggest; tell that, or propose it."""
    time, values = signal.time, signal.values
    out, usual = spikes(time, values, signal.period, signal.count, signal.known)
    rows, columns = np.nonzero(out)
    if not rows.size:
        return values
    row, column = int(rows[0]), int(columns[0])
    cycle = int((time[row] - time[0]) / signal.period) + 1
    place = f"cycle {cycle}, line {lines[row]} of the file"
    found = f"{NAMES[column]} {values[row, column]:g} in {place}"
    more = f", and {rows.size - 1} more" if rows.size > 1 else ""
    if despike:
        told = f"{number_of(rows.size, 'spike')} replaced, {found}, by {usual[row, column]:.4g}{more}"
    else:
        told = f"{found}, where the other samples suggest {usual[row, column]:.4g}{more}: a spike? "
        told += "despike = true takes it out"
    warnings.warn(f"{signal.name}: {told}", stacklevel=3)
    return np.where(out, usual, values)
