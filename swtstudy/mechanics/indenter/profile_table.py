"""A table of a profile f(r), and what is made of it once."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike

from swtstudy.mechanics.indenter.plane import MEAN_LOAD
from swtstudy.mechanics.indenter.slope_fit import SlopePieces, exact_load_slope, exact_slope, resolved, spline
from swtstudy.mechanics.points import FloatArray, IndexArray
from swtstudy.vocabulary.choices import AXISYMMETRIC, GEOMETRIES, PLANE
from swtstudy.vocabulary.definition import Definition, read_numbers, wrong_name
from swtstudy.vocabulary.mistakes import Mistake, StudyError, literal, plain_number

if TYPE_CHECKING:
    from scipy.interpolate import PPoly

#: How small and large a table may be, in any unit: the seventh power of that is a number still.
SMALLEST, LARGEST = 1e-20, 1e20
#: Most points of a table: a rough one of so many takes 20 s to be fitted, a smooth one 1 s.
MOST = 10_000
#: Least step of its radii over the largest: the rounding of such a step is 1e-4 of it.
LEAST_STEP = 1e-12
#: Fewest points of a table, and relative slope −g′ that is rounding or fit.
FEWEST, NEGATIVE = 8, 1e-6
#: Radii at which compactness is looked at, and of the first guess of the contact radius.
RADII = 4001
#: Radii of that at a force: Newton's method takes one step from there.
RADII_BY_LOAD = 20_001
#: A piece shorter than this share of the contact is a landmark of the search, of which there are so many.
SHORT_PIECE, MOST_LANDMARKS = 1.0 / 24.0, 32


class TabulatedProfile(Definition):
    """A measured or computed profile: heights f above its lowest point, at the axis.

    Parameters
    ----------
    name
        Its name on axes, in archives and in figures.
    radius, height
        Shape (k,), 8 to 10,000 points, the first one 0 and 0, the radii ascending: r in a length a_H and f
        in a depth δ0, the mean one of a study; in `swtstudy.physical` both in the unit of its lengths.
        Heights of 0 at the begin are a flat face.
    smoothing
        Root mean square of what the fit may miss of the heights, in their unit, if they are noisy. Nothing is
        smoothed unless asked: a spline goes through all points.
    geometry
        "axisymmetric", or "plane" for a long body of this section, symmetric about x = 0: then radii are
        distances x from its middle, and δ0 is 4 P_0/(π E*), P_0 the mean load per length.

    Raises
    ------
    StudyError
        A ValueError with every mistake, and the radius of it.

    Notes
    -----
    Two profiles are the same if their contents are; their names do not matter.
    """

    parameter: ClassVar[str] = "profile"

    def __init__(
        self,
        name: str,
        radius: ArrayLike,
        height: ArrayLike,
        smoothing: float = 0.0,
        geometry: str = AXISYMMETRIC,
    ) -> None:
        self.name, self.geometry = name, geometry
        self.radius, self.height = (_frozen(values) for values in (radius, height))
        mistakes = list(_mistakes(name, self.radius, self.height, smoothing))
        mistakes += _wrong_geometry(name, geometry)
        if mistakes:
            raise StudyError(mistakes)
        self.smoothing = float(smoothing)

    @property
    def plane(self) -> bool:
        """True if it is a profile of a plane contact."""
        return self.geometry == PLANE

    def __repr__(self) -> str:
        return f"TabulatedProfile({self.name!r}, {self.radius.size} points up to {self.radius[-1]:g})"

    def content(self) -> dict[str, Any]:
        content = {
            "radius": self.radius.tolist(),
            "height": self.height.tolist(),
            "smoothing": self.smoothing,
        }
        return content | {"geometry": PLANE} if self.plane else content

    @classmethod
    def of_content(cls, name: str, content: Mapping[str, Any]) -> TabulatedProfile:
        own = content["radius"], content["height"], content["smoothing"]
        return cls(name, *own, content.get("geometry", AXISYMMETRIC))

    def notes(self) -> dict[str, Any]:
        return {"deviation": self.deviation}

    def scaled(self, length: float, depth: float) -> TabulatedProfile:
        """The same profile in other units: radii in ``length``, heights in ``depth``."""
        scaled = self.radius / length, self.height / depth, self.smoothing / depth
        return TabulatedProfile(self.name, *scaled, self.geometry)

    @cached_property
    def fit(self) -> PPoly:
        """The spline f, from the edge of the face."""
        return spline(self.radius, self.height, self.smoothing)

    @cached_property
    def pieces(self) -> SlopePieces:
        """g′ by pieces, or N′ in the plane."""
        coarse = spline(_every_other(self.radius), _every_other(self.height), self.smoothing)
        slope_of = exact_load_slope if self.plane else exact_slope
        return SlopePieces.of(self.fit, resolved(self.fit, coarse, slope_of), slope_of)

    @property
    def deviation(self) -> float:
        """The largest distance of the fit from the heights."""
        on_curve = self.radius >= self.fit.x[0]
        missed = np.where(on_curve, self.fit(self.radius), 0.0) - self.height
        return float(np.abs(missed).max())

    @cached_property
    def guesses(self) -> tuple[FloatArray, FloatArray]:
        """√g, nearly straight, and w = √(ξ² − b²), each of shape (k,)."""
        end = self.pieces.start[-1]
        w = np.linspace(0.0, 2.0 * end, RADII)
        depth = self.pieces.value(self.pieces.depth, w, self.pieces.piece(w))
        return np.sqrt(np.maximum.accumulate(np.maximum(depth, 0.0))), w

    @cached_property
    def guesses_by_load(self) -> tuple[FloatArray, FloatArray]:
        """The cubic root of half of the normal force, nearly straight, and w, each of shape (k,)."""
        w = np.linspace(0.0, 2.0 * self.pieces.start[-1], RADII_BY_LOAD)
        half_load = self.pieces.value(self.pieces.half_load, w, self.pieces.piece(w))
        return np.cbrt(np.maximum.accumulate(np.maximum(half_load, 0.0))), w

    @cached_property
    def landmarks(self) -> FloatArray:
        """Radii, shape (k,), where g′ turns within a small part of the contact."""
        start = self.pieces.start
        short = start[:-1][np.diff(start) < SHORT_PIECE * start[-1]]
        return np.hypot(short[:: max(-(-short.size // MOST_LANDMARKS), 1)], self.pieces.flat_radius)

    @cached_property
    def deepest(self) -> float:
        """The depth, or N/N_0, up to which there is a full disc or strip of contact within the table."""
        falls, g = self._falls, self._sampled[2]
        return float(g[falls[0]] if falls.size else g[-1]) / (MEAN_LOAD if self.plane else 1.0)

    def refused_at(self, depth: float) -> str | None:
        """Why there is no full disc of contact up to a depth, and the radius of it; or None.

        In the plane no full strip up to a line load over the mean one.
        """
        if depth <= self.deepest:
            return None
        disc, at, slope, place = "disc", "depth", "g′", "radius"
        if self.plane:
            disc, at, slope, place = "strip", "load 4P/(πE*) =", "N′", "half-width"
        radius, falls = self._sampled[0], self._falls
        if falls.size:
            return (
                f"{self.name} has no full {disc} of contact at the {at} {depth:g}: {slope} < 0 at the "
                f"{place} {radius[falls[0]]:.4g}; {self._advice}"
            )
        return (
            f"the {at} {depth:g} is beyond the table of {self.name}, which ends at the {place} "
            f"{radius[-1]:.4g}: the contact is as large as that at the {at} {self.deepest:.4g}"
        )

    @property
    def _advice(self) -> str:
        """Advice for a table whose g falls."""
        if self.smoothing == 0.0:
            return "if its heights are noisy, ask for smoothing"
        return f"its smoothing is {self.smoothing:g}: more takes noise away, less leaves its shape as it is"

    @cached_property
    def _sampled(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Radii up to the table's end, g′ and g there."""
        pieces = self.pieces
        w = np.linspace(0.0, pieces.start[-1], RADII)
        place = pieces.piece(w)
        slope, depth = (pieces.value(c, w, place) for c in (pieces.slope, pieces.depth))
        return np.hypot(w, pieces.flat_radius), slope, depth

    @property
    def _falls(self) -> IndexArray:
        """Where of these radii g falls."""
        slope = self._sampled[1]
        return np.flatnonzero(slope < -NEGATIVE * np.abs(slope).max())


#: The name of a family, or a table.
AnyProfile = str | TabulatedProfile


def _wrong_geometry(name: object, geometry: object) -> Iterator[Mistake]:
    if geometry not in GEOMETRIES:
        yield Mistake(f"{name}.geometry", literal(geometry), f"one of {', '.join(GEOMETRIES)}")


def _frozen(values: ArrayLike) -> FloatArray:
    """A copy that cannot be changed, empty if it is not of numbers."""
    try:
        array = np.array(read_numbers("", values, ""))
    except StudyError:
        array = np.empty((0, 0))
    array.flags.writeable = False
    return array


def _every_other(values: FloatArray) -> FloatArray:
    return np.append(values[:-1:2], values[-1])


def _mistakes(name: object, radius: FloatArray, height: FloatArray, smoothing: object) -> Iterator[Mistake]:
    """Return the mistakes in a table."""
    if mistake := wrong_name(name, "profile"):
        yield mistake
        name = "profile"
    for key, values in (("radius", radius), ("height", height)):
        if values.ndim != 1 or not np.all(np.isfinite(values)):
            yield Mistake(f"{name}.{key}", "no one-dimensional array of finite numbers", "one")
            return
        largest = np.abs(values).max(initial=0.0)
        if largest > 0.0 and not SMALLEST <= largest <= LARGEST:
            allowed = f"in magnitude from {SMALLEST:g} to {LARGEST:g}"
            yield Mistake(f"{name}.{key}", f"up to {largest:g}", allowed)
            return
    if radius.size != height.size or radius.size < FEWEST:
        found = f"{radius.size} radii and {height.size} heights"
        yield Mistake(f"{name}.radius, {name}.height", found, f"as many of each, at least {FEWEST}")
        return
    if radius.size > MOST:
        allowed = f"at most {MOST}: every {-(-radius.size // MOST)}th, or the mean of so many"
        yield Mistake(f"{name}.radius, {name}.height", f"{radius.size} points", allowed)
        return
    if radius[0] != 0.0 or height[0] != 0.0:
        found = f"a first point at the radius {radius[0]:g} with the height {height[0]:g}"
        yield Mistake(f"{name}.radius, {name}.height", found, "0 and 0: the axis, and heights above it")
    falls = np.flatnonzero(np.diff(radius) < LEAST_STEP * radius.max())
    if falls.size:
        found = f"{radius[falls[0] + 1]:g} after {radius[falls[0]]:g}"
        allowed = f"ascending radii, by {LEAST_STEP:g} of the largest at least"
        yield Mistake(f"{name}.radius", found, allowed)
    if np.any(height < 0.0) and not np.any(height > 0.0):
        yield Mistake(f"{name}.height", "heights that fall from the axis", "heights with the other sign")
    elif not np.any(height > 0.0) or np.count_nonzero(height) < FEWEST - 2:
        yield Mistake(f"{name}.height", "a flat face alone", f"at least {FEWEST - 2} points beside it")
    beside = np.flatnonzero(height)[:2]
    if beside.size and beside[0] > 1 and (height[beside] < 0.0).any():
        k = beside[height[beside] < 0.0][0]
        found = f"{height[k]:g} at the radius {radius[k]:g}, below the flat face"
        yield Mistake(f"{name}.height", found, "heights above the face: it is the lowest part of a profile")
    if not 0.0 <= plain_number(smoothing) < np.inf:
        yield Mistake(f"{name}.smoothing", literal(smoothing), "a number ≥ 0")
