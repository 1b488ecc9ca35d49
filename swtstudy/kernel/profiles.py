"""All profiles of the product as data: piecewise Chebyshev series of dG/ds, or in the plane of dN/ds."""

from functools import lru_cache, partial
from math import atan2, sqrt

import numpy as np

from swtstudy.kernel.compiled import jit, new_record
from swtstudy.kernel.profile import MAX_KINKS, MEAN_LOAD, PROFILE, tabulate_profile
from swtstudy.vocabulary.choices import family_of, is_plane
from swtstudy.vocabulary.families import FORMS, power_law

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
#: Waves whose phase kξ exceeds this at the edge of the contact are left out.
LARGEST_PHASE = 512.0
#: Change of s by waves that are left out, over their slope: s is quadratic in the stress, which goes with
#: the slope, and as much again comes from the contact.
CHANGED_BY_SLOPE = 4.0
#: The density of ξⁿ has no series at the axis: its panels there are halved to this share of a_H.
NEAR_AXIS = 1e-6
#: Panels of a table over its length, at first; the narrowest; and how far it is continued beyond its end.
TABLE_PANELS, TABLE_NARROWEST, TABLE_BEYOND = 8, 1e-3, 1.05
#: A kink of a table changes the slope by this share of it at least, within this share of the table's length
#: at most. Its peak of the pressure is within so many widths of it, and no other kink nearer than so many.
KINKED, KINK_WIDEST, KINK_REACH, KINKS_APART = 0.01, 1.0 / 128.0, 2.0, 6.0


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
    form, family, plane = FORMS[profile], family_of(profile), is_plane(profile)
    names, values = family.shape, tuple(float(shape[name]) for name in family.shape)
    left_out = _left_out(values, in_force and not plane, largest) if "wavelength" in names else 0.0
    plain = not values or (family.plain == (names[0], 0.0) and values[0] < SMALLEST)
    if plain or left_out > 0.0:
        record = _record(plane, in_force, exponent=2.0)
        record["left_out"] = left_out
        return record
    if form.density is power_law:
        record = _record(plane, in_force, exponent=values[0])
        if record["is_hertz"]:
            return record
    else:
        record = _record(plane, in_force)
    density, face, narrowest, floor = partial(_density, form, plane, values), (), 1e-9 * LONGEST, 1e-3
    if "wavelength" in names:
        record["longest"] = min(LONGEST, 0.5 * values[1] * np.sqrt(values[0]))
    elif form.density is power_law:
        narrowest = NEAR_AXIS
    if form.faced:
        record["flat_radius"], record["singular"] = values[0], form.singular
        face = values[0] * 8.0 ** np.arange(1, 20)  # a small face would fall between the Gauss points
        face = face[face < record["longest"]]
    tolerance = PROFILE_SHARE * rtol
    rises = 1 if record["exponent"] > 0.0 else form.rises
    missed = tabulate_profile(record, density, rises, largest, tolerance, floor, narrowest, first_edges=face)
    if missed == np.inf:
        raise ValueError(
            f"{profile} {shape} needs more panels than there is room for, up to the depth or force "
            f"{largest:g} at rtol {rtol:g}: take a larger rtol or a smaller load"
        )
    return record


def _record(plane, in_force, exponent=0.0):
    """A record without panels; pure powers need panels for their functionals only."""
    record = new_record(PROFILE)
    weighted = in_force and not plane
    record["plane"], record["in_force"] = plane, in_force or plane
    record["is_hertz"], record["exponent"], record["power"] = exponent == 2.0, exponent, exponent + weighted
    record["longest"] = ENDLESS if exponent == 2.0 else LONGEST
    if exponent == 2.0:
        record["panels"], record["end"][0] = 1, ENDLESS
    return record


def _density(form, plane, values, s):
    density = form.density(s, *values)
    return MEAN_LOAD * density if plane else density


def _left_out(values, weighted, largest):
    """Relative error of s by waves that are too short to follow, 0 of others."""
    amplitude, wavelength = values
    if amplitude == 0.0:
        return 0.0
    slope = 2.0 * np.pi * np.sqrt(amplitude) / wavelength
    radius = np.cbrt(largest) if weighted else np.sqrt(largest)
    # Waves of the same slope and a phase beyond 2π change the radius by less than they change s.
    return CHANGED_BY_SLOPE * slope if slope * radius > LARGEST_PHASE * amplitude else 0.0


@lru_cache(maxsize=8)
def _of_table(table, in_force, largest, rtol):
    """Profile as data of a table: panels end at knots, behind which they are as short as the tolerance needs.

    f is a cubic spline from the edge b of a face on, where it has no slope. Beyond its end g′/ξ is constant.
    """
    fit = table.fit
    b = float(fit.x[0])
    knots = np.sqrt((fit.x - b) * (fit.x + b))
    at, jumps = fit.x[:-1].copy(), table.slope_jumps()

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
    kinks = kinks_of(fit, np.hypot(record["end"][record["panels"] - 1], b))
    record["kinks"] = len(kinks)
    record["kink"][: len(kinks)] = np.sqrt((kinks - b) * (kinks + b))
    return record


def kinks_of(fit, reach):
    """Where the slope of a table changes within a few rows, `MAX_KINKS` places at most, the sharpest first.

    The change within a width w, beyond that of the slope's trend over four times as much, is as large for 2w
    at a kink. On a smooth curve it grows like w³.

    Parameters
    ----------
    fit
        The spline f, a `scipy.interpolate.PPoly`.
    reach
        Radius up to which it matters.

    Returns
    -------
    numpy.ndarray
        Shape (k, 3): radii of the begin, the middle and the end of each.
    """
    slope, begin, end = fit.derivative(), fit.x[0], fit.x[-1]
    knots = np.unique(fit.x)
    r, w = knots[1:-1], np.maximum(np.diff(knots)[1:], np.diff(knots)[:-1])
    found, share = np.zeros(len(r)), np.zeros(len(r))
    while True:
        open_ = (found == 0.0) & (8.0 * w <= np.minimum(r - begin, end - r)) & (w <= KINK_WIDEST * end)
        if not open_.any():
            break
        at, width = r[open_], w[open_]
        change = [slope(at + k * width) - slope(at - k * width) for k in (1.0, 2.0, 4.0, 8.0)]
        kink, wider = np.abs(change[0] - 0.25 * change[2]), np.abs(change[1] - 0.25 * change[3])
        sharp = kink / np.maximum(np.abs(slope(at)), SMALLEST)
        is_kink = (sharp > KINKED) & (kink >= 0.5 * wider)
        found[open_], share[open_] = np.where(is_kink, width, 0.0), sharp
        w = 2.0 * w
    kinks, candidates = [], np.flatnonzero((found > 0.0) & (r < reach))
    for k in candidates[np.argsort(-share[candidates])]:
        apart = all(abs(r[k] - r[j]) > KINKS_APART * max(found[k], found[j]) for j in kinks)
        if apart and len(kinks) < MAX_KINKS:
            kinks.append(k)
    return r[kinks, None] + KINK_REACH * found[kinks, None] * np.array([-1.0, 0.0, 1.0])


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
