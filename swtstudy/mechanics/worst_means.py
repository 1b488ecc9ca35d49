"""swt over critical distances, about whichever place of the surface line has most of it.

The critical point has the largest swt, but about another local maximum swt may fall off more slowly.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from swtstudy.mechanics.body.nonlocal_swt import NonlocalSwt, nonlocal_swt
from swtstudy.mechanics.line.candidates import SAME_MAXIMUM, candidates
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.stress.scene import Scene

#: Another place is worse from so much on, relative: it is not by noise that one of two is taken.
WORSE = 1e-4
#: What each place may be the worst of.
KINDS = ("volume", "point", "line")


def worst_means(
    scene: Scene, position: FloatArray, angle: FloatArray, distance: FloatArray, rtol: float = 1e-3
) -> NonlocalSwt:
    """The largest values over critical distances among those about the critical points and other maxima.

    Each kind, distance and direction has its own place. Another local maximum of swt along the line is tried
    if its swt is above one of the values found so far: no mean about it could be larger otherwise, but where
    what is nearby is higher, which is tried itself.

    Parameters
    ----------
    scene, position, angle, distance, rtol
        As of `nonlocal_swt`, with the critical points.
    """
    found = nonlocal_swt(scene, position, angle, distance, rtol)
    rows = np.flatnonzero(np.isfinite(position))
    if not rows.size:
        return found
    others = candidates(scene.take(rows), _least(found)[rows])
    near = SAME_MAXIMUM * scene.largest_radius
    for number, x, double_angle, swt in zip(*others, strict=True):
        row = rows[number : number + 1]
        if np.abs(x - position[row]) <= near[row] or swt <= _least(found)[row]:
            continue
        degrees = np.degrees(0.5 * double_angle)
        own = nonlocal_swt(scene.take(row), np.array([x]), np.array([degrees]), distance, rtol)
        found = _larger(found, int(row[0]), own)
    return found


def _least(found: NonlocalSwt) -> FloatArray:
    """The smallest of the values of n points, shape (n,)."""
    return np.concatenate(
        [getattr(found, kind).reshape(len(found.volume), -1) for kind in KINDS], axis=1
    ).min(axis=1)


def _larger(found: NonlocalSwt, row: int, other: NonlocalSwt) -> NonlocalSwt:
    """With the values of another place in a row, where they are larger."""
    changed = {}
    for kind in KINDS:
        worse = getattr(other, kind)[0] > (1.0 + WORSE) * getattr(found, kind)[row]
        for name in (kind, f"{kind}_error", f"{kind}_x"):
            values = getattr(found, name).copy()
            values[row] = np.where(worse, getattr(other, name)[0], values[row])
            changed[name] = values
    return replace(found, **changed)
