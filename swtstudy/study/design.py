"""Designs, points that fill the unit cube, by `scipy.stats.qmc`, and distributions: values of them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal, get_args

import numpy as np

from swtstudy.points.values import as_number, read_angle, read_exact, read_value
from swtstudy.vocabulary.arrays import FloatArray
from swtstudy.vocabulary.mistakes import Report, literal, nearest
from swtstudy.vocabulary.parameter import Parameter

#: Sobol sequence, Latin hypercube, independent random points, and the points for Sobol indices.
DesignName = Literal["sobol", "latin_hypercube", "random", "saltelli"]
DESIGNS: tuple[DesignName, ...] = get_args(DesignName)

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


#: What each distribution is given by, beside its bounds; the bounds of the last ones may be left out.
DISTRIBUTIONS: dict[str, tuple[str, ...]] = {
    "uniform": (),
    "triangular": ("mode",),
    "normal": ("mean", "deviation"),
    "lognormal": ("median", "deviation"),
}
_UNBOUNDED = ("normal", "lognormal")
#: That of a logarithm: ten times as much or a tenth are as near to the median.
_LARGEST_DEVIATION = 2.3
#: A distribution of which the bounds leave less than this is not meant so.
_LEAST_SHARE = 1e-6

ALLOWED_RANGE = (
    'both ends, [low, high], or a table such as {distribution = "normal", mean = …, deviation = …}'
)


@dataclass(frozen=True)
class Distribution:
    """The distribution of one parameter, cut off at its bounds.

    Attributes
    ----------
    kind
        One of `DISTRIBUTIONS`; the deviation of "lognormal" is that of the natural logarithm.
    given
        What it is given by.
    low, high
        Bounds.
    """

    kind: str
    given: dict[str, float]
    low: float
    high: float

    def values(self, unit: FloatArray) -> FloatArray:
        """The values at points of the unit interval."""
        if self.kind == "uniform":
            return self.low * (1.0 - unit) + self.high * unit
        whole = self._whole()
        below, above = whole.cdf(self.low), whole.cdf(self.high)
        return np.clip(whole.ppf(below + unit * (above - below)), self.low, self.high)

    def share(self) -> float:
        """The share of the distribution that is within the bounds."""
        if self.kind == "uniform":
            return 1.0
        whole = self._whole()
        return float(whole.cdf(self.high) - whole.cdf(self.low))

    def _whole(self) -> Any:
        """The distribution without bounds, of scipy's."""
        from scipy import stats

        if self.kind == "triangular":
            width = self.high - self.low
            return stats.triang((self.given["mode"] - self.low) / width, self.low, width)
        if self.kind == "normal":
            return stats.norm(self.given["mean"], self.given["deviation"])
        return stats.lognorm(self.given["deviation"], scale=self.given["median"])


def read_distribution(parameter: Parameter, raw: object, key: str, report: Report) -> Distribution | None:
    """The distribution of a parameter that a user wrote; None if there are mistakes, which are reported."""
    if isinstance(raw, list) and len(raw) == 2:
        raw = {"distribution": "uniform", "low": raw[0], "high": raw[1]}
    if not isinstance(raw, Mapping):
        report(key, literal(raw), ALLOWED_RANGE)
        return None
    kind = raw.get("distribution")
    if not isinstance(kind, str) or kind not in DISTRIBUTIONS:
        found = literal(kind) if "distribution" in raw else "nothing"
        report(f"{key}.distribution", found, nearest(str(kind or ""), DISTRIBUTIONS))
        return None
    bounds = {} if kind not in _UNBOUNDED else {"low": parameter.lower, "high": parameter.upper}
    known = ("distribution", "low", "high", *DISTRIBUTIONS[kind])
    numbers: dict[str, float] = {}
    sound = True
    for name in (each for each in raw if each not in known):
        report(f"{key}.{name}", f"unknown key {literal(name)}", nearest(str(name), known))
        sound = False
    for name in known[1:]:
        number = _number(parameter, name, raw.get(name, bounds.get(name)), f"{key}.{name}", report)
        sound = sound and number is not None
        numbers[name] = number or 0.0
    if not sound:
        return None
    low, high = numbers.pop("low"), numbers.pop("high")
    return _checked(Distribution(kind, numbers, low, high), key, report)


def _number(parameter: Parameter, name: str, raw: object, key: str, report: Report) -> float | None:
    """A number of a distribution: a bound is a value of the parameter, a deviation is positive."""
    bound = name in ("low", "high")
    try:
        if raw is None:
            raise ValueError("nothing")
        if bound and raw == parameter.lower:
            return parameter.lower  # an open end is a bound, although it is no value
        read = read_angle if parameter.units == "rad" else read_exact
        return as_number(read_value(parameter, raw)) if bound else float(read(raw))
    except ValueError as error:
        found = "nothing" if raw is None else f"{literal(raw)} ({error})"
        report(key, found, parameter.allowed if bound else "a number")
        return None


def _checked(given: Distribution, key: str, report: Report) -> Distribution | None:
    """The distribution, if its numbers go together."""
    found = f"{given.low:g} and {given.high:g}"
    if not given.low < given.high:
        report(key, f"the bounds {found}", "the lower bound first, and a higher one")
        return None
    if given.kind == "lognormal" and given.given["deviation"] > _LARGEST_DEVIATION:
        found = f"{given.given['deviation']:g}, as a factor {math.exp(given.given['deviation']):.3g}"
        allowed = f"that of the natural logarithm, at most {_LARGEST_DEVIATION:g}: about the relative one"
        report(f"{key}.deviation", found, allowed)
        return None
    for name in ("deviation", "median"):
        if given.given.get(name, 1.0) <= 0.0:
            report(f"{key}.{name}", f"{given.given[name]:g}", "a number greater than 0")
            return None
    mode = given.given.get("mode", given.low)
    if not given.low <= mode <= given.high:
        report(f"{key}.mode", f"{mode:g}", f"a number in [{given.low:g}, {given.high:g}]")
        return None
    if given.share() < _LEAST_SHARE:
        report(key, f"the bounds {found}, which hold none of the distribution", "bounds that hold some of it")
        return None
    return given
