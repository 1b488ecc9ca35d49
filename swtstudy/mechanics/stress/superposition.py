"""The stress history at points of the body: punches or strips of all radii, weighted with slopes (15–18).

Each spring sits at its depth G = g(ξ): a state of the contact says for each cell of radii whether it touches
and with which slope dτ/dG its tangential displacement varies. The cells' fields do not depend on the state,
so that they are computed and summed up from the axis once per point. A state is made of few pieces with one
slope: it picks the sums at their ends, which is a product with a sparse matrix.

The slopes are straight pieces on cells of ξ, so that the field integrals are closed form. Each piece keeps
its cell's integrals ∫ g′ dξ and ∫ ξ g′ dξ (it is the L² projection of g′ on straight lines); on the axis the
piece starts at 0 and keeps the first integral only. Beneath the surface, where the punch's field is smooth
across a cell, the error of the stress is then O(h⁴), in the surface O(h^5/2); a paraboloid's slope is exact.
The integrable singularity of the truncated paraboloid needs no care beyond cells that shrink towards it.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from scipy.sparse import csr_array

from swtstudy.mechanics.indenter.base import Profile
from swtstudy.mechanics.points import FloatArray, IndexArray
from swtstudy.mechanics.stress import punch, strip


@dataclass(frozen=True)
class Kernels:
    """The field of one disc or strip.

    Attributes
    ----------
    functions
        Named tuple of the functions of which it is made, or of their integrals over ξ.
    distance
        From x and y to the distance at which the functions are taken.
    primitives
        From distances, depths and radii to the functions integrated over ξ, weighted with 1 and with ξ.
    normal, tangential
        From the functions, x, y, z and ν to the stress by pressure and by shear in +x.
    """

    functions: type[punch.PunchFunctions] | type[strip.StripFunctions]
    distance: Callable[[FloatArray, FloatArray], FloatArray]
    primitives: Callable[[FloatArray, FloatArray, FloatArray], tuple[Any, Any]]
    normal: Callable[..., FloatArray]
    tangential: Callable[..., FloatArray]


DISC = Kernels(
    punch.PunchFunctions, np.hypot, punch.primitives, punch.normal_components, punch.tangential_components
)
STRIP = Kernels(
    strip.StripFunctions,
    lambda x, _: np.abs(x),
    strip.strip_primitives,
    strip.normal_components,
    strip.tangential_components,
)


def kernels_of(profile: Profile) -> Kernels:
    """Return the kernels of a profile's contact."""
    return STRIP if profile.plane else DISC


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

    def merged(self, kept: IndexArray) -> SlopeCells:
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
        wide = np.diff(ends) > NARROW * ends[-1]
        merged = np.where(wide, 12.0 * moment / np.diff(ends) ** 2, 0.0)
        gradient = np.where(np.diff(kept) > 1, merged, self.gradient[:, kept[:-1]])
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


#: Points × radii evaluated at a time: the temporaries stay in the processor's cache. A sixteenth or 64 times:
#: 30 % slower.
BLOCK = 16384


def cell_stress(
    x: ArrayLike, y: ArrayLike, z: ArrayLike, cells: SlopeCells, poisson_ratio: float, kernels: Kernels
) -> FloatArray:
    """Stress due to each cell of springs: compressed by their full slope, and dragged by each slope function.

    Parameters
    ----------
    x, y, z
        Shape (n,): position in a_H, z ≥ 0 into the body.
    cells
        k slope functions on m cells.
    poisson_ratio
        ν.
    kernels
        What is superposed.

    Returns
    -------
    stress
        Shape (1 + k, m, n, 6), components as `punch.COMPONENTS`, in E* √(δ0/R): first under the pressure
        (1/π) ∫ g′ dξ/√(ξ² − r²), ξ over the cell; then under the shear (1/π) ∫ s dξ/√(ξ² − r²) in +x for each
        slope function s.
    """
    x, y, z = (np.asarray(v, dtype=float) for v in (x, y, z))
    plain, weighted = (
        [np.diff(f, axis=0) for f in functions]
        for functions in kernels.primitives(kernels.distance(x, y), z, cells.radius[:, None])
    )
    stress = np.empty((1 + len(cells.intercept), len(cells.radius) - 1, x.size, 6))
    slopes = cells.intercept[..., None] / np.pi, cells.gradient[..., None] / np.pi
    for number, (intercept, gradient) in enumerate(zip(*slopes, strict=True)):
        f = kernels.functions(*(intercept * a + gradient * b for a, b in zip(plain, weighted, strict=True)))
        if number == 0:
            stress[0] = kernels.normal(f, x, y, z, poisson_ratio)
        stress[1 + number] = kernels.tangential(f, x, y, z, poisson_ratio)
    return stress


def stress_history(
    x: ArrayLike,
    y: ArrayLike,
    z: ArrayLike,
    cells: SlopeCells,
    touching: ArrayLike,
    tangential_slope: ArrayLike,
    friction: float,
    poisson_ratio: float,
    kernels: Kernels = DISC,
) -> FloatArray:
    """Stress at points of the body for a sequence of contact states.

    Parameters
    ----------
    x, y, z
        Position in a_H, z ≥ 0 into the body; broadcastable to one shape S.
    cells
        k slope functions on m cells.
    touching
        Shape (..., m): 1 for a cell in contact, 0 for one out of contact (the contact radius is a cell's
        end).
    tangential_slope
        Shape (..., k, m): share of each slope function in dτ/dξ, with the spring displacement
        τ = G* u/(μ E* δ0); for the first function that is dτ/dG in [−1, 1].
    friction, poisson_ratio
        μ, ν.
    kernels
        What is superposed.

    Returns
    -------
    stress
        Shape S + (..., 6), components as `punch.COMPONENTS`, in E* √(δ0/R). Tension is positive.
    """
    x, y, z = np.broadcast_arrays(*(np.asarray(v, dtype=float) for v in (x, y, z)))
    touching, shares = np.asarray(touching, dtype=float), np.asarray(tangential_slope, dtype=float)
    # q = −(μ/π) ∫ τ′ dξ/√(ξ² − r²): hence the sign of the drag.
    states = np.concatenate([touching[..., None, :], -friction * shares], axis=-2)
    jumps = csr_array(-np.diff(states, axis=-1, append=0.0).reshape(-1, states.shape[-2] * states.shape[-1]))
    stress = np.empty((x.size, jumps.shape[0], 6))
    columns = max(1, BLOCK // len(cells.radius))
    for first in range(0, x.size, columns):
        part = slice(first, first + columns)
        fields = cell_stress(x.flat[part], y.flat[part], z.flat[part], cells, poisson_ratio, kernels)
        sums = np.cumsum(fields, axis=1, out=fields).reshape(jumps.shape[1], -1)
        stress[part] = (jumps @ sums).reshape(jumps.shape[0], -1, 6).swapaxes(0, 1)
    return stress.reshape(*x.shape, *touching.shape[:-1], 6)
