"""Designs: points that fill the unit cube, by `scipy.stats.qmc`."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from swtstudy.mechanics.points import FloatArray

#: Sobol sequence, Latin hypercube, independent random points, and the points for Sobol indices.
DesignName = Literal["sobol", "latin_hypercube", "random", "saltelli"]
DESIGNS: tuple[DesignName, ...] = ("sobol", "latin_hypercube", "random", "saltelli")

#: Designs whose size is a power of 2: a Sobol sequence is balanced only there.
BALANCED = ("sobol", "saltelli")


@dataclass(frozen=True)
class Design:
    """A design of points.

    Attributes
    ----------
    name
        One of `DESIGNS`.
    size
        Number of points; for "saltelli" that of its base, of which it has d + 2 variants.
    seed
        Seed of the random numbers.
    """

    name: DesignName
    size: int
    seed: int

    def count(self, dimensions: int) -> int:
        """Number of points."""
        return self.size * (dimensions + 2) if self.name == "saltelli" else self.size

    def attributes(self) -> dict[str, str | int]:
        """Attributes of the samples of an archive."""
        return {"design": self.name, "size": self.size, "seed": self.seed}

    def points(self, dimensions: int) -> FloatArray:
        """The points in the unit cube, shape (n, d)."""
        from scipy.stats import qmc

        if self.name == "random":
            return np.random.default_rng(self.seed).random((self.size, dimensions))
        if self.name == "latin_hypercube":
            return np.asarray(qmc.LatinHypercube(dimensions, seed=self.seed).random(self.size))
        if self.name == "sobol":
            return np.asarray(qmc.Sobol(dimensions, seed=self.seed).random(self.size))
        both = np.asarray(qmc.Sobol(2 * dimensions, seed=self.seed).random(self.size))
        return saltelli(both[:, :dimensions], both[:, dimensions:])


def saltelli(a: FloatArray, b: FloatArray) -> FloatArray:
    """The points for Sobol indices: a, b, and for each parameter a with the values of b for this one.

    Parameters
    ----------
    a, b
        Shape (n, d).

    Returns
    -------
    array
        Shape (n (d + 2), d).

    References
    ----------
    A. Saltelli et al., Computer Physics Communications 181 (2010) 259-270.
    """
    d = a.shape[1]
    mixed = np.where(np.eye(d, dtype=bool)[:, None, :], b, a)
    return np.concatenate([a, b, mixed.reshape(-1, d)])
