"""Smooth loops, whose components are sums of harmonics."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from swtstudy.kernel.loops import ends_of_sum
from swtstudy.solver.loop import LARGEST, Loop
from swtstudy.vocabulary.arrays import FloatArray
from swtstudy.vocabulary.mistakes import is_number, literal, plain_number, refused

#: Amplitudes below this share of the largest one are rounding of a Fourier transform.
ROUNDING = 1e-12
#: Instants at which a loop is drawn.
DRAWN = 721
#: Highest harmonic of a loop, as for the frequency ratio of two oscillations.
HIGHEST_ORDER = 64
#: Samples of a function for its harmonics.
SAMPLES = 1024


class SmoothPath(Loop):
    """A loop of sums of harmonics; see `LoadPath.harmonic_sum`."""

    def __init__(
        self, name: str, normal: object, tangential: object, bulk: object = (), *, mean_normal: object = None
    ) -> None:
        super().__init__(name, mean_normal)
        columns = {"normal": normal, "tangential": tangential, "bulk": bulk}
        #: Rows of order, amplitude and phase of c_n, c_t and c_b.
        self.harmonics = {key: _checked(rows, f"{key} of {name}") for key, rows in columns.items()}
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


def _checked(rows: object, key: str) -> list[list[float]]:
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
