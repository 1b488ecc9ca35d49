"""Loads as records, made in Python from what is prescribed.

The memory diagram lives in the kind of the tangential load. Where the kinds are mixed, the normal load is
mapped: a depth prescribed with a tangential force becomes the normal force N(δ), a normal force prescribed
with a tangential displacement the depth G(N), increasing functions of the profile through the place s of the
edge.
"""

from functools import reduce
from math import gcd

import numpy as np

from swtstudy.kernel.chebyshev import gauss_legendre, panel_of
from swtstudy.kernel.compiled import jit, new_record
from swtstudy.kernel.load import (
    BULK,
    BY_POWER,
    BY_SERIES,
    LOAD,
    MAP_ORDER,
    MAX_HARMONICS,
    MAX_MAP,
    MAX_VERTICES,
    UNMAPPED,
    mapped,
)
from swtstudy.kernel.loops import ends_of_sum, even_instants, slope_of, sum_at, without_collinear
from swtstudy.kernel.profile import density_at, force_at, place_of

#: Panels of the map are halved, so many times at most, until its last coefficients are this share of the
#: largest one, or this much: rounding of the place at small loads.
TOLERANCE, ROUNDING, HALVINGS = 1e-12, 1e-13, 6
#: The map is a power law below this share of the first panel of the profile.
POWER_LAW = 1e-6
NODE, WEIGHT = gauss_legendre(12)
_NODES = -np.cos(np.pi * np.arange(MAP_ORDER) / (MAP_ORDER - 1))
_SERIES = np.linalg.inv(np.polynomial.chebyshev.chebvander(_NODES, MAP_ORDER - 1))


def load_of(
    loop,
    normal_amplitude,
    tangential_amplitude,
    phase=0.0,
    frequency_ratio=None,
    bulk_amplitude=0.0,
    bulk_mean=0.0,
    bulk_phase=0.0,
):
    """Load of one point from its parameters.

    Parameters
    ----------
    loop
        A loop of the package: with ``vertices``, shape (k, 2) or (k, 3), or with ``harmonics``, rows of
        order, amplitude and phase by component. None for two sines, which the phase ψ and the fraction
        ω2/ω1 belong to.
    normal_amplitude, tangential_amplitude
        δ_A/δ0 and G*u_A/(μE*δ0), or F_A/F_0 and Q_A/(μF_0); factors of a loop.
    bulk_amplitude, bulk_mean, bulk_phase
        Bulk stress in E* δ0/a_H, its amplitude a factor of a loop's third component; ψ_B in rad.
    """
    amplitudes = normal_amplitude, tangential_amplitude, bulk_amplitude
    if loop is None:
        own = bulk_amplitude, bulk_mean, bulk_phase
        return bimodal(normal_amplitude, frequency_ratio, tangential_amplitude, phase, *own)
    if hasattr(loop, "vertices"):
        columns = [size * column for size, column in zip(amplitudes, loop.vertices.T, strict=False)]
        bulk = bulk_mean + columns[2] if len(columns) == 3 else np.full(len(columns[0]), bulk_mean)
        # All vertices are instants, whatever the size of the bulk stress that turns at some of them.
        return polygon(1.0 + columns[0], columns[1], bulk, every=len(columns) == 3)
    rows = [
        [(order, size * amplitude, phase) for order, amplitude, phase in loop.harmonics.get(key, ())]
        for size, key in zip(amplitudes, ("normal", "tangential", "bulk"), strict=True)
    ]
    return harmonic_sum(*rows, means=(1.0, 0.0, bulk_mean))


def bimodal(
    normal_amplitude,
    frequency_ratio,
    tangential_amplitude,
    phase,
    bulk_amplitude=0.0,
    bulk_mean=0.0,
    bulk_phase=0.0,
):
    """Load of the paper: n = 1 + δ_A sin(qt + ψ), v = u_A sin(pt), with ω2/ω1 = p/q in lowest terms.

    A bulk stress oscillates with the tangential load, B = B_m + B_A sin(pt + ψ_B).
    """
    p, q = frequency_ratio.numerator, frequency_ratio.denominator
    own = [(q, normal_amplitude, phase)], [(p, tangential_amplitude, 0.0)], [(p, bulk_amplitude, bulk_phase)]
    return harmonic_sum(*own, means=(1.0, 0.0, bulk_mean))


def harmonic_sum(normal, tangential, bulk=(), means=(0.0, 0.0, 0.0)):
    """Load of sums of harmonics, mean + Σ amplitude · sin(order · t + phase).

    Parameters
    ----------
    normal, tangential, bulk
        Rows of order, amplitude and phase of n, v and B.
    means
        The number that is added to each.
    """
    components = [
        [row for row in rows if row[0] > 0 and row[1] != 0.0] for rows in (normal, tangential, bulk)
    ]
    moving = sorted({row[0] for rows in components for row in rows})
    if len(moving) > MAX_HARMONICS:
        raise ValueError(f"a load of {len(moving)} harmonics: at most {MAX_HARMONICS}")
    common = reduce(gcd, moving, 0) or 1  # the cycle is run through so often in a period
    load = new_record(LOAD)
    load["period"], load["terms"], load["rounds"] = 2.0 * np.pi, len(moving), common
    load["order"][: len(moving)] = [order // common for order in moving]
    for component, rows in enumerate((normal, tangential, bulk)):
        load["rest"][component] = means[component]
        for order, amplitude, phase in rows:
            if order == 0:
                load["rest"][component] += amplitude * np.sin(phase)
            elif amplitude != 0.0:
                i = moving.index(order)
                load["cosine"][component, i] += amplitude * np.sin(phase)
                load["sine"][component, i] += amplitude * np.cos(phase)
    orders = [[row[0] // common for row in rows] for rows in components]
    load["bulk_moves"] = len(orders[2]) > 0
    load["fastest"] = max([1, *orders[0], *orders[1], *orders[2]])
    even, odd = (all(k % 2 == parity for k in orders[which]) for which, parity in ((0, 0), (1, 1)))
    load["mirrored"] = even and odd and not orders[2] and load["rest"][1] == 0.0
    if orders[2] and not orders[0]:
        t = even_instants(max(moving))
        load["bulk_slope"], load["bulk_exact"] = slope_of(*(sum_at(rows, t) for rows in components[1:]))
    for component, name, rows in ((0, "normal_range", normal), (BULK, "bulk_range", bulk)):
        load[name] = np.add(means[component], ends_of_sum(rows))
    return load


def polygon(normal, tangential, bulk=None, every=False):
    """Load along a closed polygon through vertices, each of shape (k,).

    Those on the straight line between their neighbours are left out, unless ``every`` one counts.
    """
    bulk = np.zeros(len(normal)) if bulk is None else bulk
    vertices = np.stack([normal, tangential, bulk], axis=1).astype(float)
    if not every:
        vertices = without_collinear(vertices)
    sides = len(vertices)
    if sides >= MAX_VERTICES:
        raise ValueError(f"a loop of {sides} vertices: at most {MAX_VERTICES - 1}")
    load = new_record(LOAD)
    load["sides"], load["period"], load["rounds"] = sides, sides, 1
    load["vertex"][:, :sides], load["vertex"][:, sides] = vertices.T, vertices[0]
    load["rest"] = vertices[0]
    load["normal_range"], load["bulk_range"] = (_ends(vertices[:, component]) for component in (0, BULK))
    load["bulk_moves"] = load["bulk_range"][0] < load["bulk_range"][1]
    if load["bulk_moves"] and load["normal_range"][0] == load["normal_range"][1]:
        load["bulk_slope"], load["bulk_exact"] = slope_of(*vertices.T[1:])
    half = np.roll(vertices, -(sides // 2), axis=0) * (1.0, -1.0, 1.0)
    load["mirrored"] = sides % 2 == 0 and not load["bulk_moves"] and np.array_equal(half, vertices)
    return load


def leave_bulk_out(load):
    """Take the bulk stress of the other body out of a load: it moves the stick zone, no more."""
    load["bulk_moves"], load["bulk_range"] = 0, 0.0
    for name in ("rest", "cosine", "sine", "vertex"):
        load[name][BULK] = 0.0


def _ends(values):
    return values.min(), values.max()


def prescribe(load, control, profile):
    """Note what of a load is prescribed, and map its normal load where both kinds are mixed.

    Parameters
    ----------
    load
        Record whose normal load is the prescribed one.
    control
        Whether the normal and the tangential load are forces; else displacements.
    profile
        Record in the kind of the normal load, up to its largest value; used where the kinds are mixed.
    """
    normal_force, tangential_force = control
    load["normal_force"], load["tangential_force"], load["map"] = normal_force, tangential_force, UNMAPPED
    if normal_force == tangential_force:
        return
    low, high = load["normal_range"]
    if load["sides"] and low < high:
        raise ValueError(
            "a loop whose normal load is not constant needs two displacements or two forces: "
            "with one of each its straight sides are curved in the memory diagram"
        )
    n = profile["exponent"]
    if n > 0.0:  # G = ξⁿ
        load["map"], load["map_power"] = BY_POWER, (n + 1.0) / n if tangential_force else n / (n + 1.0)
        load["waves"] = 0.0
    else:
        _tabulate(load, profile)
    load["normal_range"] = [mapped(load, float(each))[0] for each in (low, high)]
    if load["sides"]:
        load["vertex"][0, : load["sides"] + 1] = load["normal_range"][0]
        load["map"] = UNMAPPED


def _tabulate(load, profile):
    """Write the map as series on the panels of the profile, halved towards 0 and where it needs them."""
    largest = float(load["normal_range"][1])
    edges = profile["coordinate_begin"][: profile["panels"] + 1].copy()
    edges = np.append(edges[edges < largest], largest * (1.0 + 1e-9))
    first = POWER_LAW * edges[1]
    towards = first * 2.0 ** np.arange(0, np.log2(1.0 / POWER_LAW))
    edges = np.concatenate([towards, edges[1:]])
    lower, upper, done = edges[:-1], edges[1:], []
    for halved in range(HALVINGS + 1):
        x = lower[:, None] + 0.5 * (upper - lower)[:, None] * (_NODES + 1.0)
        series = _other_coordinate(profile, x) @ _SERIES.T
        size = np.abs(series)
        rough = size[:, -2:].max(axis=1) > TOLERANCE * size.max(axis=1) + ROUNDING
        rough &= halved < HALVINGS
        done.append((lower[~rough], upper[~rough], series[~rough]))
        middle = (0.5 * (lower + upper))[rough]
        lower, upper = np.concatenate([lower[rough], middle]), np.concatenate([middle, upper[rough]])
    begin, end, series = (np.concatenate(part) for part in zip(*done, strict=True))
    order = np.argsort(begin)
    count = len(order)
    if count + 1 >= MAX_MAP:
        raise ValueError(f"the map of the normal load needs {count} panels, more than {MAX_MAP - 2}")
    load["map"], load["map_panels"] = BY_SERIES, count + 1
    load["map_begin"][1 : count + 1], load["map_begin"][count + 1] = begin[order], end[order[-1]]
    load["map_series"][1 : count + 1] = series[order]
    x = first * np.array([[1.0, 1.001]])
    y = _other_coordinate(profile, x)[0]
    load["map_series"][0, 0] = y[0]
    load["map_power"] = np.log(y[1] / y[0]) / np.log(1.001)
    reach = float(profile["end"][profile["panels"] - 1])
    load["waves"] = max(reach / profile["longest"] - reach / 0.5, 0.0)


@jit
def _write_other(profile, places, out):
    """Write force at depths, or depth at forces, of a profile; ∫ dG/ds ds by Gauss's rule on each panel."""
    before, unit = np.zeros(profile.panels + 1), force_at(profile, place_of(profile, 1.0))
    for p in range(profile.panels if profile.in_force else 0):
        before[p + 1] = before[p] + rise(profile, profile.begin[p], profile.end[p])
    for i in range(places.shape[0]):
        s = place_of(profile, places[i])
        p = panel_of(profile.begin, 0, profile.panels, s)
        if profile.in_force:
            out[i] = before[p] + rise(profile, profile.begin[p], s)
        else:
            out[i] = force_at(profile, s) / unit


def _other_coordinate(profile, x):
    """Force at depths, or depth at forces, as the profile's coordinate is; array of any shape."""
    found = np.empty(x.size)
    _write_other(profile, x.ravel(), found)
    return found.reshape(x.shape)


@jit
def rise(profile, a, b):
    """∫ dG/ds ds from a to b within a panel."""
    total = 0.0
    for i in range(NODE.shape[0]):
        total += WEIGHT[i] * density_at(profile, a + 0.5 * (b - a) * (NODE[i] + 1.0))
    return 0.5 * (b - a) * total
