"""All profiles of the product as data: a profile is one function of s and one row of a table.

The functions give dG/ds at s = √(ξ² - b²), with G = g/δ0, or in the plane G = N/N_0.
"""

from functools import cache, lru_cache, partial
from math import atan2, sqrt
from typing import NamedTuple

import numpy as np

from swtstudy.kernel.chebyshev import clenshaw
from swtstudy.kernel.compiled import jit, new_record
from swtstudy.kernel.profile import MEAN_LOAD, PROFILE, tabulate_profile

#: No coordinate at which the profile is asked lies beyond its table by rounding.
MARGIN = 1e-9
#: The last coefficients of a profile's series are at most this share of rtol: what they leave out is less.
PROFILE_SHARE = 0.01
#: Faces and waves below this, in a_H or δ0, are none.
SMALLEST = 1e-12
#: Longest panel, in a_H.
LONGEST = 0.5
#: Larger than any contact: nothing is to be seen along it.
ENDLESS = 1e300
#: Coefficients of the series of a wave, which die out to rounding.
WAVE_ORDER = 26
#: Waves whose phase kξ exceeds this at the edge of the contact are left out.
LARGEST_PHASE = 512.0
#: What waves that are left out change of s, over their slope: s is quadratic in the stress, which goes with
#: the slope, and as much again comes from the contact.
CHANGED_BY_SLOPE = 4.0
#: The density of ξⁿ has no series at the axis: its panels there are halved to this share of a_H.
NEAR_AXIS = 1e-6
#: Panels of a table over its length, at first; the narrowest; and how far it is continued beyond its end.
TABLE_PANELS, TABLE_NARROWEST, TABLE_BEYOND = 8, 1e-3, 1.05


def power_law(s, exponent):
    """dG/ds of G = ξⁿ: the paraboloid (3) and the cylinder for n = 2."""
    return exponent * s ** (exponent - 1.0)


def rounded_punch(s, b):
    """dG/ds of (4): g′ = 2√(ξ²-b²) - b arccos(b/ξ)."""
    return (2.0 * s - b * np.arctan2(s, b)) * s / np.hypot(s, b)


def truncated_paraboloid(s, b):
    """dG/ds of (5): g′ = (2ξ²-b²)/√(ξ²-b²)."""
    return (2.0 * s * s + b * b) / np.hypot(s, b)


def wavy_paraboloid(s, amplitude, wavelength):
    """dG/ds of (6): g = ξ² + (π/2) h k ξ H₀(kξ), k = 2π/λ."""
    k = 2.0 * np.pi / (wavelength * np.sqrt(amplitude))
    return 2.0 * s + 0.5 * np.pi * amplitude * k * wave(k * s)


def rounded_flat(s, b):
    """dG/ds of the flat with rounded edges: N = ½ [ξ² arctan(s/b) - b s]."""
    return s * np.arctan2(s, b) / MEAN_LOAD


def wavy_cylinder(s, amplitude, wavelength):
    """dG/ds of the wavy cylinder: N = πξ²/4 + (π/2) h k ξ J₁(kξ)."""
    from scipy.special import j0  # as long to import as all else, and few need it

    k = 2.0 * np.pi / (wavelength * np.sqrt(amplitude))
    return 2.0 * s * (1.0 + amplitude * k * k * j0(k * s))


class Family(NamedTuple):
    """A profile that is known by its parameters.

    Attributes
    ----------
    density
        dG/ds of an array of s and of the parameters.
    parameters
        Names of the shape parameters; where the first one is 0 the profile is a paraboloid or a cylinder.
    rises
        Power of s as which the coordinate, depth or line load, rises at s = 0.
    plane, faced, singular
        Whether it is a strip, whether its first parameter is the radius of a flat face, and whether the
        pressure has no bound at the edge of that.
    """

    density: object
    parameters: tuple[str, ...] = ()
    rises: int = 2
    plane: bool = False
    faced: bool = False
    singular: bool = False


FAMILIES = {
    "paraboloid": Family(power_law),
    "power_law": Family(power_law, ("exponent",)),
    "rounded_punch": Family(rounded_punch, ("flat_radius",), rises=3, faced=True),
    "truncated_paraboloid": Family(
        truncated_paraboloid, ("flat_radius",), rises=1, faced=True, singular=True
    ),
    "wavy_paraboloid": Family(wavy_paraboloid, ("waviness_amplitude", "wavelength")),
    "cylinder": Family(power_law, plane=True),
    "power_law_cylinder": Family(power_law, ("exponent",), plane=True),
    "rounded_flat": Family(rounded_flat, ("flat_half_width",), rises=3, plane=True, faced=True),
    "wavy_cylinder": Family(wavy_cylinder, ("waviness_amplitude", "wavelength"), plane=True),
}


def is_plane(profile):
    """True if a profile, a name or a table, is that of a strip."""
    return FAMILIES[profile].plane if isinstance(profile, str) else profile.plane


def profile_record(profile, shape, in_force, largest, rtol):
    """Profile as data.

    Parameters
    ----------
    profile
        Name of a family, or a table (`swtstudy.TabulatedProfile`).
    shape
        Its shape parameters by name, floats; empty for a table.
    in_force
        Whether the memory diagram lives in the normal force; in the plane it always does.
    largest
        Largest depth in δ0, or normal force in F_0.
    rtol
        Relative accuracy asked of s.
    """
    largest = largest * (1.0 + MARGIN)
    if not isinstance(profile, str):
        # The same for all points of a study.
        return _of_table(profile, in_force or profile.plane, 2.0 ** np.ceil(np.log2(largest)), rtol)
    family = FAMILIES[profile]
    values = tuple(float(shape[name]) for name in family.parameters)
    left_out = _left_out(family, values, in_force, largest)
    if not values or values[0] < SMALLEST or left_out > 0.0:
        record = _record(family.plane, in_force, exponent=2.0)
        record["left_out"] = left_out
        return record
    if family.density is power_law:
        record = _record(family.plane, in_force, exponent=values[0])
        if record["is_hertz"]:
            return record
    else:
        record = _record(family.plane, in_force)
    density, face, narrowest, floor = partial(_density, family, values), (), 1e-9 * LONGEST, 1e-3
    if "wavelength" in family.parameters:
        record["longest"] = min(LONGEST, 0.5 * values[1] * np.sqrt(values[0]))
    elif family.density is power_law:
        narrowest = NEAR_AXIS
    if family.faced:
        record["flat_radius"], record["singular"] = values[0], family.singular
        face = values[0] * 8.0 ** np.arange(1, 20)  # a small face would fall between the Gauss points
        face = face[face < record["longest"]]
    tolerance = PROFILE_SHARE * rtol
    rises = 1 if record["exponent"] > 0.0 else family.rises
    missed = tabulate_profile(record, density, rises, largest, tolerance, floor, narrowest, first_edges=face)
    if missed == np.inf:
        raise ValueError(
            f"{profile} {shape} needs more panels than there is room for, up to the depth or force "
            f"{largest:g} at rtol {rtol:g}: take a larger rtol or a smaller load"
        )
    return record


def _record(plane, in_force, exponent=0.0):
    """A record without panels; those of pure powers need them for their functionals only."""
    record = new_record(PROFILE)
    weighted = in_force and not plane
    record["plane"], record["in_force"] = plane, in_force or plane
    record["is_hertz"], record["exponent"], record["power"] = exponent == 2.0, exponent, exponent + weighted
    record["longest"] = ENDLESS if exponent == 2.0 else LONGEST
    if exponent == 2.0:
        record["panels"], record["end"][0] = 1, ENDLESS
    return record


def _density(family, values, s):
    density = family.density(s, *values)
    return MEAN_LOAD * density if family.plane else density


def _left_out(family, values, in_force, largest):
    """Relative error of s by waves that are too short to follow, 0 of others."""
    if "wavelength" not in family.parameters or values[0] == 0.0:
        return 0.0
    amplitude, wavelength = values
    slope = 2.0 * np.pi * np.sqrt(amplitude) / wavelength
    radius = np.cbrt(largest) if in_force and not family.plane else np.sqrt(largest)
    # Waves of the same slope and a phase beyond 2π change the radius by less than they change s.
    return CHANGED_BY_SLOPE * slope if slope * radius > LARGEST_PHASE * amplitude else 0.0


def wave(x):
    """H₀(x) + x (2/π - H₁(x)), the derivative of x H₀(x), from series over one wave each."""
    count = int(x.max() / (2.0 * np.pi)) + 1
    value = np.empty(x.size)
    _sum_waves(_waves(8 * -(-count // 8)), x.ravel(), value)
    return value.reshape(x.shape)


@jit
def _sum_waves(series, x, value):
    for i in range(x.shape[0]):
        number = int(x[i] / (2.0 * np.pi))
        value[i] = clenshaw(series[number], x[i] / np.pi - 2.0 * number - 1.0)


@lru_cache(maxsize=16)
def _waves(count):
    """The series of the first waves, shape (count, WAVE_ORDER)."""
    return np.stack([_series_of_wave(j) for j in range(count)])


@cache
def _series_of_wave(j):
    """Coefficients of `wave` over [2πj, 2π(j + 1)]; SciPy's Struve functions take 50 µs a value."""
    from scipy.special import struve

    y = np.cos(np.pi * (np.arange(WAVE_ORDER) + 0.5) / WAVE_ORDER)
    x = np.pi * (2.0 * j + 1.0 + y)
    value = struve(0, x) + x * (2.0 / np.pi - struve(1, x))
    bad = ~np.isfinite(value)  # SciPy gives NaN next to the zeros
    if bad.any():
        near = x[bad] * (1.0 + 1e-7)
        value[bad] = struve(0, near) + near * (2.0 / np.pi - struve(1, near))
    return np.polynomial.chebyshev.chebfit(y, value, WAVE_ORDER - 1)


@lru_cache(maxsize=8)
def _of_table(table, in_force, largest, rtol):
    """Profile as data of a table: panels end at knots, behind which they are as short as the tolerance needs.

    f is a cubic spline from the edge b of a face on, where it has no slope. Beyond its end g′/ξ is constant.
    """
    fit = table.fit
    b = float(fit.x[0])
    knots = np.sqrt((fit.x - b) * (fit.x + b))
    at, jumps = fit.x[:-1].copy(), _jumps(fit, table.plane)

    def density(s):
        inside = np.minimum(s, knots[-1]).ravel()
        values = np.empty(inside.size)
        _sum_knots(at, knots, jumps, b, table.plane, inside, values)
        return values.reshape(s.shape) * np.maximum(s / knots[-1], 1.0)

    record = _record(table.plane, in_force)
    record["flat_radius"], record["longest"] = b, knots[-1] / TABLE_PANELS
    tolerance = PROFILE_SHARE * rtol
    scale = float(np.abs(density(np.linspace(0.0, knots[-1], 101))).max())
    rises, narrowest, span = 3 if b > 0.0 else 2, TABLE_NARROWEST * knots[-1], TABLE_BEYOND * knots[-1]
    while True:
        own = record, density, rises, largest, tolerance, scale, narrowest, span, knots
        missed = tabulate_profile(*own)
        if missed < np.inf:
            break
        tolerance *= 10.0  # a rough table
    if tolerance > PROFILE_SHARE * rtol:
        missed = max(missed, tolerance)
    record["left_out"] = CHANGED_BY_SLOPE * missed
    return record


def _jumps(fit, plane):
    """Jumps at the knots of (r f′)′ in powers of r, or of f″, shape (3 or 2, m), from the spline's pieces."""
    c3, c2, c1 = fit.c[:3]
    knots = fit.x[:-1]
    bend = 2.0 * c2 - 6.0 * c3 * knots
    if plane:
        powers = [bend, 6.0 * c3]
    else:
        powers = [c1 - 2.0 * c2 * knots + 3.0 * c3 * knots**2, 2.0 * bend, 9.0 * c3]
    return np.ascontiguousarray(np.diff(np.stack(powers), axis=1, prepend=0.0))


@jit
def _sum_knots(at, places, jumps, b, plane, s, values):
    """Write dG/ds = (s/ξ) ∫ (r f′)′ dr/√(ξ²-r²), or in the plane s ∫ f″ dr/√(ξ²-r²), at s = √(ξ²-b²).

    Each knot inside ξ adds its jump times an integral of 1, r and r² over the root from there to ξ.
    """
    for i in range(s.shape[0]):
        xi, total = sqrt(s[i] * s[i] + b * b), 0.0
        for k in range(at.shape[0]):
            if places[k] >= s[i]:
                break
            root = sqrt((s[i] - places[k]) * (s[i] + places[k]))
            angle = atan2(root, at[k])
            total += jumps[0, k] * angle + jumps[1, k] * root
            if not plane:
                total += jumps[2, k] * 0.5 * (xi * xi * angle + at[k] * root)
        values[i] = total * s[i]
        if not plane and s[i] > 0.0:
            values[i] /= xi
