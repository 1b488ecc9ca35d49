"""Lateral tractions in Cattaneo and Mindlin's contact: how much of s does a model without them miss?

The surface of a loaded half-space also moves across the load, so slip is not parallel to the traction that
Cattaneo and Mindlin assume. Here both components of the traction follow from Coulomb's law on a grid of
square cells. The displacements by a constant traction in a cell are Cerruti's integrals. Under a load
that grows once, the traction minimises the elastic energy less the work of the load, within |q| ≤ μp.

Lengths are over the contact radius, stresses over the largest pressure p0. With G = 1/π the relative
displacement of both bodies is u_x = ∫ [(1 - ν)/r + ν x²/r³] q_x + ν xy/r³ q_y, and u_y likewise. Run from the
project's folder: ``python studies/lateral_slip.py > results/lateral_slip.txt``.
"""

from __future__ import annotations

import argparse
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.fft import irfft2, rfft2

Array = NDArray[np.float64]
#: Cells to the radius, and steps of the minimisation.
CELLS, STEPS = 48, 1500
#: Poisson's ratios, and tangential loads over the one of full slip.
POISSON, LOADS = (0.1, 0.3, 0.5), (0.25, 0.5, 0.75, 0.95)
#: Coefficients of friction of which s is told.
FRICTION = (0.3, 1.0)


@dataclass
class HalfSpace:
    """Displacements of the surface by tractions on a square grid of cells.

    Attributes
    ----------
    x, y
        Shape (m, m): centres of the cells, over the contact radius.
    kernels
        Shape (3, 2m, m + 1): transforms of u_x by q_x, of u_y by q_y, and of either by the other.
    """

    x: Array
    y: Array
    kernels: NDArray[np.complex128]

    def displacements(self, traction: Array) -> Array:
        """u_x and u_y by tractions q_x and q_y, each of shape (2, m, m)."""
        m = len(self.x)
        of_x, of_y = (rfft2(each, (2 * m, 2 * m)) for each in traction)
        along, across, coupled = self.kernels
        u = along * of_x + coupled * of_y, coupled * of_x + across * of_y
        return np.array([irfft2(each, (2 * m, 2 * m))[:m, :m] for each in u])


def half_space(ν: float, cells: int) -> HalfSpace:
    """A half-space whose grid reaches a sixth of the radius beyond the contact."""
    h, n = 1.0 / cells, cells + cells // 6
    centre = h * (np.arange(-n, n) + 0.5)
    m = len(centre)
    apart = h * np.fft.fftfreq(2 * m, 1.0 / (2 * m))
    X, Y = np.meshgrid(apart, apart, indexing="ij")

    def over_cell(primitive):  # type: ignore[no-untyped-def]
        a, b, c, d = X - 0.5 * h, X + 0.5 * h, Y - 0.5 * h, Y + 0.5 * h
        return primitive(b, d) - primitive(a, d) - primitive(b, c) + primitive(a, c)

    of_x = over_cell(lambda x, y: y * np.arcsinh(x / np.abs(y)))  # x²/r³, but for what cancels
    of_y = over_cell(lambda x, y: x * np.arcsinh(y / np.abs(x)))
    coupled = over_cell(lambda x, y: -np.hypot(x, y))
    both = np.array([of_x + (1.0 - ν) * of_y, (1.0 - ν) * of_x + of_y, ν * coupled])
    x, y = np.meshgrid(centre, centre, indexing="ij")
    return HalfSpace(x, y, rfft2(both))


def traction_under(body: HalfSpace, shift: float, lateral: bool) -> tuple[Array, Array]:
    """Traction over μ p0 under a relative displacement over μ, and the slip, each of shape (2, m, m).

    Parameters
    ----------
    body
        The half-space.
    shift
        Relative displacement of the bodies along x.
    lateral
        Whether there are tractions across the load.
    """
    bound = np.sqrt(np.maximum(1.0 - body.x**2 - body.y**2, 0.0))
    step = 0.9 / float(np.abs(body.kernels).sum(axis=0).max())
    q = before = np.zeros((2, *bound.shape))
    momentum, pull = 1.0, np.array([shift, 0.0])[:, None, None]
    for _ in range(STEPS):  # Nesterov's projected gradient
        following = 0.5 * (1.0 + np.sqrt(1.0 + 4.0 * momentum**2))
        ahead = q + (momentum - 1.0) / following * (q - before)
        before, momentum = q, following
        q = ahead + step * (pull - body.displacements(ahead))
        if not lateral:
            q[1] = 0.0
        q = q * np.minimum(1.0, bound / np.maximum(np.hypot(*q), 1e-300))
    return q, pull - body.displacements(q)


def stress_at_edge(body: HalfSpace, ν: float, traction: Array) -> tuple[float, float]:
    """σ_xx and E ε_xx on the line y = 0 at the edge of the contact, over μ p0.

    From the strains of the surface one cell outside of the contact, by differences of the displacements.
    """
    h, m = body.x[1, 0] - body.x[0, 0], len(body.x)
    u, i, beside_line = (
        body.displacements(traction),
        int(np.searchsorted(body.x[:, 0], 1.0)),
        [m // 2 - 1, m // 2],
    )
    along = np.gradient(u[0], h, axis=0)[i, beside_line].mean()
    across = np.gradient(u[1], h, axis=1)[i, beside_line].mean()
    # Displacements of one body are half of the relative ones; 2G = 2/π.
    return float((along + ν * across) / (np.pi * (1.0 - ν))), float((1.0 + ν) * along / np.pi)


def misalignment(body: HalfSpace, traction: Array, slip: Array) -> float:
    """Largest angle between slip and traction in degrees, where the slip is at least 0.1 of the largest."""
    slips = np.hypot(*slip) > 0.1 * np.hypot(*slip)[np.hypot(*traction) > 0.0].max()
    slips &= np.hypot(*traction) > 0.0
    cross = traction[0] * slip[1] - traction[1] * slip[0]
    along = traction[0] * slip[0] + traction[1] * slip[1]
    return float(np.degrees(np.abs(np.arctan2(cross, along))[slips].max()))


def row(ν: float, load: float, cells: int) -> str:
    """Slip, lateral tractions and the change of s at one load, as a line of the table."""
    body = half_space(ν, cells)
    bound = np.sqrt(np.maximum(1.0 - body.x**2 - body.y**2, 0.0)).sum()

    def shift_of(load: float) -> float:
        """Mindlin's relative displacement under a load over the one of full slip."""
        return float(np.pi**2 / 4.0 * (2.0 - ν) * (1.0 - (1.0 - load) ** (2.0 / 3.0)))

    lateral = traction_under(body, shift_of(load), lateral=True)[0]
    along, slip = traction_under(body, shift_of(float(lateral[0].sum() / bound)), lateral=False)
    (tension, strain), (before, strain_before) = (stress_at_edge(body, ν, each) for each in (lateral, along))
    changes = []
    for μ in FRICTION:
        pressed = (1.0 - 2.0 * ν) / (3.0 * μ)  # σ_xx of the pressure at the edge, over μ p0
        changes.append((pressed + tension) * strain / ((pressed + before) * strain_before) - 1.0)
    cells_of_table = [
        f"{ν:g}",
        f"{load:g}",
        f"{misalignment(body, along, slip):.1f}",
        f"{np.abs(lateral[1]).max():.4f}",
        *(f"{100.0 * change:+.2f}" for change in changes),
    ]
    return "".join(f"{cell:>10}" for cell in cells_of_table)


def main() -> None:
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--cells", type=int, default=CELLS, help="cells to the contact radius")
    arguments.add_argument("--quick", action="store_true", help="few loads and cells, to see that it runs")
    given = arguments.parse_args()
    poisson, loads, cells = ((0.3,), (0.5,), 12) if given.quick else (POISSON, LOADS, given.cells)
    print(
        f"Sphere under a constant normal force, {cells} cells to the contact radius. Angle: between slip and"
    )
    print(
        "traction without lateral tractions. Lateral: the largest lateral traction over μ p0. s: the change"
    )
    print("of s by lateral tractions in per cent, at two coefficients of friction.")
    print()
    titles = ("ν", "Q/μP", "angle, °", "lateral", *(f"s, μ={μ:g}" for μ in FRICTION))
    print("".join(f"{title:>10}" for title in titles))
    for ν in poisson:
        for load in loads:
            print(row(ν, load, cells), flush=True)


if __name__ == "__main__":
    main()
