"""Means over half spheres or discs about one point of the surface, all from values at the same places.

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
from typing import Any

import numpy as np

from swtstudy.vocabulary.arrays import FloatArray

#: Distances and inclinations at which the change along the arcs is seen.
SIDE = 4
#: Largest radii of the spheres over the centre's distance from the axis up to which so many places, from one
#: on, are enough on half an arc.
REACH = (0.35, 0.8, 1.0)
#: Abscissae of the integrals of an interpolation, at least, and over the number of its nodes.
ABSCISSAE, FINER = 32, 2


@dataclass(frozen=True)
class HalfSpheres:
    """Places for the means over half spheres about a point at a distance from the axis.

    Attributes
    ----------
    centre
        Distance of the centre from the axis in a_H.
    largest
        Largest radius of a half sphere.
    power
        Distances are this power of the abscissa: large ones leave more places to small spheres.
    distances, inclinations
        Number of distances from the circle, and of inclinations.
    """

    centre: float
    largest: float
    power: float
    distances: int
    inclinations: int

    @property
    def along(self) -> int:
        """Number of places on half an arc."""
        return 1 + sum(self.largest > reach * self.centre for reach in REACH)

    @property
    def shape(self) -> tuple[int, int, int]:
        """Number of distances, of inclinations, and of places on half an arc."""
        return self.distances, self.inclinations, self.along

    def finer(self, axis: int) -> HalfSpheres:
        """With a place more beside each of the distances (axis 0) or inclinations (1); these stay."""
        if axis == 0:
            return replace(self, distances=2 * self.distances + 1)
        return replace(self, inclinations=2 * self.inclinations + 1)

    def side_places(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Radius, depth and angle of the places that show the change along the arcs."""
        return self._side.grid(self.along + 1)

    def weights(self, size: FloatArray) -> FloatArray:
        """Weights of the values at the grid's places in the means over radii ``size``, (k,), shape (k, N)."""
        return self._weights(size, self.along)

    def side_weights(self, size: FloatArray) -> FloatArray:
        """Weights at the side places of what another place on the arcs adds to the means, shape (k, …)."""
        fewer = self._side._weights(size, self.along).reshape(-1, self.along)
        fewer = fewer @ _even_polynomials(_along(self.along + 1), _along(self.along))
        return self._side._weights(size, self.along + 1) - fewer.reshape(len(size), -1)

    def changes(self, weights: FloatArray, values: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Estimate how the means would change without every other distance or inclination.

        Parameters
        ----------
        weights, values
            Shape (k, N) and (N,): of and at the grid's places.

        Returns
        -------
        change, off
            Shape (2, k), without distances and without inclinations: of the means, and of the values, which
            does not cancel.
        """
        grid = values.reshape(self.shape)
        lacking = (
            grid - np.tensordot(from_every_other(self.distances), grid[1::2], 1),
            grid - np.einsum("ij,kjl->kil", from_every_other(self.inclinations), grid[:, 1::2]),
        )
        change = [np.abs(weights @ missing.ravel()) for missing in lacking]
        off = [np.abs(weights) @ np.abs(missing).ravel() for missing in lacking]
        return np.stack(change), np.stack(off)

    @property
    def _side(self) -> HalfSpheres:
        return replace(self, distances=SIDE, inclinations=SIDE)

    def grid(self, along: int | None = None) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Radius, depth and angle about the axis of places, (N,), so many on half of each arc."""
        distance = (self.largest * nested(self.distances) ** self.power)[:, None]
        inclination = self._most(distance) * _inclined(nested(self.inclinations))
        radius = self._radius(distance, inclination)
        depth = distance * np.sin(inclination)
        angle = self._arc(distance, radius, self.largest)[..., None] * _along(along or self.along)
        radius, depth, angle = np.broadcast_arrays(radius[..., None], depth[..., None], angle)
        return radius.ravel(), depth.ravel(), angle.ravel()

    def _weights(self, size: FloatArray, along: int) -> FloatArray:
        """Weights of distances, inclinations and places along the arcs in the means, shape (k, …)."""
        node, weight = gauss(_abscissae(self.inclinations))
        weight = 6.0 * node * (1.0 - node) * weight
        # The arcs end like a root at the pole of a sphere.
        fine, of_fine = gauss(_abscissae(self.distances))
        root = 1.0 - (1.0 - fine) ** 2
        size = size[:, None, None]
        distance = size * root[:, None] ** self.power
        most = self._most(distance)
        radius = self._radius(distance, most * _inclined(node))
        whole = self._arc(distance, radius, self.largest)
        part = self._arc(distance, radius, size) / whole
        of_fine = (of_fine * (1.0 - fine) * root ** (2.0 * self.power - 1.0))[:, None]
        # dV = d dd dφ r dθ, with dd ~ root^(power − 1) d root.
        volume = (of_fine * most * weight * radius * whole)[..., None] * _integrals(along, part)
        scaled = (size[..., 0] / self.largest) ** (1.0 / self.power) * root
        of_distance = np.swapaxes(interpolation(self.distances, scaled), -1, -2)
        of_inclination = interpolation(self.inclinations, node).T
        found = of_distance @ volume.reshape(*volume.shape[:2], -1)
        found = of_inclination @ found.reshape(len(size), self.distances, -1, along)
        return np.asarray(found.reshape(len(size), -1) / found.sum(axis=(1, 2, 3))[:, None])

    def _most(self, distance: FloatArray) -> FloatArray:
        """Largest inclination: π, or that of the axis."""
        return np.arccos(-self.centre / np.maximum(distance, self.centre))

    def _radius(self, distance: FloatArray, inclination: FloatArray) -> FloatArray:
        return np.maximum(self.centre + distance * np.cos(inclination), 0.0)

    def _arc(self, distance: FloatArray, radius: FloatArray, size: Any) -> FloatArray:
        """Half of the angle of an arc within a sphere."""
        chord = np.sqrt((size - distance) * (size + distance))
        across = np.maximum(2.0 * np.sqrt(self.centre * radius), 1e-150)
        return 2.0 * np.arcsin(np.minimum(chord / across, 1.0))


class HalfDiscs(HalfSpheres):
    """Places for the means over half discs about a point of a plane contact, in its section.

    ``centre`` is then the distance of the point from the middle of the contact. There are no arcs.
    """

    @property
    def along(self) -> int:
        return 1

    def side_places(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        return (np.empty(0),) * 3

    def grid(self, along: int | None = None) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Distance from the middle, depth and angle, which is 0 or beyond the middle π, of places, (N,)."""
        distance = (self.largest * nested(self.distances) ** self.power)[:, None]
        inclination = np.pi * _inclined(nested(self.inclinations))
        x, depth = self.centre + distance * np.cos(inclination), distance * np.sin(inclination)
        return np.abs(x).ravel(), depth.ravel(), np.where(x < 0.0, np.pi, 0.0).ravel()

    def _weights(self, size: FloatArray, along: int) -> FloatArray:
        node, weight = gauss(_abscissae(self.inclinations))
        of_inclination = (node * (1.0 - node) * weight) @ interpolation(self.inclinations, node)
        root, weight = gauss(_abscissae(self.distances))
        weight = weight * root ** (2.0 * self.power - 1.0)
        scaled = (size[:, None] / self.largest) ** (1.0 / self.power) * root
        found = (weight @ interpolation(self.distances, scaled))[..., None] * of_inclination
        return np.asarray(found.reshape(len(size), -1) / found.sum(axis=(1, 2))[:, None])


@lru_cache(maxsize=16)
def from_every_other(count: int) -> FloatArray:
    """Matrix from the values at every other node to those at all."""
    return interpolation(count // 2, nested(count))


def _abscissae(count: int) -> int:
    return max(ABSCISSAE, FINER * count)


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


@lru_cache(maxsize=16)
def nested(count: int) -> FloatArray:
    """Nodes of Fejér's rule in (0, 1), denser towards both ends: as good as Gauss's where swt has kinks.

    Every other one of 2 n + 1 nodes, from the second on, is one of n.
    """
    node = np.asarray(0.5 - 0.5 * np.cos(np.pi * np.arange(1, count + 1) / (count + 1)))
    node.flags.writeable = False
    return node


def interpolation(count: int, at: FloatArray) -> FloatArray:
    """Matrices from values at ``count`` nested nodes to those of their polynomial elsewhere in [0, 1]."""
    series = np.polynomial.legendre.legvander(2.0 * at - 1.0, count - 1)
    return np.asarray(series @ _to_series(count))


@lru_cache(maxsize=16)
def _to_series(count: int) -> FloatArray:
    """Matrix from values at nested nodes to the coefficients of their Legendre series."""
    of_nodes = np.polynomial.legendre.legvander(2.0 * nested(count) - 1.0, count - 1)
    return np.asarray(np.linalg.inv(of_nodes), dtype=np.float64)
