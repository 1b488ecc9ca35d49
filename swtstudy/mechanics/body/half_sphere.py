"""Means over half spheres about one point of the surface, all from values at the same places.

The places lie around the circle about the axis through the centre: the contact edge and the slip fronts are
such circles, beside which swt grows like the square root of the distance d. So swt is smooth in a root of d,
in the inclination φ, and in the angle θ along the circle, in which it is even. A half sphere cuts an arc out
of each circle; the means over smaller spheres are integrals of the same interpolation.

There are few places on each arc, those of Gauss's rule over the arc of the largest sphere: one, unless the
axis is near. What another one would add, also in smaller spheres, is seen at few distances and inclinations.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from swtstudy.mechanics.points import FloatArray

#: d is this power of the abscissa: roots are smooth, and small spheres have their places.
POWER = 2
#: Distances and inclinations at which the change along the arcs is seen.
SIDE = 4
#: How much of what another place on the arcs adds counts as a change.
ADDED = 0.25
#: Largest radii of the spheres over the centre's distance from the axis up to which so many places, from one
#: on, are enough on half an arc.
REACH = (0.35, 0.8, 1.0)
#: Abscissae of the integrals of the interpolation.
ABSCISSAE = 32


@dataclass(frozen=True)
class HalfSpheres:
    """Places for the means over half spheres about a point at a distance from the axis.

    Attributes
    ----------
    centre
        Distance of the centre from the axis in a_H.
    largest
        Largest radius of a half sphere.
    distances, inclinations
        Number of distances from the circle, and of inclinations.
    """

    centre: float
    largest: float
    distances: int
    inclinations: int

    @property
    def along(self) -> int:
        """Number of places on half an arc."""
        return 1 + sum(self.largest > reach * self.centre for reach in REACH)

    def places(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Radius, depth, and angle about the axis from the centre, each of shape (N,)."""
        side = replace(self, distances=SIDE, inclinations=SIDE)
        both = self.grid(self.along), side.grid(self.along + 1)
        radius, depth, angle = (np.concatenate(parts) for parts in zip(*both, strict=True))
        return radius, depth, angle

    def weights(self, size: FloatArray) -> FloatArray:
        """Weights of the values at the places in the means over radii ``size``, (k,), shape (k, N)."""
        return np.concatenate([self._weights(size, self.along), self._side_weights(size)], axis=1)

    def changes(self, size: FloatArray, values: FloatArray) -> tuple[FloatArray, FloatArray]:
        """How much the means would change without every other distance or inclination, and what is added.

        Parameters
        ----------
        size
            Shape (k,).
        values
            Shape (N,): at the places.

        Returns
        -------
        change, off
            Shape (k,): of the means, and of the values, which does not cancel.
        """
        inner = self.distances * self.inclinations * self.along
        grid = values[:inner].reshape(self.distances, self.inclinations, self.along)
        lacking = (
            grid - np.tensordot(_from_every_other(self.distances), grid[::2], 1),
            grid - np.einsum("ij,kjl->kil", _from_every_other(self.inclinations), grid[:, ::2]),
        )
        weights = self._weights(size, self.along)
        change, off = ADDED * np.abs(self._side_weights(size) @ values[inner:]), np.zeros(len(size))
        for missing in lacking:
            change += np.abs(weights @ missing.ravel())
            off += np.abs(weights) @ np.abs(missing).ravel()
        return change, off

    def _side_weights(self, size: FloatArray) -> FloatArray:
        """Weights of what another place on the arcs adds, shape (k, …)."""
        side = replace(self, distances=SIDE, inclinations=SIDE)
        fewer = side._weights(size, self.along).reshape(-1, self.along)
        fewer = fewer @ _even_polynomials(_along(self.along + 1), _along(self.along))
        return side._weights(size, self.along + 1) - fewer.reshape(len(size), -1)

    def grid(self, along: int) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Radius, depth and angle of places, so many of them on half of each arc."""
        distance = (self.largest * gauss(self.distances)[0] ** POWER)[:, None]
        inclination = self._most(distance) * _inclined(gauss(self.inclinations)[0])
        radius = self._radius(distance, inclination)
        depth = distance * np.sin(inclination)
        angle = self._arc(distance, radius, self.largest)[..., None] * _along(along)
        radius, depth, angle = np.broadcast_arrays(radius[..., None], depth[..., None], angle)
        return radius.ravel(), depth.ravel(), angle.ravel()

    def _weights(self, size: FloatArray, along: int) -> FloatArray:
        """Weights of distances, inclinations and places along the arcs in the means, shape (k, …)."""
        node, weight = gauss(self.inclinations)
        weight = 6.0 * node * (1.0 - node) * weight
        # The arcs end like a root at the pole of a sphere.
        fine, of_fine = gauss(ABSCISSAE)
        root = 1.0 - (1.0 - fine) ** 2
        size = size[:, None, None]
        distance = size * root[:, None] ** POWER
        most = self._most(distance)
        radius = self._radius(distance, most * _inclined(node))
        whole = self._arc(distance, radius, self.largest)
        part = self._arc(distance, radius, size) / whole
        of_fine = (of_fine * (1.0 - fine) * root ** (2 * POWER - 1))[:, None]
        # dV = d dd dφ r dθ, with dd ~ root^(POWER − 1) d root.
        volume = (of_fine * most * weight * radius * whole)[..., None] * _integrals(along, part)
        scaled = (size[..., 0] / self.largest) ** (1.0 / POWER) * root
        of_distance = np.swapaxes(interpolation(gauss(self.distances)[0], scaled), -1, -2)
        found = of_distance @ volume.reshape(*volume.shape[:2], -1)
        return np.asarray(found.reshape(len(size), -1) / found.sum(axis=(1, 2))[:, None])

    def _most(self, distance: FloatArray) -> FloatArray:
        """Largest inclination: π, or that of the axis."""
        return np.arccos(-self.centre / np.maximum(distance, self.centre))

    def _radius(self, distance: FloatArray, inclination: FloatArray) -> FloatArray:
        return np.maximum(self.centre + distance * np.cos(inclination), 0.0)

    def _arc(self, distance: FloatArray, radius: FloatArray, size: float | FloatArray) -> FloatArray:
        """Half of the angle of an arc within a sphere."""
        chord = np.sqrt((size - distance) * (size + distance))
        across = np.maximum(2.0 * np.sqrt(self.centre * radius), 1e-150)
        return 2.0 * np.arcsin(np.minimum(chord / across, 1.0))


@lru_cache(maxsize=16)
def _from_every_other(count: int) -> FloatArray:
    """Matrix from the values at every other node of Gauss's rule to those at all."""
    node, _ = gauss(count)
    return interpolation(node[::2], node)


def _inclined(abscissa: FloatArray) -> FloatArray:
    """Inclinations, over the largest: swt beneath the surface may grow like a root of the depth."""
    return abscissa * abscissa * (3.0 - 2.0 * abscissa)


def _along(count: int) -> FloatArray:
    """Places along half an arc, over its length: those of Gauss's rule for even functions."""
    return np.asarray(2.0 * gauss(2 * count)[0][count:] - 1.0)


def _even_polynomials(node: FloatArray, at: FloatArray) -> FloatArray:
    """Matrix from values at nodes to those of an even polynomial at other places."""
    powers = (np.vander(x * x, len(node), increasing=True) for x in (at, node))
    of_places, of_nodes = powers
    return np.asarray(of_places @ np.linalg.inv(of_nodes))


def _integrals(along: int, part: FloatArray) -> FloatArray:
    """Weights of the places along half an arc in the integral over its first part, shape (…, along)."""
    power = 2 * np.arange(along) + 1
    of_powers = np.linalg.inv(np.vander(_along(along) ** 2, increasing=True))
    return np.asarray((part[..., None] ** power / power) @ of_powers)


@lru_cache(maxsize=16)
def gauss(count: int) -> tuple[FloatArray, FloatArray]:
    """Gauss–Legendre nodes and weights on [0, 1]."""
    node, weight = np.polynomial.legendre.leggauss(count)
    node, weight = 0.5 * (1.0 + node), 0.5 * weight
    node.flags.writeable = weight.flags.writeable = False
    return node, weight


def interpolation(node: FloatArray, at: FloatArray) -> FloatArray:
    """Matrices from values at k nodes to those of their polynomial at other places, all in [0, 1]."""
    series = (np.polynomial.legendre.legvander(2.0 * x - 1.0, len(node) - 1) for x in (at, node))
    of_places, of_nodes = series
    return np.asarray(of_places @ np.linalg.inv(of_nodes))
