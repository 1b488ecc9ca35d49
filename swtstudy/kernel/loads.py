"""Loads as records, made in Python from what is prescribed."""

import numpy as np

from swtstudy.kernel.compiled import new_record
from swtstudy.kernel.load import BULK, LOAD


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
    load = new_record(LOAD)
    load["fastest"], load["period"] = max(p, q), 2.0 * np.pi
    load["rest"][0] = 1.0
    load["terms"] = 1 if p == q else 2
    own = load["terms"] - 1
    load["order"][:2] = q, p
    load["cosine"][0, 0] = normal_amplitude * np.sin(phase)
    load["sine"][0, 0] = normal_amplitude * np.cos(phase)
    load["sine"][1, own] = tangential_amplitude
    load["rest"][BULK] = bulk_mean
    load["cosine"][BULK, own] = bulk_amplitude * np.sin(bulk_phase)
    load["sine"][BULK, own] = bulk_amplitude * np.cos(bulk_phase)
    load["bulk_range"] = bulk_mean - bulk_amplitude, bulk_mean + bulk_amplitude
    load["bulk_moves"] = bulk_amplitude != 0.0
    load["bulk_turns"] = bulk_amplitude != 0.0 and tangential_amplitude == 0.0
    load["mirrored"] = q % 2 == 0 and bulk_amplitude == 0.0
    return load


def polygon(normal, tangential, bulk=None):
    """Load along a closed polygon through vertices, each of shape (k,)."""
    load = new_record(LOAD)
    sides = len(normal)
    load["sides"], load["period"] = sides, sides
    bulk = np.zeros(sides) if bulk is None else np.asarray(bulk, dtype=float)
    for component, values in enumerate((normal, tangential, bulk)):
        load["vertex"][component, :sides] = values
        load["vertex"][component, sides] = values[0]
    load["rest"][BULK] = bulk[0]
    load["bulk_range"] = bulk.min(), bulk.max()
    load["bulk_moves"] = bulk.min() < bulk.max()
    return load
