"""Closed loops that rigs run, as their users define them: polygons, or sums of harmonics."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from swtstudy.mechanics.load.load import Load
from swtstudy.mechanics.load.loop import Loop, checked_name
from swtstudy.mechanics.load.polygon import PolygonLoad, without_collinear
from swtstudy.mechanics.load.smooth_path import SmoothPath, sampled
from swtstudy.mechanics.points import FloatArray
from swtstudy.mistakes import Mistake, StudyError, literal

#: Most vertices of a loop: a value with so many takes 30 s and 5 GB.
MOST_VERTICES = 2000
#: Sides of a loop that cost as much as one oscillation: 100 take as long as 8 to 16 of them, 200 as 32.
SIDES_PER_OSCILLATION = 12


class LoadPath(Loop):
    """A closed loop of the normal and the tangential load, run through again and again.

    Its sides are straight. Nothing depends on the speed, nor on the vertex at which it starts; the
    tangential load starts from zero at the first normal load. A loop run backwards is another loop.

    Parameters
    ----------
    name
        For people, files and figures.
    vertices
        Shape (k, 2), k ≥ 2: c_n and c_t, –. The normal load is 1 + its amplitude times c_n, the tangential
        one its amplitude times c_t, of whatever is prescribed. Vertices on the line between their neighbours
        are left out.

    Raises
    ------
    StudyError
        A ValueError with what is wrong with the name or the vertices.

    Examples
    --------
    >>> import swtstudy
    >>> square = swtstudy.LoadPath("square", [[0, 0.5], [0.5, 0.5], [0.5, -0.5], [0, -0.5]])
    >>> swtstudy.solve(load=square).s.round(4).item()
    0.1276
    """

    def __init__(self, name: str, vertices: ArrayLike) -> None:
        self.name = checked_name(name)
        #: Shape (k, 2), from the vertex that is the first in lexicographic order.
        self.vertices = _canonical(_checked(vertices, self.name), self.name)

    @classmethod
    def trapezoid(
        cls,
        name: str,
        *,
        normal: tuple[float, float] = (0.0, 1.0),
        tangential: tuple[float, float] = (-1.0, 1.0),
    ) -> LoadPath:
        """Normal load on, tangential load up, down, normal load off: a rectangle of both loads.

        Parameters
        ----------
        name
            Its name.
        normal, tangential
            Least and largest c_n and c_t.
        """
        (low, high), (back, forth) = normal, tangential
        return cls(name, [[low, back], [high, back], [high, forth], [low, forth]])

    @classmethod
    def triangle(cls, name: str, *, normal: float = 0.0, tangential: float = 1.0) -> LoadPath:
        """Both loads to and fro in proportion, in straight lines.

        Parameters
        ----------
        name
            Its name.
        normal, tangential
            c_n and c_t at one end; the other end is opposite.
        """
        return cls(name, [[normal, tangential], [-normal, -tangential]])

    def content(self) -> dict[str, Any]:
        return {"vertices": self.vertices.tolist()}

    @staticmethod
    def harmonic_sum(
        name: str,
        normal: Sequence[tuple[int, float, float]],
        tangential: Sequence[tuple[int, float, float]],
    ) -> SmoothPath:
        """Major and minor cycles: sums of harmonics, which are solved without sampling.

        Parameters
        ----------
        name
            Its name.
        normal, tangential
            Order (0 to 64), amplitude and phase (rad) of each harmonic of c_n and c_t, which are
            Σ amplitude · sin(order · φ + phase) over a period 2π of φ.

        Raises
        ------
        StudyError
            A ValueError with what is wrong with them.
        """
        return SmoothPath(name, normal, tangential)

    @staticmethod
    def sampled(name: str, course: Callable[[FloatArray], tuple[ArrayLike, ArrayLike]]) -> SmoothPath:
        """A smooth loop from a function, as the harmonic sum that it is.

        Parameters
        ----------
        name
            Its name.
        course
            From φ in [0, 2π), shape (k,), to c_n and c_t there, each of shape (k,) or a single number.

        Raises
        ------
        StudyError
            A ValueError, if harmonics up to the order 64 do not suffice: then vertices are the way.
        """
        return sampled(name, course)

    @classmethod
    def of_content(cls, name: str, content: Mapping[str, Any]) -> Loop:
        if "vertices" in content:
            return cls(name, content["vertices"])
        return SmoothPath(name, content["normal"], content["tangential"])

    @cached_property
    def cost(self) -> int:
        return 1 + len(self.vertices) // SIDES_PER_OSCILLATION

    @property
    def reach(self) -> float:
        return float(self.vertices[:, 0].max())

    @property
    def is_steady(self) -> bool:
        return bool(np.ptp(self.vertices[:, 0]) == 0.0)

    @property
    def turn_count(self) -> int:
        # As many again where contact is made or lost.
        return len(self.vertices)

    def loads(self, normal_amplitude: FloatArray, tangential_amplitude: FloatArray) -> Load:
        normal, tangential = self.vertices.T
        return PolygonLoad.of(
            [
                np.stack([1.0 + n * normal, t * tangential], axis=1)
                for n, t in zip(normal_amplitude, tangential_amplitude, strict=True)
            ]
        )


def _checked(vertices: ArrayLike, name: str) -> FloatArray:
    key = f"vertices of {name}"
    try:
        found = np.asarray(vertices)
    except (TypeError, ValueError):
        found = np.array("")
    if found.dtype.kind not in "iuf":
        raise StudyError([Mistake(key, literal(vertices), "a list of pairs of numbers")])
    found = found.astype(np.float64)
    if found.ndim != 2 or found.shape[1:] != (2,):
        raise StudyError([Mistake(key, f"an array of shape {found.shape}", "pairs of numbers, shape (k, 2)")])
    wrong = np.flatnonzero(~np.isfinite(found).all(axis=1))
    if wrong.size:
        row = int(wrong[0])
        raise StudyError(
            [Mistake(f"{key}, number {row + 1}", literal(found[row].tolist()), "finite numbers")]
        )
    return found


def _canonical(vertices: FloatArray, name: str) -> FloatArray:
    """Without vertices on the line between their neighbours, and from the least vertex on."""
    lean = without_collinear(vertices) + 0.0
    if len(lean) < 2:
        raise StudyError([Mistake(f"vertices of {name}", "a single point", "2 distinct points at least")])
    if len(lean) > MOST_VERTICES:
        found = f"{len(lean)} vertices that are not on a line between their neighbours"
        allowed = f"at most {MOST_VERTICES}; a smooth loop is a harmonic sum (LoadPath.harmonic_sum)"
        raise StudyError([Mistake(f"vertices of {name}", found, allowed)])
    first = np.lexsort(lean.T[::-1])[0]
    return np.roll(lean, -first, axis=0)
