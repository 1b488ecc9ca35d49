"""Margins of points, as far as the load alone gives them: how far they are from where the model ends.

One of them is the shift of the stick zone by the bulk strain, which s has where it is known
(`swtstudy.kernel.shift`) and leaves out elsewhere. The strain of the body that carries an oscillating bulk
stress drags its surface under the other body. For a Hertz contact of similar materials a stick circle off
centre makes a uniform strain, which cancels the bulk stress's strain along x if the shift is
e = 2 B_A/(μ (1 + ν)(4 − 3ν)) in a_H, B in E* δ0/a_H. For a loop B_A is half the range of the bulk stress, as
of an oscillation. For a cylinder, in plane strain, e = B_A/(2μ). Both hold for equal moduli; with others
the shift goes with the strain of the body that carries the bulk stress over the mean strain of both, under
equal tractions.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from swtstudy.kernel.loops import slope_of
from swtstudy.solver.at_rest import AtRest
from swtstudy.solver.points import Points, arguments_of
from swtstudy.vocabulary.arrays import BoolArray, FloatArray
from swtstudy.vocabulary.choices import PLAIN, PLAIN_STRIP, is_plane

#: Instants for each oscillation at which loads are seen before anything is compiled: parabolas through them
#: are off by some 1e-6 of an amplitude. And values of a load that are held at a time.
SAMPLES, AT_ONCE = 96, 2_000_000
#: Places of a profile between which depths and forces are interpolated, and the last of them over √δ0.
PLACES = 4001
#: Rounding of the samples, relative, of a shift.
ROUNDING = 1e-6

#: Margins by name; see `margins_of`.
Margins = dict[str, FloatArray]
_COMPILED = ("contact_radius", "stick_radius", "force_ratio", "slide", "moved")


def margins_of(points: Points) -> Margins:
    """Margins of n points of one profile family and control.

    Returns
    -------
    dict
        Arrays of shape (n,). ``contact_radius``: the largest of the cycle in a_H, half the width in plane
        contacts. ``stick_radius``: radius of the permanent stick zone in a_H; NaN where there is none.
        ``force_ratio``: the largest F_x/(μ F_N) that is prescribed: there is no equilibrium where it is above
        1; NaN where the tangential force is not prescribed. ``slide``: by how much the tangential
        displacement exceeds the limit of partial slip, in μ E* δ0/G*: u_A minus that limit if the depth is
        constant; 0 without gross slip, NaN where the bodies part or the tangential force is prescribed.
        ``moved``: 1 where the bulk stress moves the stick zone in s, 2 where it follows the tangential load
        nearly, else 0. ``unit_shift``: by how much the
        strain of a bulk stress of amplitude 1 E* δ0/a_H would move it, in a_H, however large that is.
    """
    # Compiled: whoever only reads a study does without.
    from swtstudy.kernel.batch import margins_batch

    found = margins_batch(**arguments_of(points))
    return {name: found[name].astype(float) for name in _COMPILED} | {"unit_shift": unit_shift(points)}


def foreseen(points: Points) -> Margins:
    """The same from samples of the loads, to 1e-5: without a compiler, for studies that are only read."""
    found = {name: np.full(len(points), np.nan) for name in _COMPILED} | {"unit_shift": unit_shift(points)}
    for p, q in np.unique(np.stack([points.p, points.q], axis=1), axis=0).tolist():
        alike = np.flatnonzero((points.p == p) & (points.q == q))
        parts = -(-alike.size * _motion(points[alike[:1]])[0].shape[1] // AT_ONCE)
        for rows in np.array_split(alike, parts):
            for name, values in _from_samples(points[rows], found["unit_shift"][rows]).items():
                found[name][rows] = values
    return found


def _motion(points: Points) -> tuple[FloatArray, FloatArray, FloatArray, bool]:
    """Normal, tangential and bulk motion over their amplitudes, (n, T) or (1, T), and whether it is smooth.

    The points have one frequency ratio, or one loop; of a polygon the vertices are all that matters.
    """
    path: Any = points.path
    if hasattr(path, "vertices"):
        columns = path.vertices.T[:, None]
        return columns[0], columns[1], columns[2] if len(columns) > 2 else 0.0 * columns[0], False
    if path is None:
        p, q, still = int(points.p[0]), int(points.q[0]), np.zeros(1)
        own = (q, points.phase), (p, still), (p, points.bulk_stress_phase)
        rows: Any = [[(order, 1.0, phase[:, None])] for order, phase in own]
    else:
        rows = [path.harmonics.get(key, ()) for key in ("normal", "tangential", "bulk")]
    fastest = max([1, *(order for row in rows for order, _, _ in row)])
    turn = 2.0 * np.pi / (SAMPLES * fastest) * np.arange(SAMPLES * fastest)[None]
    zero = np.zeros((1, turn.size))
    normal, tangential, bulk = (sum((a * np.sin(k * turn + φ) for k, a, φ in row), zero) for row in rows)
    return normal, tangential, bulk, True


def _largest(values: FloatArray, smooth: bool) -> FloatArray:
    """Largest values of closed curves, (n, T), shape (n,): of smooth ones by parabolas."""
    if not smooth:
        return values.max(axis=1)
    before, after = np.roll(values, 1, axis=1), np.roll(values, -1, axis=1)
    top = (values >= before) & (values >= after) & np.isfinite(before + values + after)
    bend = np.where(top, 2.0 * values - before - after, 0.0)
    rise = np.divide((after - before) ** 2, 8.0 * bend, out=np.zeros_like(values), where=bend > 0.0)
    return np.asarray((values + rise).max(axis=1))


def _from_samples(points: Points, unit_shift: FloatArray) -> Margins:
    """Margins of points of one frequency ratio, or one loop, from samples of their loads."""
    normal, tangential, bulk, smooth = _motion(points)
    follows, exactly = _follows(points, normal, tangential, bulk)
    normal = 1.0 + points.normal_amplitude[:, None] * normal
    tangential = np.broadcast_to(points.tangential_amplitude[:, None] * tangential, normal.shape)
    largest = _largest(normal, smooth)
    control, plane = points.control, is_plane(points.profile)
    shapes = np.stack([np.zeros(len(points)), *points.shape.values()], axis=1)
    for shape in np.unique(shapes, axis=0) if control.mixed and not plane else ():
        rows = np.flatnonzero((shapes == shape).all(axis=1))
        scale = _other_coordinate(points[rows[:1]], float(largest[rows].max()))
        for values in (normal, largest):
            own = np.interp(np.maximum(values[rows], 0.0), *scale)
            values[rows] = np.where(values[rows] > 0.0, own, values[rows])
    stick = -0.5 * (_largest(-tangential - normal, smooth) + _largest(tangential - normal, smooth))
    ends = np.maximum(np.stack([stick, largest], axis=1), 0.0)
    radius = _radii(AtRest(points.profile, points.shape), ends, control.tangential_force and not plane)
    found = {"contact_radius": radius[:, 1], "stick_radius": np.where(stick >= 0.0, radius[:, 0], np.nan)}
    width = (radius[:, 1] - found["stick_radius"]) * (1.0 + ROUNDING)
    shift = unit_shift * points.bulk_stress_amplitude * np.abs(points.bulk_strain_share)
    found["moved"] = np.where(follows & (shift <= width), np.where(exactly, 1.0, 2.0), 0.0)
    if not control.tangential_force:
        slide = np.where(normal.min(axis=1) > 0.0, np.maximum(-stick, 0.0), np.nan)
        return found | {"slide": slide}
    size, load = np.abs(tangential), np.maximum(normal, 0.0)
    with np.errstate(divide="ignore"):
        ratio = np.divide(size, load, out=np.zeros_like(load), where=size > 0.0)
    return found | {"force_ratio": _largest(ratio, smooth)}


def _follows(
    points: Points, normal: FloatArray, tangential: FloatArray, bulk: FloatArray
) -> tuple[BoolArray, BoolArray]:
    """Where bulk stresses follow the tangential load at a constant normal load, and where exactly, (n,)."""
    rests = (points.normal_amplitude == 0.0) | (np.ptp(normal, axis=1) == 0.0)
    slope, exactly = slope_of(*np.broadcast_arrays(tangential, bulk))
    moves = points.tangential_amplitude * points.bulk_stress_amplitude * points.bulk_strain_share != 0.0
    return rests & (slope != 0.0) & moves & (points.profile in (PLAIN, PLAIN_STRIP)), exactly


def _radii(at_rest: AtRest, coordinate: FloatArray, in_force: bool) -> FloatArray:
    """Radii of n profiles, or one, at depths, or forces over that at δ0; shape (n, m)."""
    alike = len(at_rest.flat_radius) == 1
    own = coordinate.reshape(1, -1) if alike else coordinate
    found = at_rest.radius_at(own * at_rest.unit()) if in_force else at_rest.radius(own)
    return found.reshape(coordinate.shape)


def _other_coordinate(point: Points, largest: float) -> tuple[FloatArray, FloatArray]:
    """Normal loads as they are prescribed and in the kind of the tangential one, up to the largest."""
    at_rest, given = AtRest(point.profile, point.shape), np.array([[max(largest, 1.0)]])
    edge = float(_radii(at_rest, given, point.control.normal_force)[0, 0])
    b = float(at_rest.flat_radius[0, 0])
    s = np.sqrt((edge - b) * (edge + b)) * np.linspace(0.0, 1.0, PLACES)
    depth, half_load = (each[0] for each in at_rest.rise(s[None]))
    force = half_load / at_rest.unit()[0, 0]
    return (force, depth) if point.control.normal_force else (depth, force)


def unit_shift(points: Points) -> FloatArray:
    """e/B_A of n points in a_H, shape (n,): beyond the width of the slip zone e is but an estimate.

    NaN without friction, and for other profiles than the paraboloid and the cylinder; 0 for a loop without
    bulk stress.
    """
    ν, μ, amplitude = points.poisson_ratio, points.friction, 1.0
    if points.path is not None:
        amplitude = 0.5 * np.ptp(points.path.bulk_ends or (0.0, 0.0))
    stiffness = 4.0 if points.profile == PLAIN_STRIP else (1.0 + ν) * (4.0 - 3.0 * ν)
    if points.profile not in (PLAIN, PLAIN_STRIP) and amplitude > 0.0:
        stiffness = np.nan
    shift = np.full(len(points), np.nan)
    return np.divide(2.0 * amplitude, μ * stiffness, out=shift, where=μ > 0.0)
