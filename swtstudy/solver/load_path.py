"""Closed loops that rigs run, as their users define them: polygons, or sums of harmonics."""

from __future__ import annotations

import itertools
import warnings
from abc import abstractmethod
from collections.abc import Callable, Mapping, Sequence
from functools import cached_property
from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike

from swtstudy.kernel.loops import ends_of_sum, without_collinear
from swtstudy.vocabulary.arrays import FloatArray
from swtstudy.vocabulary.definition import Definition, read_numbers, wrong_name
from swtstudy.vocabulary.mistakes import StudyError, is_number, literal, plain_number, refused
from swtstudy.vocabulary.parameters import MANY_TURNS, PAIRS

#: Largest number of a loop: squares of it are numbers still, whatever its unit.
LARGEST = 1e100
FINITE = f"finite numbers, in magnitude up to {LARGEST:g}"
#: How many times as far from 0 as half of its range the middle of a column of deviations may be.
FAR = 2.0
#: Amplitudes below this share of the largest one are rounding of a Fourier transform.
ROUNDING = 1e-12
#: Instants at which a loop is drawn.
DRAWN = 721
#: Highest harmonic of a loop, as for the frequency ratio of two oscillations.
HIGHEST_ORDER = 64
#: Samples of a function for its harmonics.
SAMPLES = 1024
#: Most vertices of a loop: a value with so many takes some 6 s.
MOST_VERTICES = 2000
#: Sides of a loop that cost as much as one oscillation: 100 take as long as 8 to 16 of them, 200 as 32.
SIDES_PER_OSCILLATION = 12


class Loop(Definition):
    """A closed loop of the normal and the tangential load, run through again and again.

    The normal load is 1 + its amplitude times c_n, the tangential one its amplitude times c_t, of whatever is
    prescribed. A bulk stress may go with it: its mean plus its amplitude times c_b.
    """

    parameter: ClassVar[str] = "load"

    def __init__(self, name: object, mean_normal: object) -> None:
        self.name = checked_name(name)
        #: The mean normal load, in the unit of its column, from which c_n deviates; None if it is unknown.
        self.mean_normal = None if mean_normal is None else plain_number(mean_normal)
        if self.mean_normal is not None and not 0.0 < self.mean_normal <= LARGEST:
            found = literal(mean_normal) if isinstance(mean_normal, str) else f"{self.mean_normal:g}"
            raise refused(f"mean_normal of {name}", found, "a positive number: bodies are pressed")

    @property
    @abstractmethod
    def ends(self) -> list[tuple[float, float]]:
        """Least and largest c_n, c_t and, with a bulk stress, c_b."""

    @property
    def normal_ends(self) -> tuple[float, float]:
        """Least and largest c_n."""
        return self.ends[0]

    @property
    def bulk_ends(self) -> tuple[float, float] | None:
        """Least and largest c_b; None where there is no bulk stress."""
        return self.ends[2] if len(self.ends) > 2 else None

    @property
    def is_absolute(self) -> bool:
        """True if c_n looks like a load itself, not like its deviation from the mean."""
        low, high = self.normal_ends
        return abs(low + high) > FAR * (high - low)

    @property
    def scaled_by(self) -> tuple[str, ...]:
        return (*PAIRS.values(), *(("bulk_stress_amplitude",) if self.bulk_ends else ()))

    def content(self) -> dict[str, Any]:
        """The mean normal load, where it is known; the kinds of loops add what they are made of."""
        return {} if self.mean_normal is None else {"mean_normal": self.mean_normal}

    @abstractmethod
    def course(self) -> FloatArray:
        """c_n, c_t and, with a bulk stress, c_b over a round, its begin once more at the end: (T, 2 or 3)."""


def checked_name(name: object) -> str:
    """The name of a loop.

    Raises
    ------
    StudyError
        A ValueError if it is not a name, or the name of a built-in load.
    """
    if mistake := wrong_name(name, "load"):
        raise StudyError([mistake])
    return str(name)


class SmoothPath(Loop):
    """A loop of sums of harmonics; see `LoadPath.harmonic_sum`."""

    def __init__(
        self, name: str, normal: object, tangential: object, bulk: object = (), *, mean_normal: object = None
    ) -> None:
        super().__init__(name, mean_normal)
        columns = {"normal": normal, "tangential": tangential, "bulk": bulk}
        #: Rows of order, amplitude and phase of c_n, c_t and c_b.
        self.harmonics = {key: _checked_harmonics(rows, f"{key} of {name}") for key, rows in columns.items()}
        if ends_of_sum(self.harmonics["bulk"]) == (0.0, 0.0):
            del self.harmonics["bulk"]
        if not any(order and size for rows in self.harmonics.values() for order, size, _ in rows):
            raise refused(f"harmonics of {name}", "nothing that changes", "a loop")

    def content(self) -> dict[str, Any]:
        return self.harmonics | super().content()

    @classmethod
    def of_content(cls, name: str, content: Mapping[str, Any]) -> SmoothPath:
        rows = content["normal"], content["tangential"], content.get("bulk", ())
        return cls(name, *rows, mean_normal=content.get("mean_normal"))

    @cached_property
    def cost(self) -> int:
        orders = (order for rows in self.harmonics.values() for order, size, _ in rows if size)
        return 1 + int(max([1, *orders]))

    @cached_property
    def ends(self) -> list[tuple[float, float]]:
        return [ends_of_sum(rows) for rows in self.harmonics.values()]

    def course(self) -> FloatArray:
        turn = np.linspace(0.0, 2.0 * np.pi, DRAWN)
        columns = [
            sum((size * np.sin(order * turn + phase) for order, size, phase in rows), np.zeros(DRAWN))
            for rows in self.harmonics.values()
        ]
        return np.stack(columns, axis=1)


def sampled(name: str, course: Callable[[FloatArray], tuple[ArrayLike, ...]]) -> SmoothPath:
    """A smooth loop from a function; see `LoadPath.sampled`."""
    instant = 2.0 * np.pi * np.arange(SAMPLES) / SAMPLES
    try:
        columns = [np.broadcast_to(np.asarray(each, float), instant.shape) for each in course(instant)]
        if len(columns) not in (2, 3):
            raise ValueError(f"{len(columns)} columns")
    except (TypeError, ValueError) as error:
        allowed = "c_n and c_t, or c_n, c_t and c_b, each of the shape of φ"
        raise refused(f"course of {name}", f"a function that fails ({error})", allowed) from None
    if not all(np.isfinite(each).all() for each in columns):
        raise refused(f"course of {name}", "a value that is no finite number", "finite numbers")
    return SmoothPath(name, *[_harmonics(each, name) for each in columns])


def _harmonics(values: FloatArray, name: str) -> list[tuple[int, float, float]]:
    """Order, amplitude and phase of the harmonics of even samples over a period."""
    found = np.fft.rfft(values) / len(values)
    found[1:] *= 2.0
    size = np.abs(found)
    kept = np.flatnonzero(size > ROUNDING * size.max(initial=0.0))
    if kept.max(initial=0) > HIGHEST_ORDER:
        beyond = f"harmonics beyond the order {HIGHEST_ORDER}, of up to {size[HIGHEST_ORDER + 1 :].max():.1g}"
        allowed = "a smooth loop; one with corners has vertices: LoadPath(name, vertices)"
        raise refused(f"course of {name}", beyond, allowed)
    # cos(kφ + β) = sin(kφ + β + π/2).
    return [(int(k), float(size[k]), float(np.angle(found[k]) + 0.5 * np.pi)) for k in kept]


def _checked_harmonics(rows: object, key: str) -> list[list[float]]:
    """Rows of order, amplitude and phase."""
    allowed = f"rows of order (a whole number up to {HIGHEST_ORDER}), amplitude and phase"
    if not isinstance(rows, Sequence | np.ndarray) or isinstance(rows, str):
        raise refused(key, literal(rows), allowed)
    for row in rows:
        sound = isinstance(row, Sequence | np.ndarray) and len(row) == 3 and all(map(is_number, row))
        sound = sound and all(abs(plain_number(each)) <= LARGEST for each in row)
        if not (sound and row[0] == int(row[0]) and 0 <= row[0] <= HIGHEST_ORDER):
            raise refused(key, literal(row), allowed)
    return [[int(row[0]), float(row[1]), float(row[2])] for row in rows]


class LoadPath(Loop):
    """A closed loop of the normal and the tangential load and a bulk stress, run through again and again.

    Its sides are straight. Nothing depends on the speed, nor on the vertex at which it starts; the
    tangential load starts from zero at the first normal load. A loop run backwards is another loop.

    A polygon of k points in place of a smooth cycle changes s: in the tested cycles by less than 3/k
    (results/loads.md). `LoadPath.sampled` and `LoadPath.harmonic_sum` have no such error.

    Parameters
    ----------
    name
        For people, files and figures.
    vertices
        Shape (k, 2), k ≥ 2: c_n and c_t, –; or (k, 3), with c_b. The normal load is 1 + its amplitude times
        c_n, the tangential one its amplitude times c_t, of whatever is prescribed; the bulk stress is its
        mean plus its amplitude times c_b, 0 without that column. Vertices on the line between their
        neighbours in all columns are left out.
    mean_normal
        The mean normal load from which the first column is the deviation, in its unit: then a real contact
        needs no normal force. `LoadPath.absolute` subtracts this mean.

    Raises
    ------
    StudyError
        A ValueError with the mistakes in the name or the vertices.

    Examples
    --------
    >>> import swtstudy
    >>> square = swtstudy.LoadPath("square", [[0, 0.5], [0.5, 0.5], [0.5, -0.5], [0, -0.5]])
    >>> swtstudy.solve(load=square).s.round(4).item()
    0.1276
    """

    def __init__(self, name: str, vertices: ArrayLike, mean_normal: float | None = None) -> None:
        super().__init__(name, mean_normal)
        found = _checked_vertices(vertices, self.name)
        if found.shape[1] == 3 and not found[:, 2].any():
            found = found[:, :2]
        lean = without_collinear(found) + 0.0
        if len(lean) < 2:
            raise refused(f"vertices of {name}", "a single point", "2 distinct points at least")
        if len(lean) > MOST_VERTICES:
            words = f"{len(lean)} vertices that are not on a line between their neighbours"
            allowed = (
                f"at most {MOST_VERTICES}; of more a smooth loop is the harmonic sum (LoadPath.harmonic_sum; "
                "harmonics of a signal), and several cycles are folded (recorded_cycles)"
            )
            raise refused(f"vertices of {name}", words, allowed)
        #: Shape (k, 2), or (k, 3) unless c_b is 0, from the vertex that is the first in lexicographic order.
        self.vertices = np.roll(lean, -np.lexsort(lean.T[::-1])[0], axis=0)

    @classmethod
    def absolute(cls, name: str, loads: ArrayLike) -> LoadPath:
        """A loop of loads as they are measured: the mean of the normal one is taken off.

        Parameters
        ----------
        name
            Its name.
        loads
            As ``vertices``, with the normal load itself instead of its deviation.
        """
        found = _checked_vertices(loads, checked_name(name))
        mean = float(found[:, 0].mean())
        return cls(name, found - np.eye(1, found.shape[1]) * mean, mean)

    @classmethod
    def trapezoid(
        cls,
        name: str,
        *,
        normal: tuple[float, float] = (0.0, 1.0),
        tangential: tuple[float, float] = (-1.0, 1.0),
        bulk: tuple[float, float] = (0.0, 0.0),
    ) -> LoadPath:
        """Normal load on, tangential load up, down, normal load off: a rectangle of both loads.

        Parameters
        ----------
        name
            Its name.
        normal, tangential
            Least and largest c_n and c_t.
        bulk
            c_b where c_t is least and largest: the bulk stress goes with the tangential load.
        """
        (low, high), back, forth = normal, *zip(tangential, bulk, strict=True)
        return cls(name, [[low, *back], [high, *back], [high, *forth], [low, *forth]])

    @classmethod
    def triangle(
        cls, name: str, *, normal: float = 0.0, tangential: float = 1.0, bulk: float = 0.0
    ) -> LoadPath:
        """Both loads and the bulk stress to and fro in proportion, in straight lines.

        Parameters
        ----------
        name
            Its name.
        normal, tangential, bulk
            c_n, c_t and c_b at one end; the other end is opposite.
        """
        return cls(name, [[normal, tangential, bulk], [-normal, -tangential, -bulk]])

    def content(self) -> dict[str, Any]:
        return {"vertices": self.vertices.tolist()} | super().content()

    @staticmethod
    def harmonic_sum(
        name: str,
        normal: Sequence[tuple[int, float, float]],
        tangential: Sequence[tuple[int, float, float]],
        bulk: Sequence[tuple[int, float, float]] = (),
        *,
        mean_normal: float | None = None,
    ) -> SmoothPath:
        """Major and minor cycles: sums of harmonics, which are solved without sampling.

        Parameters
        ----------
        name
            Its name.
        normal, tangential, bulk
            Order (0 to 64), amplitude and phase (rad) of each harmonic of c_n, c_t and c_b, which are
            Σ amplitude · sin(order · φ + phase) over a period 2π of φ.
        mean_normal
            As of a `LoadPath`.

        Raises
        ------
        StudyError
            A ValueError with what is wrong with them.
        """
        path = SmoothPath(name, normal, tangential, bulk, mean_normal=mean_normal)
        for column, rows in path.harmonics.items():
            largest = max((phase for *_, phase in rows), key=abs, default=0.0)
            if abs(largest) > MANY_TURNS:
                words = f"{column} of {name}: a phase of {largest:g} is in radians; for degrees "
                words += f'np.radians({largest:g}), in a study "{largest:g} deg"'
                warnings.warn(words, stacklevel=2)
        return path

    @staticmethod
    def sampled(name: str, course: Callable[[FloatArray], tuple[ArrayLike, ...]]) -> SmoothPath:
        """A smooth loop from a function, as the harmonic sum that it is.

        Parameters
        ----------
        name
            Its name.
        course
            From φ in [0, 2π), shape (k,), to c_n and c_t there, or c_n, c_t and c_b, each of shape (k,) or a
            single number.

        Raises
        ------
        StudyError
            A ValueError, if harmonics up to the order 64 do not suffice: then vertices are the way.
        """
        return sampled(name, course)

    @classmethod
    def of_content(cls, name: str, content: Mapping[str, Any]) -> Loop:
        if "vertices" in content:
            return cls(name, content["vertices"], content.get("mean_normal"))
        return SmoothPath.of_content(name, content)

    def thinned(self, most: int) -> LoadPath:
        """A loop of every second, third … of its vertices: of no more than so many."""
        return LoadPath(self.name, self.vertices[:: -(-len(self.vertices) // most)], self.mean_normal)

    @cached_property
    def cost(self) -> int:
        return 1 + len(self.vertices) // SIDES_PER_OSCILLATION

    @cached_property
    def ends(self) -> list[tuple[float, float]]:
        return [(float(column.min()), float(column.max())) for column in self.vertices.T]

    def course(self) -> FloatArray:
        return np.concatenate([self.vertices, self.vertices[:1]])


def _checked_vertices(vertices: ArrayLike, name: str) -> FloatArray:
    """The vertices of a loop as numbers, all of them finite."""
    key = f"vertices of {name}"
    try:
        found = read_numbers(key, vertices, "a list of pairs of numbers, or of triples with the bulk stress")
    except StudyError:
        rows: Any = vertices if isinstance(vertices, Sequence) else []
        pairs = itertools.pairwise(rows if all(isinstance(each, Sequence) for each in rows) else [])
        for number, (before, each) in enumerate(pairs, start=2):
            if {len(before), len(each)} == {2, 3}:
                allowed = f"{len(before)} numbers, as before: the third one is the bulk stress"
                raise refused(f"{key}, number {number}", literal(each), allowed) from None
        raise
    if found.ndim != 2 or found.shape[1] not in (2, 3):
        allowed = "pairs of numbers, shape (k, 2), or triples with the bulk stress, (k, 3)"
        raise refused(key, f"an array of shape {found.shape}", allowed)
    wrong = np.flatnonzero(~(np.abs(found) <= LARGEST).all(axis=1))
    if wrong.size:
        raise refused(f"{key}, number {wrong[0] + 1}", literal(found[wrong[0]].tolist()), FINITE)
    return found
