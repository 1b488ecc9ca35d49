"""Records of loads, read from a file as a signal."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from dataclasses import replace
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from swtstudy.solver.load_path import checked_name
from swtstudy.study import cycles
from swtstudy.study.columns import read_columns
from swtstudy.study.keys import SignalTable, with_keys
from swtstudy.study.record_doubts import doubts_of, refuse_unlike
from swtstudy.study.signal import BULK, COLUMNS, KINDS, NAMES, ROUNDING, TIME, Signal
from swtstudy.study.spikes import spikes
from swtstudy.study.units.rows import Units
from swtstudy.vocabulary.arrays import FloatArray, IndexArray
from swtstudy.vocabulary.mistakes import literal, refused
from swtstudy.vocabulary.wording import number_of


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
        refuse_unlike(signal, key)
    for line in doubts_of(signal, key, given.recorded_cycles is None, kept):  # spikes are told already
        warnings.warn(f"{name}: {line}", stacklevel=2)
    return signal if given.despike else raw


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
