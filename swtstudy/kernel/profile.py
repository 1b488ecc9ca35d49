"""Profiles (3) to (6) as data: dG/ds over s = √(ξ² - b²), which is smooth for all of them, and its integrals.

G = g/δ0 is the depth at which the spring at radius ξ touches (11). The memory diagram lives in a coordinate:
the depth G, or under prescribed forces the normal force N(ξ) = ∫ ξ dG / ∫_0^{G=1} ξ dG. Both are integrals
of dG/ds, so that a profile is one function.
"""

from functools import cache
from math import sqrt

import numpy as np
from scipy.optimize import brentq
from scipy.special import struve

from swtstudy.kernel.chebyshev import FIT, GAUSS, ORDER, RUN, clenshaw, panel_of
from swtstudy.kernel.compiled import jit, new_record

#: Coordinates of the memory diagram.
DEPTH, FORCE = 0, 1

MAX_PANELS, GUESSES = 509, 32
#: Coefficients of the series of a wave, which die out to rounding.
WAVE_ORDER = 26
PROFILE = np.dtype(
    [
        ("is_paraboloid", "i8"),  # 1: closed forms are used
        ("plane", "i8"),  # 1: the contact is a strip
        ("singular", "i8"),  # 1: the pressure has no bound at the edge of the face
        ("in_force", "i8"),  # coordinate of the diagram: DEPTH or FORCE
        ("panels", "i8"),
        ("flat_radius", "f8"),  # b/a_H
        ("force_unit", "f8"),  # ∫ ξ dG up to G = 1
        ("longest", "f8"),  # longest piece over which the profile is smooth
        ("begin", "f8", (MAX_PANELS,)),  # ends of the panels in s
        ("end", "f8", (MAX_PANELS,)),
        ("density", "f8", (MAX_PANELS, ORDER)),  # dG/ds
        ("coordinate", "f8", (MAX_PANELS, ORDER + 1)),  # its increase within the panel
        ("force", "f8", (MAX_PANELS, ORDER + 1)),  # increase of ∫ ξ dG within the panel
        ("coordinate_begin", "f8", (MAX_PANELS + 1,)),
        ("force_begin", "f8", (MAX_PANELS + 1,)),
        ("guess", "f8", (MAX_PANELS, GUESSES + 1)),  # place within the panel at even shares of the coordinate
    ]
)
_Y = np.linspace(-1.0, 1.0, 129)
_SERIES_AT_Y = np.polynomial.chebyshev.chebvander(_Y, ORDER).T
_SHARE = np.linspace(0.0, 1.0, GUESSES + 1)


def paraboloid(s):
    """dG/ds of (3)."""
    return 2.0 * s


def rounded_punch(s, b):
    """dG/ds of (4): g′ = 2√(ξ²-b²) - b arccos(b/ξ)."""
    return (2.0 * s - b * np.arctan(s / b)) * s / np.hypot(s, b)


def truncated_paraboloid(s, b):
    """dG/ds of (5): g′ = (2ξ²-b²)/√(ξ²-b²)."""
    return (2.0 * s * s + b * b) / np.hypot(s, b)


def wavy_paraboloid(s, amplitude, wavelength):
    """dG/ds of (6): g = ξ² + (π/2) h k ξ H₀(kξ), k = 2π/λ."""
    k = 2.0 * np.pi / wavelength
    return 2.0 * s + 0.5 * np.pi * amplitude * k * wave(k * s)


def wave(x):
    """H₀(x) + x (2/π - H₁(x)), the derivative of x H₀(x), from series over one wave each."""
    value = np.empty_like(x)
    number = (x / (2.0 * np.pi)).astype(int)
    for j in np.unique(number):
        on_it = number == j
        value[on_it] = np.polynomial.chebyshev.chebval(
            x[on_it] / np.pi - 2.0 * j - 1.0, _series_of_wave(int(j))
        )
    return value


@cache
def _series_of_wave(j):
    """Coefficients of `wave` over [2πj, 2π(j + 1)]; SciPy's Struve functions take 50 µs a value."""
    y = np.cos(np.pi * (np.arange(WAVE_ORDER) + 0.5) / WAVE_ORDER)
    x = np.pi * (2.0 * j + 1.0 + y)
    value = struve(0, x) + x * (2.0 / np.pi - struve(1, x))
    bad = ~np.isfinite(value)  # SciPy gives NaN next to the zeros
    if bad.any():
        near = x[bad] * (1.0 + 1e-7)
        value[bad] = struve(0, near) + near * (2.0 / np.pi - struve(1, near))
    return np.polynomial.chebyshev.chebfit(y, value, WAVE_ORDER - 1)


def tabulate_profile(
    density, flat_radius, largest, in_force, longest=0.5, tolerance=1e-8, is_paraboloid=False, singular=False
):
    """Profile as data, from the axis to where the coordinate of the diagram exceeds `largest`.

    Parameters
    ----------
    density
        dG/ds as a function of an array of s.
    flat_radius
        b/a_H, radius of a flat face.
    largest
        Largest coordinate needed: depth in δ0, or normal force in F_0.
    longest
        Longest panel: half a wave at most.
    tolerance
        Relative size of the last coefficients of a panel's series.
    """
    panels = []
    s, depth, force, unit = 0.0, 0.0, 0.0, np.nan  # unit: ∫ ξ dG up to G = 1
    while not (force / unit if in_force else depth) >= largest:
        new = _panels(density, flat_radius, s, s + 8.0 * longest, longest, tolerance)
        if in_force and depth < 1.0 <= depth + new[3].sum():
            unit = force + _force_at_unit_depth(new, 1.0 - depth)
        panels.append(new)
        s, depth, force = s + 8.0 * longest, depth + new[3].sum(), force + new[4].sum()
    begin, end, series, depth_series, force_series = (
        np.concatenate(part) for part in zip(*panels, strict=True)
    )
    coordinate = force_series / unit if in_force else depth_series
    reached = np.cumsum(coordinate.sum(axis=1))
    count = int(np.searchsorted(reached, largest)) + 1
    if count > MAX_PANELS:
        raise ValueError(f"the profile needs {count} panels, more than {MAX_PANELS}")
    record = new_record(PROFILE)
    record["singular"] = singular
    record["is_paraboloid"], record["in_force"], record["panels"] = is_paraboloid, in_force, count
    record["flat_radius"], record["force_unit"], record["longest"] = flat_radius, unit, longest
    record["begin"][:count], record["end"][:count] = begin[:count], end[:count]
    record["density"][:count], record["force"][:count] = series[:count], force_series[:count]
    record["coordinate"][:count] = coordinate[:count]
    record["coordinate_begin"][1 : count + 1] = reached[:count]
    record["force_begin"][1 : count + 1] = np.cumsum(force_series.sum(axis=1))[:count]
    share = coordinate[:count] @ _SERIES_AT_Y
    share /= share[:, -1:]
    share[0] = np.cbrt(np.maximum(share[0], 0.0)) if in_force else np.sqrt(np.maximum(share[0], 0.0))
    for p in range(count):
        record["guess"][p] = np.interp(_SHARE, share[p], _Y)
    return record


def _panels(density, flat_radius, begin, end, longest, tolerance):
    """Panels of [begin, end], ascending, each halved until the series of dG/ds has died out."""
    edges = np.linspace(begin, end, round((end - begin) / longest) + 1)
    if begin == 0.0 and flat_radius > 0.0:  # a small face would fall between the Gauss points
        near_face = flat_radius * 8.0 ** np.arange(1, 20)
        edges = np.union1d(near_face[near_face < edges[1]], edges)
    lower, upper, done = edges[:-1], edges[1:], []
    while lower.size:
        half = 0.5 * (upper - lower)[:, None]
        s = lower[:, None] + half * (GAUSS + 1.0)
        values = density(s)
        series = values @ FIT.T
        size = np.abs(series)
        rough = size[:, -2:].max(axis=1) > tolerance * np.maximum(size.max(axis=1), 1e-3)
        rough &= upper - lower > 1e-9 * longest
        force = half * ((values * np.sqrt(flat_radius**2 + s * s)) @ RUN)
        new = lower, upper, series, half * (values @ RUN), force
        done.append([part[~rough] for part in new])
        middle = (0.5 * (lower + upper))[rough]
        lower, upper = np.concatenate([lower[rough], middle]), np.concatenate([middle, upper[rough]])
    order = np.argsort(np.concatenate([part[0] for part in done]))
    return [np.concatenate(parts)[order] for parts in zip(*done, strict=True)]


def _force_at_unit_depth(panels, depth):
    """∫ ξ dG from the first panel's begin to where G has increased by depth."""
    _, _, _, depth_series, force_series = panels
    reached = np.cumsum(depth_series.sum(axis=1))
    p = int(np.searchsorted(reached, depth))
    rest = depth - (reached[p - 1] if p else 0.0)
    chebval = np.polynomial.chebyshev.chebval
    y = brentq(lambda y: chebval(y, depth_series[p]) - rest, -1.0, 1.0, xtol=1e-15) if rest > 0.0 else -1.0
    return force_series[:p].sum() + chebval(y, force_series[p])


@jit
def coordinate_at(P, s):
    """Coordinate of the diagram, depth or force, at s."""
    if P.is_paraboloid:
        return s * s * s if P.in_force else s * s
    p = panel_of(P.begin, 0, P.panels, s)
    y = 2.0 * (s - P.begin[p]) / (P.end[p] - P.begin[p]) - 1.0
    return P.coordinate_begin[p] + clenshaw(P.coordinate[p], y)


@jit
def density_at(P, s):
    """dG/ds at s."""
    if P.is_paraboloid:
        return 2.0 * s
    p = panel_of(P.begin, 0, P.panels, s)
    return clenshaw(P.density[p], 2.0 * (s - P.begin[p]) / (P.end[p] - P.begin[p]) - 1.0)


@jit
def force_at(P, s):
    """∫ ξ dG up to s."""
    if P.is_paraboloid:
        return 2.0 / 3.0 * s * s * s
    p = panel_of(P.begin, 0, P.panels, s)
    return P.force_begin[p] + clenshaw(P.force[p], 2.0 * (s - P.begin[p]) / (P.end[p] - P.begin[p]) - 1.0)


@jit
def place_of(P, coordinate):
    """Inverse of `coordinate_at`: a guess from the panel's table, then Newton's method within a bracket."""
    if coordinate <= 0.0:
        return 0.0
    if P.is_paraboloid:
        return coordinate ** (1.0 / 3.0) if P.in_force else sqrt(coordinate)
    p = panel_of(P.coordinate_begin, 0, P.panels, coordinate)
    half = 0.5 * (P.end[p] - P.begin[p])
    share = (coordinate - P.coordinate_begin[p]) / (P.coordinate_begin[p + 1] - P.coordinate_begin[p])
    share = min(max(share, 0.0), 1.0)
    if p == 0:
        share = share ** (1.0 / 3.0) if P.in_force else sqrt(share)
    z = GUESSES * share
    j = min(int(z), GUESSES - 1)
    y = P.guess[p, j] + (z - j) * (P.guess[p, j + 1] - P.guess[p, j])
    low, high = -1.0, 1.0
    for _ in range(50):
        f = P.coordinate_begin[p] + clenshaw(P.coordinate[p], y) - coordinate
        if f > 0.0:
            high = y
        else:
            low = y
        rate = half * clenshaw(P.density[p], y)
        if P.in_force:
            s = P.begin[p] + half * (y + 1.0)
            rate *= sqrt(P.flat_radius * P.flat_radius + s * s) / P.force_unit
        new = y - f / rate if rate > 0.0 else 0.5 * (low + high)
        if not (new >= low and new <= high):
            new = 0.5 * (low + high)
        moved = abs(new - y)
        y = new
        if moved < 1e-8:  # the next step would be its square
            break
    return P.begin[p] + half * (y + 1.0)


@jit
def radius_of(P, s):
    """Radius ξ at s."""
    return sqrt(s * s + P.flat_radius * P.flat_radius)
