"""Cusps of the criterion along the surface line: the ends of the pieces on which it is smooth.

A place has one where the edge of the contact, a slip front or the growth turns, at the edge of a face, where
a stick zone ends, and at a kink of a table.
"""

from math import exp, sqrt

import numpy as np

from swtstudy.kernel import INNERMOST
from swtstudy.kernel.compiled import jit
from swtstudy.kernel.contact import MAX_STRETCHES
from swtstudy.kernel.criterion import SWT
from swtstudy.kernel.load import distinct, has_bulk
from swtstudy.kernel.profile import place_of
from swtstudy.kernel.shift import centre_of

#: Ends of pieces outside of the contact, in its radii: so many first ones without a stress that reaches far.
BEYOND, NEARBY = np.array([1.3, 4.0, 12.0, 40.0]), np.int64(2)
#: Friction from which a contact may have its maximum at the singular edge of a face.
TEARING = 0.8
#: With more than twice as many pieces these are looked at in so many groups at first.
GROUPS = 48


@jit
def cusps(search, cycle, profile, load, ask, largest):
    """Write the sorted ends of the pieces of the line, places s; returns how many."""
    z, b = search.cusp, profile.flat_radius
    radius = sqrt(b * b + largest * largest)
    m = put(z, 0, INNERMOST * largest)
    if profile.singular and ask.friction >= TEARING:
        # With L = ln(b/(|x| - b)) the strain rises like L and σ_n falls like (1 - μ) L, to 0 at the last one.
        L_edge = 4.0
        while L_edge < min(20.0 * (1.0 + radius / b) / max(1.0 - ask.friction, 1e-2), 600.0):
            m = put(z, m, b * sqrt(2.0) * exp(-0.5 * L_edge))
            L_edge *= 2.0
    # Places in mere pressure, and far outside of the contact.
    anywhere = ask.criterion != SWT or has_bulk(load)
    if anywhere and b > 0.0:
        m = put(z, m, -b * (1.0 - INNERMOST))
    if anywhere:
        m = put(z, m, 2.0 * largest - place_of(profile, cycle.smallest))
    for k in range(BEYOND.shape[0] if anywhere else NEARBY):
        m = put(z, m, sqrt(BEYOND[k] * BEYOND[k] * radius * radius - b * b))
    for j in range(1, min(int(largest / profile.longest) + 1, MAX_STRETCHES)):  # half waves of the profile
        m = put(z, m, j * profile.longest)
    for k in range(profile.kinks):  # logarithmic peaks of the pressure
        if profile.kink[k, 1] < largest:
            for e in range(3):
                m = put(z, m, profile.kink[k, e])
    for k in range(cycle.stretches):
        for e in range(2):
            for G in (cycle.edge[k, e], cycle.front[k, e]):
                if G > 0.0:
                    m = put_zone(z, m, cycle, profile, largest, place_of(profile, G))
    for i in range(cycle.pieces):
        if cycle.used[i] and cycle.start_s[i] > 0.0:
            m = put_zone(z, m, cycle, profile, largest, cycle.start_s[i])
    return distinct(z, m, 1e-14 * largest)


@jit
def put_zone(z, m, cycle, profile, largest, s):
    """Append the end of a stick zone of size s, or both ends if its centre is not the contact's."""
    off = abs(centre_of(profile, cycle.shift, cycle.largest, largest, s))
    m = put(z, m, s + off)
    return put(z, m, max(abs(s - off), INNERMOST * largest)) if off > 0.0 else m


@jit
def put(z, m, value):
    """Append a value to the first m of z, if there is room; returns how many there are now."""
    if m < z.shape[0]:
        z[m] = value
    return min(m + 1, z.shape[0])


@jit
def ends_group(search, j, last, largest):
    """True if cusp j of last + 1 ends a group of pieces: each if there are few, or a long piece ends."""
    step = max(last // GROUPS, 1) if last > 2 * GROUPS else 1
    gap = max(search.cusp[min(j + 1, last)] - search.cusp[j], search.cusp[j] - search.cusp[max(j - 1, 0)])
    return j % step == 0 or j == last or GROUPS * gap > largest
