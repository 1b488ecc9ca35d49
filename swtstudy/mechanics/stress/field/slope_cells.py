"""Slopes of the springs as straight pieces on cells of ξ, so that the field integrals are closed form.

Each piece keeps its cell's integrals ∫ g′ dξ and ∫ ξ g′ dξ (it is the L² projection of g′ on straight
lines); on the axis the piece starts at 0 and keeps the first integral only. Beneath the surface, where the
punch's field is smooth across a cell, the error of the stress is then O(h⁴), in the surface O(h^5/2); a
paraboloid's slope is exact. The integrable singularity of the truncated paraboloid needs no care beyond
cells that shrink towards it.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from swtstudy.mechanics.points import FloatArray

#: Gauss points per cell for the integrals of the slopes. Half: 8e-11 in 16 values of bodies; twice: 2e-14;
#: the same time.
GAUSS_POINTS = 8
#: Narrower cells keep the mean slope only: the digits of a gradient would be lost. A hundredth: 5e-9 in 16
#: values of bodies; a hundred times: 9e-6.
NARROW = 1e-6


@dataclass(frozen=True)
class SlopeCells:
    """k slope functions, each intercept + gradient · ξ on each of m cells.

    Attributes
    ----------
    radius
        Shape (m + 1,), increasing: the ends of the cells, in a_H.
    intercept, gradient
        Shape (k, m), in δ0/a_H and δ0/a_H². The first function is the profile's g′, the others are g′ times
        dτ/dG of springs that share a history.
    """

    radius: FloatArray
    intercept: FloatArray
    gradient: FloatArray

    def merged(self, kept: NDArray[np.intp]) -> SlopeCells:
        """The same on fewer cells, each with the integrals of those in it.

        Parameters
        ----------
        kept
            Shape (j + 1,), ascending: numbers of the ends that are kept, the first and the last among them.
        """
        ends, width = self.radius[kept], np.diff(self.radius)
        middle = 0.5 * (self.radius[1:] + self.radius[:-1])
        centre = 0.5 * (ends[1:] + ends[:-1])
        offset = middle - np.repeat(centre, np.diff(kept))
        mass = (self.intercept + self.gradient * middle) * width
        moment = mass * offset + self.gradient * width**3 / 12.0
        mean, moment = (np.add.reduceat(v, kept[:-1], axis=1) / np.diff(ends) for v in (mass, moment))
        gradient = np.where(
            np.diff(kept) > 1, 12.0 * moment / np.diff(ends) ** 2, self.gradient[:, kept[:-1]]
        )
        if ends[0] == 0.0:
            gradient[:, 0] = 2.0 * mean[:, 0] / ends[1]
        return SlopeCells(ends, mean - gradient * centre, gradient)


def graded_radii(start: float, end: float, cells: int) -> FloatArray:
    """Cell ends from start to end, shrinking towards start like (k/n)².

    That resolves √(ξ − b) and 1/√(ξ − b); a stronger grading costs digits, since rounding grows like the
    gradient in the smallest cell.

    Parameters
    ----------
    start, end
        First and last radius; the slope's singularity, if any, at start.
    cells
        Number of cells n.

    Returns
    -------
    Shape (cells + 1,).
    """
    return start + (end - start) * np.linspace(0.0, 1.0, cells + 1) ** 2


def slope_cells(
    weighted_slope: Callable[[FloatArray], FloatArray], radius: ArrayLike, start: float = 0.0
) -> SlopeCells:
    """Project slope functions on straight pieces.

    Parameters
    ----------
    weighted_slope
        From an array of ξ in a_H to slopes times √(ξ² − start²), as `Profile.weighted_slope`: of the same
        shape for one function, or with a leading axis k for several.
    radius
        Shape (m + 1,), increasing, the first not below start: ends of the cells.
    start
        Radius at which the slope starts, possibly as (ξ − start)^(±1/2): the radius b of a punch's face.
    """
    ends = np.asarray(radius, dtype=float)
    # In t = √(ξ − start) the root singularities at the start are smooth: ξ = start + t², dξ = 2t dt, and
    # √(ξ² − start²) = t √(2 start + t²).
    root = np.sqrt(np.maximum(ends - start, 0.0))
    nodes, weights = np.polynomial.legendre.leggauss(GAUSS_POINTS)
    t = 0.5 * (root[1:, None] + root[:-1, None] + nodes * np.diff(root)[:, None])
    width = np.diff(ends)
    values = np.asarray(weighted_slope(start + t**2)).reshape(-1, *t.shape)
    mass = values * (weights * np.diff(root)[:, None] / np.sqrt(2.0 * start + t**2))
    # Offset from the cell's middle in half widths; written in t to keep its digits in small cells.
    middle = 0.5 * (root[1:, None] ** 2 + root[:-1, None] ** 2)
    offset = (t**2 - middle) * (2.0 / width[:, None])
    mean = mass.sum(axis=-1) / width
    gradient = np.where(width > NARROW * ends[-1], 6.0 * (mass * offset).sum(axis=-1) / width**2, 0.0)
    if ends[0] == 0.0:
        # g′(0) = 0: an intercept, however small, would make the stress on the axis logarithmically infinite.
        gradient[:, 0] = 2.0 * mean[:, 0] / width[0]
    return SlopeCells(ends, mean - gradient * 0.5 * (ends[1:] + ends[:-1]), gradient)
