"""Where to look for the maximum of swt along the surface line.

swt(r) has cusps at known places: where the contact edge or a slip front is at the instants at which something
else changes. Between two of them it is smooth but for square roots at the ends and convex kinks, so cosine-
spaced positions resolve it, as cosine-spaced instants resolve the cycle.
"""

from __future__ import annotations

import numpy as np

from swtstudy.mechanics.contact.cycle import Cycle
from swtstudy.mechanics.control.coordinate import Coordinate
from swtstudy.mechanics.numerics.arrays import packed
from swtstudy.mechanics.points import FloatArray

#: The centre is left out, this share of the contact: swt is not largest there, but next to a sharp tip that
#: loses contact, where it may rise within any radius: there is no continuum that small.
INNERMOST = 1e-5
#: With a bulk stress tension is everywhere: under a flat face, and outside of the contact up to so many times
#: its largest radius, beyond which swt differs from that of the bulk stress alone by less than 1e-3 of its
#: difference at the edge.
BEYOND = np.array([1.5, 5.0, 40.0])
#: A face whose edge is singular is left out from this share of its radius on: there is no tension next to it.
BESIDE_FACE = 0.999


def cusps(cycle: Cycle, coordinate: Coordinate, everywhere: bool = False) -> FloatArray:
    """Radii at which swt(r) may have a cusp, and the ends of the range, ascending, shape (n, k).

    With ``everywhere`` the range is not the contact's but that of a bulk stress, see `BEYOND`.
    """
    n = len(cycle.begin)
    # Empty intervals, which fill up the rows of a batch, have nothing to say.
    lasts = cycle.end > cycle.begin
    starts = np.where(lasts[..., None], cycle.memory.start, np.inf).reshape(n, -1)
    edges = np.where(lasts, np.maximum(cycle.load.normal(cycle.begin), 0.0), 0.0)
    deepest = cycle.load.largest_normal[:, None]
    places = np.concatenate([deepest, edges, np.where(np.isfinite(starts), starts, 0.0)], axis=1)
    places = np.sort(places, axis=1)
    new = np.diff(places, axis=1, prepend=0.0) > 0.0
    new[:, -1] = True
    radius = coordinate.radius(packed(new, places)[0])
    largest = radius.max(axis=1, keepdims=True)
    profile = coordinate.profile
    approach, landmarks = profile.singular_approach, np.minimum(profile.landmarks, largest)
    face = profile.flat_radius[:, None]
    if everywhere:
        least = coordinate.radius(np.maximum(cycle.load.least_normal, 0.0)[:, None])
        # Next to the contact the stress outside changes over the way that the edge goes.
        beyond = largest + np.append(largest - least, largest * (BEYOND - 1.0), axis=1)
        innermost = INNERMOST * largest
        if approach.shape[1]:
            nearest = approach.min(axis=1, keepdims=True)
            innermost = np.where(nearest > 0.0, np.minimum(nearest, innermost), innermost)
            radius = np.where(radius <= face, BESIDE_FACE * face, radius)
            face = BESIDE_FACE * face
        ends = np.concatenate([0.0 * face, face, radius, approach, landmarks, beyond], axis=1)
        return np.sort(np.maximum(ends, innermost), axis=1)
    innermost = face + INNERMOST * (largest - face)
    if approach.shape[1]:
        nearest = approach.min(axis=1, keepdims=True)
        innermost = np.where(nearest > face, nearest, innermost)
    ends = np.concatenate([radius, innermost, approach, landmarks], axis=1)
    return np.sort(np.maximum(ends, innermost), axis=1)
