"""A table of a profile f(r), and its fit, which is computed once."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike

from swtstudy.vocabulary.arrays import FloatArray
from swtstudy.vocabulary.choices import AXISYMMETRIC, GEOMETRIES, PLANE
from swtstudy.vocabulary.definition import Definition, read_numbers, wrong_name
from swtstudy.vocabulary.families import MEAN_LOAD
from swtstudy.vocabulary.mistakes import Mistake, StudyError, literal, more_like_it, plain_number, refused

if TYPE_CHECKING:
    from scipy.interpolate import CubicSpline, PPoly

#: How small and large a table may be, in any unit: the seventh power of that is a number still.
SMALLEST, LARGEST = 1e-20, 1e20
#: Most points of a table: a rough one of so many takes 20 s to be fitted, a smooth one 1 s.
MOST = 10_000
#: Points of a table from a function.
SAMPLES = 1001
#: Least step of its radii over the largest: the rounding of such a step is 1e-4 of it.
LEAST_STEP = 1e-12
#: Fewest points of a table, and relative slope −g′ that is rounding or fit.
FEWEST, NEGATIVE = 8, 1e-6
#: Radii at which compactness is looked at, and between which the slope is interpolated.
RADII = 4001
#: Multiple of the noise up to which it is smoothed: more would be the shape.
MOST_SMOOTHED = 32.0
#: Share of the rise of heights within the contact above which the smoothing is told: s of rounded punches is
#: off by some 5 % there at most (studies/table_convergence.py).
ROUGH = 0.01
#: Numbers that are worked on at once.
_SLAB = 2_000_000


class TabulatedProfile(Definition):
    """A measured or computed profile: heights f above its lowest point, at the axis.

    Parameters
    ----------
    name
        Its name on axes, in archives and in figures.
    radius, height
        Shape (k,), 8 to 10,000 points from 0 and 0 on, the radii ascending: r in a length a_H and f
        in δ0, the mean depth of a study; in `swtstudy.physical` both in the unit of its lengths.
        Leading zero heights form a flat face.
    smoothing
        Root-mean-square misfit that is allowed for noisy heights, in their unit, before the fit is shifted
        to rise from 0. Nothing is smoothed unless asked: a spline goes through all points.
    geometry
        "axisymmetric", or "plane" for a long body of this section, symmetric about x = 0: then radii are
        distances x from its middle, and δ0 is 4 P_0/(π E*), P_0 the mean load per length.

    Raises
    ------
    StudyError
        A ValueError with every mistake and its radius.

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
        if geometry not in GEOMETRIES:
            mistakes.append(Mistake(f"{name}.geometry", literal(geometry), f"one of {', '.join(GEOMETRIES)}"))
        if mistakes:
            raise StudyError(mistakes)
        self.smoothing = float(smoothing)

    @classmethod
    def sampled(
        cls, name: str, height: Callable[[FloatArray], ArrayLike], radius: float, geometry: str = AXISYMMETRIC
    ) -> TabulatedProfile:
        """A profile from a function, by its values at 1,001 even radii.

        Parameters
        ----------
        name
            Its name.
        height
            From radii, shape (k,), to the heights there, 0 at the axis.
        radius
            End of the table: a radius beyond all contacts.
        geometry
            As of the class.

        Raises
        ------
        StudyError
            A ValueError with every mistake.

        Examples
        --------
        >>> import swtstudy
        >>> sphere = swtstudy.TabulatedProfile.sampled("sphere", lambda r: 25 - 5 * (25 - r**2) ** 0.5, 2)
        >>> swtstudy.solve(profile=[sphere, "paraboloid"], rtol=1e-3).s.round(3).values.tolist()
        [0.162, 0.155]
        """
        places = np.linspace(0.0, plain_number(radius), SAMPLES)
        try:
            heights = np.broadcast_to(np.asarray(height(places), float), places.shape)
        except (TypeError, ValueError) as error:
            found = f"a function that fails ({error})"
            raise refused(f"{name}.height", found, "heights, of the shape of the radii") from None
        return cls(name, places, heights, geometry=geometry)

    @property
    def plane(self) -> bool:
        """True if it is a profile of a plane contact."""
        return self.geometry == PLANE

    def __repr__(self) -> str:
        return f"TabulatedProfile({self.name!r}, {self.radius.size} points up to {self.radius[-1]:g})"

    def content(self) -> dict[str, Any]:
        content = {name: getattr(self, name).tolist() for name in ("radius", "height")}
        return content | {"smoothing": self.smoothing} | ({"geometry": PLANE} if self.plane else {})

    @classmethod
    def of_content(cls, name: str, content: Mapping[str, Any]) -> TabulatedProfile:
        own = content["radius"], content["height"], content["smoothing"]
        return cls(name, *own, content.get("geometry", AXISYMMETRIC))

    def notes(self) -> dict[str, Any]:
        return {"deviation": self.deviation}

    def scaled(
        self, length: float, depth: float, rounded: Callable[[FloatArray], FloatArray] = np.asarray
    ) -> TabulatedProfile:
        """The same profile, with the same fit, in other units: radii in ``length``, heights in ``depth``.

        Its numbers are rounded by a function.
        """
        heights = rounded(np.append(self.height, self.smoothing) / depth)
        own = TabulatedProfile(
            self.name, rounded(self.radius / length), heights[:-1], heights[-1], self.geometry
        )
        power = np.arange(len(self.fit.c))[::-1, None]
        own.fit = type(self.fit).construct_fast(self.fit.c * length**power / depth, self.fit.x / length)
        own._sampled = self._sampled[0] / length, self._sampled[1] * (length / depth)
        if self.smoothing:
            own._contacts = self._contacts[0] / depth, self._contacts[1] / length
        return own

    @cached_property
    def fit(self) -> PPoly:
        """The spline f, from the edge of the face."""
        return spline(self.radius, self.height, self.smoothing)

    @property
    def deviation(self) -> float:
        """The largest distance of the fit from the heights."""
        on_curve = self.radius >= self.fit.x[0]
        missed = np.where(on_curve, self.fit(self.radius), 0.0) - self.height
        return float(np.abs(missed).max())

    @property
    def flat_radius(self) -> float:
        """Radius b of the face."""
        return float(self.fit.x[0])

    @property
    def end(self) -> float:
        """s = √(ξ² − b²) at the end of the table; beyond, dG/ds goes on in proportion to s."""
        b, last = self.flat_radius, float(self.fit.x[-1])
        return float(np.sqrt((last - b) * (last + b)))

    def jumps(self) -> FloatArray:
        """Jumps of f′ at the knots in powers of r, shape (3, m), from 0 within the face on."""
        c3, c2, c1 = self.fit.c[:3]
        knots = self.fit.x[:-1]
        powers = [c1 - 2.0 * c2 * knots + 3.0 * c3 * knots**2, 2.0 * c2 - 6.0 * c3 * knots, 3.0 * c3]
        return np.ascontiguousarray(np.diff(np.stack(powers), axis=1, prepend=0.0))

    def slope_jumps(self) -> FloatArray:
        """The same of (r f′)′, of which g′ is made, or in the plane of f″, (2, m), for N′."""
        return self.jumps()[1:] * [[1.0], [2.0]] if self.plane else self.jumps() * [[1.0], [2.0], [3.0]]

    def slope(self, radius: FloatArray) -> FloatArray:
        """g′ = ∫ (r f′)′ dr/√(ξ² − r²), or N′ = ξ ∫ f″ dx/√(ξ² − x²), at radii ξ within the table."""
        found = _abel(self.fit.x[:-1], self.slope_jumps(), radius)
        return radius * found if self.plane else found

    def density(self, s: FloatArray) -> FloatArray:
        """dG/ds, or dN/ds in the plane, at s, by cubics between 4,001 places."""
        inside = np.minimum(s, self.end)
        return np.asarray(self._density(inside) * np.maximum(s / self.end, 1.0))

    def rise(self, s: FloatArray) -> tuple[FloatArray, FloatArray]:
        """G = ξ ∫ f′ dr/√(ξ² − r²), and ∫ ξ dG = ∫ r² f′ dr/√(ξ² − r²), half of the normal force, at s.

        In the plane both are N = ∫ x f′ dx/√(ξ² − x²), a load over E*, in a length.
        """
        b, end, knots, jumps = self.flat_radius, self.end, self.fit.x[:-1], self.jumps()
        radius = np.hypot(np.minimum(s, end), b)
        # Beyond the end the slope over the radius is constant.
        rate = float(self._density(end)) / end
        beyond = 0.5 * rate * np.maximum(s - end, 0.0) * (end + s)
        if self.plane:
            load = _abel(knots, jumps, radius, 1) + beyond
            return load, load
        half_load = _abel(knots, jumps, radius, 2) + rate / 3.0 * (np.hypot(s, b) ** 3 - radius**3)
        return radius * _abel(knots, jumps, radius) + beyond, half_load

    @cached_property
    def deepest(self) -> float:
        """The depth, or N/N_0, up to which there is a full disc or strip of contact within the table."""
        return float(self.rise(self._largest)[0][0]) / (MEAN_LOAD if self.plane else 1.0)

    @property
    def compact_radius(self) -> float:
        """The radius of the largest contact that is one disc or strip, within the table."""
        return float(np.hypot(self._largest[0], self.flat_radius))

    def smoothed_share(self, depth: float) -> float:
        """The smoothing over the rise of heights within the contact at a depth, or in the plane at N/N_0."""
        return self.smoothing / float(self.fit(np.interp(depth, *self._contacts))) if self.smoothing else 0.0

    def least_smoothing(self, radius: float) -> float | None:
        """The least smoothing above its own with which contacts are one disc or strip up to a radius.

        It is known to a fifth. None if ``MOST_SMOOTHED`` times its own is not enough.
        """

        def compact(smoothing: float) -> bool:
            own = TabulatedProfile(self.name, self.radius, self.height, smoothing, self.geometry)
            return own.compact_radius >= radius

        low, high = self.smoothing, 2.0 * self.smoothing
        while not compact(high):
            low, high = high, 2.0 * high
            if not 0.0 < high <= MOST_SMOOTHED * self.smoothing:
                return None
        while high > 1.2 * low:
            middle = float(np.sqrt(low * high))
            low, high = (low, middle) if compact(middle) else (middle, high)
        return high

    def refused_at(self, depth: float) -> str | None:
        """Why there is no full disc of contact up to a depth, and the radius of it; or None.

        In the plane no full strip up to a line load over the mean one.
        """
        if depth <= self.deepest:
            return None
        at, place = ("load 4P/(πE*) =", "half-width") if self.plane else ("depth", "radius")
        if self._largest[0] < self.end:
            advice = "if its heights are noisy, smoothing takes that away"
            if self.smoothing != 0.0:
                advice = f"its smoothing is {self.smoothing:g}: more takes noise away, "
                advice += "less leaves its shape as it is"
            return (
                f"at the {at} {depth:g} {self.name} touches in several places: its fit is wavy at the "
                f"{place} {self.compact_radius:.4g}; {advice}"
            )
        return (
            f"the {at} {depth:g} is beyond the table of {self.name}, which ends at the {place} "
            f"{self.compact_radius:.4g}: the contact is as large as that at the {at} {self.deepest:.4g}"
        )

    @cached_property
    def _sampled(self) -> tuple[FloatArray, FloatArray]:
        """Places s up to the table's end, and the slope there."""
        s = np.linspace(0.0, self.end, RADII)
        return s, self.slope(np.hypot(s, self.flat_radius))

    @cached_property
    def _contacts(self) -> tuple[FloatArray, FloatArray]:
        """Depths, or N/N_0, of contacts up to these places, and their radii."""
        s, _ = self._sampled
        return self.rise(s)[0] / (MEAN_LOAD if self.plane else 1.0), np.hypot(s, self.flat_radius)

    @cached_property
    def _density(self) -> CubicSpline:
        """dG/ds between the same places."""
        from scipy.interpolate import CubicSpline

        s, slope = self._sampled
        return CubicSpline(s, slope * s / np.maximum(np.hypot(s, self.flat_radius), LEAST_STEP * self.end))

    @property
    def _largest(self) -> FloatArray:
        """The first of these places at which the slope is negative, or else the end, shape (1,)."""
        s, slope = self._sampled
        return np.append(s[slope < -NEGATIVE * np.abs(slope).max()], s[-1])[:1]


#: The name of a family, or a table.
AnyProfile = str | TabulatedProfile


def _frozen(values: ArrayLike) -> FloatArray:
    """A copy that cannot be changed, empty if it is not of numbers."""
    try:
        array = np.array(read_numbers("", values, ""))
    except StudyError:
        array = np.empty((0, 0))
    array.flags.writeable = False
    return array


def spline(radius: FloatArray, height: FloatArray, smoothing: float) -> PPoly:
    """f from where it rises first, with no slope there, and 0 there.

    Parameters
    ----------
    radius, height
        Shape (k,), ascending from 0; heights of 0 at the begin are a flat face.
    smoothing
        Root mean square of what it may miss of the heights; 0 to miss none.
    """
    # As long to import as all else, and few need it.
    from scipy.interpolate import CubicSpline, PPoly, make_smoothing_spline
    from scipy.optimize import brentq

    face = int(np.argmax(height != 0.0)) - 1
    r, f = radius[face:].copy(), height[face:]
    if face > 0:
        # Behind a face f rises like a square: where that would begin.
        rise = np.sqrt(f[1:3])
        begin, last = r[1] - rise[0] * (r[2] - r[1]) / (rise[1] - rise[0]), r[1] - 0.1 * (r[1] - r[0])
        if last < begin < r[1]:  # the first height is next to nothing: the next one tells the fit more
            r, f, last = np.delete(r, 1), np.delete(f, 1), begin
        r[0] = np.clip(begin, r[0], last)
    if smoothing == 0.0:
        return CubicSpline(r, f, bc_type=((1, 0.0), "not-a-knot"))
    # Even in r: that makes the slope vanish at the begin. The penalty of curvature goes with the cube of r.
    both = np.concatenate([2.0 * r[0] - r[:0:-1], r]), np.concatenate([f[:0:-1], f])

    def smooth(logarithm: float) -> PPoly:
        return PPoly.from_spline(make_smoothing_spline(*both, lam=10.0**logarithm * r[-1] ** 3))

    def excess(logarithm: float) -> float:
        missed = smooth(logarithm)(r) - f
        return float(np.sqrt(np.mean(missed**2))) - smoothing

    lowest, highest = -18.0, 6.0
    if excess(lowest) >= 0.0:
        found = smooth(lowest)
    elif excess(highest) <= 0.0:
        found = smooth(highest)
    else:
        found = smooth(brentq(excess, lowest, highest, xtol=1e-9))
    first = int(np.searchsorted(found.x, r[0], "right")) - 1
    part = PPoly(found.c[:, first:].copy(), found.x[first:])
    part.c[-1] -= part.c[-1, 0]
    return part


def _abel(knots: FloatArray, jumps: FloatArray, radius: FloatArray, power: int = 0) -> FloatArray:
    """∫ rᵖ h dr/√(ξ² − r²) from 0 to radii ξ, of a function h of pieces of polynomials.

    Parameters
    ----------
    knots, jumps
        Shape (m,) and (k, m): where they begin, and jumps of their coefficients of r⁰, r¹, … there.
    radius, power
        ξ, of any shape, and p.
    """
    flat, found = radius.ravel(), np.empty(radius.size)
    step = max(_SLAB // len(knots), 1)
    for begin in range(0, flat.size, step):
        xi = flat[begin : begin + step, None]
        ratio = np.minimum(knots / np.maximum(xi, SMALLEST), 1.0)
        root = np.sqrt((1.0 - ratio) * (1.0 + ratio))
        # ∫ cosᵐ: each from the one before the last.
        integrals = [np.arccos(ratio), root]
        for m in range(2, power + len(jumps)):
            integrals.append((root * ratio ** (m - 1) + (m - 1) * integrals[m - 2]) / m)
        parts = (xi[:, 0] ** (power + k) * (integrals[power + k] @ row) for k, row in enumerate(jumps))
        found[begin : begin + step] = sum(parts)
    return found.reshape(radius.shape)


def _mistakes(name: object, radius: FloatArray, height: FloatArray, smoothing: object) -> Iterator[Mistake]:
    """Return the mistakes in a table."""
    if mistake := wrong_name(name, "profile"):
        yield mistake
        name = "profile"
    for key, values in (("radius", radius), ("height", height)):
        if values.ndim != 1:
            found, allowed = "no one-dimensional array of numbers", "a list of numbers, or an array"
        elif (gaps := np.flatnonzero(~np.isfinite(values))).size:
            found = f"{values[gaps[0]]:g} at point {gaps[0] + 1}{more_like_it(gaps.size)}"
            allowed = "finite numbers: leave out points without a value"
        elif (largest := np.abs(values).max(initial=0.0)) > LARGEST or 0.0 < largest < SMALLEST:
            found, allowed = f"up to {largest:g}", f"in magnitude from {SMALLEST:g} to {LARGEST:g}"
        else:
            continue
        yield Mistake(f"{name}.{key}", found, allowed)
        return
    both = f"{name}.radius, {name}.height"
    if radius.size != height.size or radius.size < FEWEST:
        found = f"{radius.size} radii and {height.size} heights"
        yield Mistake(both, found, f"as many of each, at least {FEWEST}")
        return
    if radius.size > MOST:
        allowed = f"at most {MOST}: one of every {-(-radius.size // MOST)}, or the mean of so many"
        yield Mistake(both, f"{radius.size} points", allowed)
        return
    if radius[0] != 0.0 or height[0] != 0.0:
        found = f"a first point at the radius {radius[0]:g} with the height {height[0]:g}"
        yield Mistake(both, found, "0 and 0: the axis, and heights above it")
    falls = np.flatnonzero(np.diff(radius) <= LEAST_STEP * radius.max())
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
