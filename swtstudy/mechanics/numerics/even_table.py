"""Smooth functions on even cells: no search, and as exact as their derivatives at the nodes."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.points import FloatArray


class EvenTable:
    """n functions on [0, end], each as quintic polynomials with its values and two derivatives at even nodes.

    Parameters
    ----------
    end
        Shape (n,).
    value, slope, bend
        Shape (n, k + 1): at the nodes.
    """

    def __init__(self, end: FloatArray, value: FloatArray, slope: FloatArray, bend: FloatArray) -> None:
        self._cells = value.shape[1] - 1
        #: Cells in a unit of the abscissa.
        self._density = self._cells / end
        first, second = slope / self._density[:, None], bend / self._density[:, None] ** 2
        rise, f, g = np.diff(value), first[:, :-1], first[:, 1:]
        p, q = 0.5 * second[:, :-1], 0.5 * second[:, 1:]
        powers = (
            value[:, :-1],
            f,
            p,
            10.0 * rise - 6.0 * f - 4.0 * g - 3.0 * p + q,
            -15.0 * rise + 8.0 * f + 7.0 * g + 3.0 * p - 2.0 * q,
            6.0 * rise - 3.0 * (f + g) - p + q,
        )
        #: Coefficients of each cell, in powers of the share of it that is passed.
        self._coefficients = np.stack(powers, axis=-1).reshape(-1, len(powers))

    def __call__(self, row: NDArray[np.intp], at: FloatArray) -> FloatArray:
        """The functions number ``row`` at (…)."""
        c, share, _ = self._cell(row, at)
        value = c[5] * share
        for each in c[4:0:-1]:
            value += each
            value *= share
        value += c[0]
        return value

    def with_slope(self, row: NDArray[np.intp], at: FloatArray) -> tuple[FloatArray, FloatArray]:
        """The functions and their derivatives."""
        c, share, density = self._cell(row, at)
        value, slope = _with_slope(c, share)
        return value, slope * density

    def with_derivatives(
        self, row: NDArray[np.intp], at: FloatArray
    ) -> tuple[FloatArray, FloatArray, FloatArray]:
        """The functions and two derivatives."""
        c, share, density = self._cell(row, at)
        value, slope = _with_slope(c, share)
        bend = ((20.0 * c[5] * share + 12.0 * c[4]) * share + 6.0 * c[3]) * share + 2.0 * c[2]
        return value, slope * density, bend * density * density

    def _cell(self, row: NDArray[np.intp], at: FloatArray) -> tuple[list[FloatArray], FloatArray, FloatArray]:
        """Coefficients of the cells, the shares of them that are passed, and the density of cells."""
        density = self._density.take(row)
        place = at * density
        cell = np.minimum(place.astype(np.intp), self._cells - 1)
        own = self._coefficients.take(row * self._cells + cell, axis=0)
        return [own[..., k] for k in range(own.shape[-1])], place - cell, density


def _with_slope(c: list[FloatArray], share: FloatArray) -> tuple[FloatArray, FloatArray]:
    """A polynomial and its derivative by Horner's scheme."""
    slope, value = c[5], c[5] * share + c[4]
    for each in c[3::-1]:
        slope = slope * share + value
        value = value * share + each
    return value, slope
