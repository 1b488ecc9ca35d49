"""All that is said of recorded signals, word by word, and the sizes of their cycles."""

# ruff: noqa: F401  names in expressions

import re
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from told import sayings, warned

from swtstudy import StudyError, read_signal

NORMAL = [200.0, 210.0, 190.0, 205.0]


def noise(count: int, size: float, seed: int = 1) -> np.ndarray:
    return size * np.random.default_rng(seed).normal(size=(count, 2))


def wave(count: int, period: float, size: float = 0.0, orders: tuple[int, ...] = (1,)) -> np.ndarray:
    """A tangential load of some orders about a normal load that moves with it, and noise."""
    phase = 2.0 * np.pi * np.arange(count) / period
    load = sum(60.0 / k * np.sin(k * phase) for k in orders)
    return np.column_stack([200.0 + 0.1 * load, load]) + noise(count, size)


def spoilt(values: np.ndarray, *spikes: tuple[int, int, float]) -> np.ndarray:
    """Heights added to samples of columns."""
    for row, column, height in spikes:
        values[row, column] += height
    return values


def cycles(shares: list[float], size: float = 0.5) -> np.ndarray:
    """Cycles of 20 samples, each with its share of the tangential amplitude."""
    values = wave(20 * len(shares), 20)
    values[:, 1] *= np.repeat(shares, 20)
    return values + noise(len(values), size, 3)


def both(normal: list[float], tangential: list[float], count: int) -> np.ndarray:
    """Two columns that repeat."""
    return np.column_stack([np.resize(normal, count), np.resize(tangential, count)])


SPIKES = ((20, 1, 40.0), (77, 1, -50.0), (130, 0, 30.0), (131, 0, 30.0))
PAIR = ((70, 1, 90.0), (71, 1, 95.0))
RISE = [min(1.0, 0.1 * k + 0.05) for k in range(40)]
#: Signals, what each is, the sum of its mean cycle, and what is told of it.
SIGNALS = sayings(r"""
read(both(NORMAL, [2.0, 9.0, 4.0, 7.0], 16)) » 1 cycle of 16 samples » 3308.0
» the record repeats 4 times: recorded_cycles = 4?
read(both(NORMAL, [2.0, 9.0, 4.0, 7.0], 15)) » 1 cycle of 15 samples » 3096.0
read(both(NORMAL[:3], [1.0, 5.0, 2.0], 18)) » 1 cycle of 18 samples » 3648.0
» the record repeats 4 times: recorded_cycles = 4?
read(noise(64, 1.0) + 200.0) » 1 cycle of 64 samples » 25592.8336
read(both([200.0], [0.0], 40)) » 1 cycle of 40 samples » 8000.0
» the last sample is the first again: leave it out if closed
read(both([200.0, 201.0], [0.0], 2)) » 1 cycle of 2 samples » 401.0
read(both([200.0, 201.0, 200.0], [0.0], 3)) » 1 cycle of 3 samples » 601.0
» the last sample is the first again: leave it out if closed
read(wave(200, 200)) » 1 cycle of 200 samples » 40000.0
read(wave(100, 33.2)) » 1 cycle of 100 samples » 19998.5
» the record repeats 2.9 times: period = 34?
read(wave(100, 20) + [1.0, 0.0] * noise(100, 9.0, 2)) » 1 cycle of 100 samples » 20062.4742
» the record repeats 5 times: recorded_cycles = 5?
read(wave(100, 20, 3.0), recorded_cycles=1) » 1 cycle of 100 samples » 19955.8025
» noise of 3.1 raises the tips of the tangential load by some 6.5%: more cycles, or harmonics = 50 if it is
    smooth, average it out
read(spoilt(wave(16, 16), (5, 1, 80.0)), recorded_cycles=1) » 1 cycle of 16 samples » 3280.0
» tangential 135.433 in cycle 1, line 7 of the file, where the other samples suggest 51.21: a spike? despike =
    true takes it out
read(spoilt(wave(15, 15), (5, 1, 80.0)), recorded_cycles=1) » 1 cycle of 15 samples » 3080.0
read(spoilt(wave(16, 16), (1, 1, 80.0)), recorded_cycles=1) » 1 cycle of 16 samples » 3280.0
» tangential 102.961 in cycle 1, line 3 of the file, where the other samples suggest 21.21: a spike? despike =
    true takes it out
read(spoilt(wave(16, 16, 1e-3), (2, 1, 80.0)), recorded_cycles=1) » 1 cycle of 16 samples » 3279.99902
» tangential 122.427 in cycle 1, line 4 of the file, where the other samples suggest 39.2: a spike? despike =
    true takes it out
read(spoilt(wave(16, 16), (13, 1, -80.0)), recorded_cycles=1) » 1 cycle of 16 samples » 3120.0
» tangential -135.433 in cycle 1, line 15 of the file, where the other samples suggest -51.21: a spike?
    despike = true takes it out
read(spoilt(wave(16, 16), (14, 1, -80.0)), recorded_cycles=1) » 1 cycle of 16 samples » 3120.0
» tangential -122.426 in cycle 1, line 16 of the file, where the other samples suggest -39.2: a spike? despike
    = true takes it out
read(spoilt(wave(200, 50, 0.3), *SPIKES), recorded_cycles=4, despike=True)
» 4 cycles of 50 samples; the cycles scatter by 0.27 (normal), 0.26 (tangential) » 9997.57234
» 4 spikes replaced, tangential 75.0621 in cycle 1, line 22 of the file, by 34.86, and 3 more
read(spoilt(wave(200, 50, 0.3), *SPIKES), recorded_cycles=4)
» 4 cycles of 50 samples; the cycles scatter by 3 (normal), 4.5 (tangential) » 10010.0378
» tangential 75.0621 in cycle 1, line 22 of the file, where the other samples suggest 34.86, and 3 more: a
    spike? despike = true takes it out
read(spoilt(wave(200, 50, 1e-3), (20, 1, 5.5)), recorded_cycles=4)
» 4 cycles of 50 samples; the cycles scatter by 0.00089 (normal), 0.39 (tangential) » 10001.3668
read(spoilt(wave(200, 50, 1e-3), (20, 1, 6.5)), recorded_cycles=4)
» 4 cycles of 50 samples; the cycles scatter by 0.00089 (normal), 0.46 (tangential) » 10001.6168
read(spoilt(wave(150, 50, 0.3), *PAIR), recorded_cycles=3, despike=True)
» 3 cycles of 50 samples; the cycles scatter by 0.29 (normal), 0.27 (tangential) » 9996.66426
» 2 spikes replaced, tangential 125.704 in cycle 2, line 72 of the file, by 35.21, and 1 more
read(spoilt(wave(100, 50, 0.3), *PAIR), recorded_cycles=2, despike=True)
» 2 cycles of 50 samples; the cycles scatter by 0.29 (normal), 0.27 (tangential) » 9996.84194
» 2 spikes replaced, tangential 125.704 in cycle 2, line 72 of the file, by 34.48, and 1 more
read(spoilt(wave(150, 50, 1e-3), (70, 1, 55.0), (71, 1, 55.0)), recorded_cycles=3, despike=True)
» 3 cycles of 50 samples; the cycles scatter by 0.00095 (normal), 0.00089 (tangential) » 9999.98888
» 2 spikes replaced, tangential 90.2686 in cycle 2, line 72 of the file, by 35.27, and 1 more
read(spoilt(wave(150, 50, 1e-3), (70, 1, 11.0), (71, 1, 11.0)), recorded_cycles=3, despike=True)
» 3 cycles of 50 samples; the cycles scatter by 0.00095 (normal), 1.3 (tangential) » 10007.3231
read(wave(160, 40, 0.1), period=39)
» 4 cycles of 39 samples; the cycles scatter by 0.85 (normal), 8.5 (tangential) » 7824.14259
» its 4 cycles come 9.8% of a period late altogether; is the period 39.95282 and not 39?
read(wave(160, 40, 0.1), period=41)
» 3 cycles of 41 samples; the cycles scatter by 0.68 (normal), 6.7 (tangential) » 8209.45127
» the cycles' tangential loads differ by 6.71, and their mean, which is the load, moves by 41.6 (standard
    deviations): is the cycle another, such as period = 40.00112?
read(wave(400, 40, 0.1), period=39.7)
» 10 cycles of 40 samples; the cycles scatter by 0.6 (normal), 6 (tangential) » 8005.56121
» the cycles' tangential loads differ by 6, and their mean, which is the load, moves by 42.1 (standard
    deviations): is the cycle another, such as period = 39.99994?
read(wave(400, 40, 0.1, (1, 2, 3, 4)), period=40.5)
» 9 cycles of 40 samples; the cycles scatter by 1.7 (normal), 17 (tangential) » 8028.20741
» its 9 cycles come 12.0% of a period early altogether; is the period 39.96224 and not 40.5?
read(wave(400, 40, 0.5), recorded_cycles=5)
» 5 cycles of 80 samples; the cycles scatter by 0.5 (normal), 0.51 (tangential) » 15994.5372
» each cycle repeats 2 times: recorded_cycles = 10?
read(wave(400, 40, 0.1), recorded_cycles=1) » 1 cycle of 400 samples » 79994.5372
» the cycle repeats 2 times: recorded_cycles = 2?
read(wave(64, 8, 1e-3), recorded_cycles=4)
» 4 cycles of 16 samples; the cycles scatter by 0.0011 (normal), 0.00083 (tangential) » 3199.99821
» each cycle repeats 2 times: recorded_cycles = 8?
read(both(NORMAL[:2], [60.0, -60.0], 8), recorded_cycles=4) » 4 cycles of 2 samples » 410.0
read(wave(32, 4, 1e-3), recorded_cycles=4)
» 4 cycles of 8 samples; the cycles scatter by 0.00092 (normal), 0.00081 (tangential) » 1599.99883
» each cycle repeats 2 times: recorded_cycles = 8?
read(wave(24, 3, 1e-3), recorded_cycles=4)
» 4 cycles of 6 samples; the cycles scatter by 0.00089 (normal), 0.00088 (tangential) » 1199.99918
read(wave(400, 40, 0.1, (2, 3)), recorded_cycles=10)
» 10 cycles of 40 samples; the cycles scatter by 0.099 (normal), 0.1 (tangential) » 7999.45372
read(wave(400, 40, 0.1, (2, 4)), recorded_cycles=10)
» 10 cycles of 40 samples; the cycles scatter by 0.099 (normal), 0.1 (tangential) » 7999.45372
» each cycle repeats 2 times: recorded_cycles = 20?
read(wave(400, 40, 0.1, (3, 6)), recorded_cycles=10)
» 10 cycles of 40 samples; the cycles scatter by 0.099 (normal), 0.1 (tangential) » 7999.45372
» each cycle repeats 3 times: recorded_cycles = 30?
read(wave(400, 40, 3.0, (2, 4)), recorded_cycles=10)
» 10 cycles of 40 samples; the cycles scatter by 3 (normal), 3 (tangential) » 7983.61149
» each cycle repeats 2 times: recorded_cycles = 20?
read(cycles(RISE), recorded_cycles=40)
» 40 cycles of 20 samples; the cycles scatter by 0.48 (normal), 11 (tangential) » 4000.80091
» the first 4 cycles have a tangential amplitude of 11.93, the last of 60.03, and their mean, 52.51, is
    the load: skip_cycles = 10 leaves a start-up out; a block with keep_cycles = true runs all cycles
read(cycles(RISE), recorded_cycles=40, skip_cycles=10)
» 30 cycles of 20 samples; the cycles scatter by 0.47 (normal), 0.5 (tangential) » 4000.84164
read(cycles(RISE), recorded_cycles=40, skip_cycles=39) » 1 cycle of 20 samples » 4000.565
read(cycles([1.0] * 11 + [0.6]), recorded_cycles=12)
» 12 cycles of 20 samples; the cycles scatter by 0.52 (normal), 4.9 (tangential) » 4000.90793
» the first cycle has a tangential amplitude of 59.99, the last of 36.11, and their mean, 58.04, is the
    load: a block with keep_cycles = true runs all cycles
read(cycles([0.5, 1.0, 1.0, 1.0]), recorded_cycles=4)
» 4 cycles of 20 samples; the cycles scatter by 0.56 (normal), 11 (tangential) » 3999.64572
» the cycles' tangential loads differ by 10.6, and their mean, which is the load, moves by 37.1 (standard
    deviations): a block with keep_cycles = true runs each
read(cycles([0.5, 1.0, 1.0, 1.0], 0.01), recorded_cycles=4)
» 4 cycles of 20 samples; the cycles scatter by 0.011 (normal), 11 (tangential) » 3999.99291
» the cycles' tangential loads differ by 10.6, and their mean, which is the load, moves by 37.1 (standard
    deviations): a block with keep_cycles = true runs each
read(cycles([0.5, 1.0, 1.0], 0.01), recorded_cycles=3)
» 3 cycles of 20 samples; the cycles scatter by 0.011 (normal), 12 (tangential) » 3999.98707
» the cycles' tangential loads differ by 12.2, and their mean, which is the load, moves by 35.4 (standard
    deviations): a block with keep_cycles = true runs each
read(cycles([0.93] + [1.0] * 19, 0.01), recorded_cycles=20)
» 20 cycles of 20 samples; the cycles scatter by 0.01 (normal), 0.66 (tangential) » 4000.0142
read(cycles([0.88] + [1.0] * 19, 0.01), recorded_cycles=20)
» 20 cycles of 20 samples; the cycles scatter by 0.01 (normal), 1.1 (tangential) » 4000.0142
» the first 2 cycles have a tangential amplitude of 56.4, the last of 60, and their mean, 59.64, is the
    load: skip_cycles = 1 leaves a start-up out; a block with keep_cycles = true runs all cycles
read(cycles([0.96] + [1.0] * 9, 0.01), recorded_cycles=10)
» 10 cycles of 20 samples; the cycles scatter by 0.01 (normal), 0.54 (tangential) » 4000.01357
read(cycles([0.94] + [1.0] * 9, 0.01), recorded_cycles=10)
» 10 cycles of 20 samples; the cycles scatter by 0.01 (normal), 0.81 (tangential) » 4000.01357
» the first cycle has a tangential amplitude of 56.4, the last of 60, and their mean, 59.64, is the load:
    skip_cycles = 1 leaves a start-up out; a block with keep_cycles = true runs all cycles
read(wave(200, 50, 0.3, (1, 3)), recorded_cycles=4, harmonics=3, absolute=True)
» 4 cycles of 50 samples; mean normal load 199.96; the cycles scatter by 0.27 (normal), 0.27 (tangential); the
    harmonics miss 0.27 (normal), 0.27 (tangential) » 9997.53782
read(wave(200, 50, 0.3, (1, 3)), recorded_cycles=4, absolute=True)
» 4 cycles of 50 samples; mean normal load 199.96; the cycles scatter by 0.27 (normal), 0.27 (tangential) »
    9997.53782
read(wave(190, 50, 0.3), period=50)
» 3 cycles of 50 samples; the cycles scatter by 0.29 (normal), 0.27 (tangential) » 9996.91689
read(wave(99, 50, 0.3), period=50) » 1 cycle of 50 samples » 9997.79164
read(wave(100, 50, 0.3), period=50)
» 2 cycles of 50 samples; the cycles scatter by 0.29 (normal), 0.27 (tangential) » 9997.79013
read(np.minimum(wave(400, 40, 0.5), [900.0, 50.0]), recorded_cycles=10)
» 10 cycles of 40 samples; the cycles scatter by 0.49 (normal), 0.45 (tangential) » 7948.44371
» 70 samples of the tangential load are at its end, 50: is that the end of a load cell's range? Then the load
    is higher
read(np.maximum(wave(400, 40, 0.5), [0.0, -50.0]), recorded_cycles=10)
» 10 cycles of 40 samples; the cycles scatter by 0.49 (normal), 0.46 (tangential) » 8046.67391
» 70 samples of the tangential load are at its end, -50: is that the end of a load cell's range? Then the load
    is higher
read(np.minimum(wave(400, 40, 0.5), [900.0, 59.0]), recorded_cycles=10)
» 10 cycles of 40 samples; the cycles scatter by 0.49 (normal), 0.48 (tangential) » 7995.52807
read(np.round(wave(2000, 200, 0.01)), recorded_cycles=10)
» 10 cycles of 200 samples; the cycles scatter by 0.1 (normal), 0.022 (tangential) » 39999.8
read(np.clip(2.0 * wave(160, 40), 0.0, [900.0, 60.0]), recorded_cycles=4)
» 4 cycles of 40 samples » 17000.6661
""")


@pytest.mark.parametrize(("signal", "said"), SIGNALS)
def test_what_is_said_of_a_signal(tmp_path: Path, signal: str, said: list[str]) -> None:
    def read(values: np.ndarray, **given: Any) -> tuple[Any, list[str]]:
        np.savetxt(tmp_path / "r.csv", values, "%.17g", ",", header="normal,tangential", comments="")
        return warned(read_signal, tmp_path / "r.csv", **given)

    found, told = eval(signal, globals() | {"read": read})
    words, total, *lines = said
    assert repr(found) == f"<Signal r: {words}>"
    assert found.mean_cycle.sum() == pytest.approx(float(total), rel=1e-8)
    assert told == [f"r: {line}" for line in lines]


def sine(frequency: float) -> Callable[[np.ndarray], np.ndarray]:
    return lambda time: np.sin(2.0 * np.pi * frequency * time)


def alternating(time: np.ndarray) -> np.ndarray:
    return np.where(time % 2 < 1, 1.0, 0.6) * sine(1)(time)


def scattered(time: np.ndarray) -> np.ndarray:
    return np.repeat(np.random.default_rng(1).uniform(0.5, 1.0, 20), 100) * sine(1)(time)


def wandering(time: np.ndarray) -> np.ndarray:
    return sine(1)(time + 0.15 * np.sin(0.1 * np.pi * time))


#: Samples, how many in a cycle of the normal load, which is 1, a tangential load over 60 N, keys, and what is
#: told of it or refused; empty if nothing is.
MISLED = sayings(r"""
# half the frequency
read(2000, 100, sine(0.5), period=1) » moves by, .* such as period = 2;.*noise
# two cycles
read(2000, 100, sine(0.5), period=2)
# strokes that alternate
read(2000, 100, alternating, frequency=1)
» tangential loads differ by 8.71, .* moves by 33.9 .* such as frequency = 0.5\?$
# strokes that scatter
read(2000, 100, scattered, period=1) » differ by .*a block with keep_cycles = true runs each$
# too few harmonics
read(2000, 100, sine(8), period=1, harmonics=5)
» harmonics = 5 leaves out 37.6 of the tangential load, which moves by 42.4 .*: more harmonics
# enough harmonics
read(2000, 100, sine(8), period=1, harmonics=8)
# a misfit of a fast load
read(1228, 400, sine(8), recorded_cycles=3)
» recorded_cycles: found 3: the .* loads of its 3 cycles .* such as period = 1;
# a phase that wanders
read(2000, 100, wandering, period=1) » differ by 26.7, .* moves by 33.5
# a long drift of a fast load
read(19800, 200, sine(8), period=1.0007) » loads of its 98 cycles differ by 34.7, .* such as period = 1;
# a drift of many cycles
read(20000, 20, sine(1), period=1.0003)
» its 999 cycles come 30.2% of a period early altogether; is the period 0.99999\d+ and not 1.0003\?
# few samples
read(195, 8.15, sine(1), period=1)
» 8.15 samples a cycle, at other phases .* 4.9% off the .* load; harmonics = 1 takes nothing off
# few samples at the same phases
read(210, 7, sine(1), period=1)
# few samples of a fast load
read(2000, 100.3, sine(8), period=1)
» 100.3 samples a cycle.* 2.1% off the tangential load; harmonics = 8 takes nothing off
# a cycle too few
read(2000, 100, sine(1), recorded_cycles=19) » such as period = 1;
# a wrong period
read(2000, 100, sine(1), frequency=0.97) » such as frequency = (1|0.9999|1.0000)
# a half that does not move
read(2000, 100, np.zeros_like, period=0.5) » normal loads differ by 14.3, .* such as period = 1[?]
""")


@pytest.mark.parametrize(("signal", "words"), MISLED)
def test_a_mean_cycle_that_is_not_the_load_is_told(signal: str, words: list[str], tmp_path: Path) -> None:
    def read(count: int, samples: float, tangential: Callable, **given: Any) -> list[str]:
        time = np.arange(count) / samples
        normal = 200.0 + 20.0 * np.sin(2.0 * np.pi * time + 0.5)
        table = np.stack([time, normal, 60.0 * tangential(time)], axis=1)
        np.savetxt(tmp_path / "r.csv", table, delimiter=",", header="time,normal,tangential", comments="")
        try:
            return warned(read_signal, tmp_path / "r.csv", time="time", absolute=True, **given)[1]
        except StudyError as error:
            return [str(error)]

    said = eval(signal, globals() | {"read": read})
    assert any(re.search(words[0], each) for each in said) if words else not said, said
