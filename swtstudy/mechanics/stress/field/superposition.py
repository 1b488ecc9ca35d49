"""The stress history at points of the body: punches of all radii, weighted with the spring slopes (15–18).

Each spring sits at its depth G = g(ξ): a state of the contact says for each cell of radii whether it touches
and with which slope dτ/dG its tangential displacement varies. The cells' fields do not depend on the state,
so that they are computed and summed up from the axis once per point. A state is made of few pieces with one
slope: it picks the sums at their ends, which is a product with a sparse matrix.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike
from scipy.sparse import csr_array

from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.stress.field.kernels import DISC, Kernels
from swtstudy.mechanics.stress.field.slope_cells import SlopeCells

#: Points × radii evaluated at a time: the temporaries stay in the processor's cache. A sixteenth or 64 times:
#: 30 % slower.
BLOCK = 16384


def cell_stress(
    x: ArrayLike,
    y: ArrayLike,
    z: ArrayLike,
    cells: SlopeCells,
    poisson_ratio: float,
    kernels: Kernels = DISC,
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
