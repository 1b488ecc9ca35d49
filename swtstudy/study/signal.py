"""Loads that a rig has recorded over some cycles, their mean cycle and their loops."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from swtstudy.kernel.loops import slope_of
from swtstudy.solver.load_path import LoadPath, Loop
from swtstudy.study import cycles
from swtstudy.vocabulary.arrays import FloatArray, IndexArray
from swtstudy.vocabulary.mistakes import refused
from swtstudy.vocabulary.wording import number_of

#: By what share of a step a record may be shorter than a whole number of periods.
ROUNDING = 1e-6
#: Share of its amplitude by which noise takes a bulk stress off the tangential load that it follows, at most.
NOISY = 0.5

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
        if self.is_one_cycle:
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
        return cycles.beside(self.values[: self.used], load[: self.used])

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
        elif self.is_one_cycle:
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
        return np.asarray(np.sqrt(np.mean((self.values[: self.used] - self.fit) ** 2, axis=0)))

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
    def used(self) -> int:
        """Samples within the whole cycles."""
        end = self.time[0] + self.count * self.period
        return int(np.searchsorted(self.time, end - ROUNDING * self.period))

    @property
    def is_one_cycle(self) -> bool:
        """True if all samples are one cycle, which keeps them as they are."""
        return self.count == 1 and self.used == len(self.time)

    @property
    def phase(self) -> FloatArray:
        """φ of each sample within the whole cycles, rad, from 0 on."""
        return 2.0 * np.pi * (self.time[: self.used] - self.time[0]) / self.period

    @cached_property
    def _fits(self) -> list[tuple[FloatArray, FloatArray]]:
        return [cycles.harmonics(self.phase, column, self.highest) for column in self.values[: self.used].T]

    def _polygon(self, name: str, cycle: FloatArray) -> LoadPath:
        off = np.eye(1, cycle.shape[1]) * (self.mean_normal or 0.0)
        if self.is_steady:
            mean = self.cycles[..., 0].mean() if self.mean_normal is None else self.mean_normal
            cycle = np.insert(cycle[:, 1:], 0, mean, axis=1)
        if self.pull:
            cycle[:, 2] = cycle[:, 2].mean() + self.pull * (cycle[:, 1] - cycle[:, 1].mean())
        return LoadPath(name, cycle - off, self.mean_normal)
