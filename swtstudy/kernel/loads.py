"""Loads as records, made in Python from what is prescribed."""

from functools import reduce
from math import gcd

import numpy as np

from swtstudy.kernel.compiled import new_record
from swtstudy.kernel.load import BULK, LOAD, MAX_HARMONICS, MAX_VERTICES
from swtstudy.kernel.loops import ends_of_sum, even_instants, slope_of, sum_at, without_collinear


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
