"""swt at positions of the surface line on many planes, to the accuracy of a first look."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from swtstudy.mechanics.line.look import Look, Resolution, reach
from swtstudy.mechanics.planes.through_y import PlaneHistory, coarse_swt
from swtstudy.mechanics.points import BoolArray, FloatArray, Rows
from swtstudy.mechanics.stress.scene import Scene

#: Share of the largest swt that planes and instants may leave unseen, and what they may elsewhere.
SHARE, CLOSE_SHARE = 0.05, 0.01


@dataclass(frozen=True)
class Seen(Rows):
    """swt at positions of the line to the accuracy of a first look, (…, 2), or (…, 1) where sides are alike.

    Attributes
    ----------
    swt, double_angle
        At x = +r and x = −r, and 2θ of the best planes in rad.
    highest
        How high swt on these planes may really be between the instants.
    """

    swt: FloatArray
    double_angle: FloatArray
    highest: FloatArray


def first_look(scene: Scene, position: FloatArray, resolution: Resolution, planes: int) -> Seen:
    """Look at positions r = |x|, shape (n, X), on both sides of n contacts, on so many planes."""
    # Half of the period is enough where the other half is its mirror image.
    mirrored = scene.mirrored_half
    cycle = scene.cycle.first_half() if mirrored else scene.cycle
    look = Look.at(replace(scene, cycle=cycle), position, resolution.nodes, resolution.digits)
    history, inside = look.history, look.inside
    if mirrored:
        # The same instants with the tangential load reversed.
        history = history.followed_by(history.with_tangential_sign(-1.0))
        inside = np.concatenate([inside, inside], axis=-1)
    signs = (1.0,) if mirrored else (1.0, -1.0)
    sides = [_seen(scene.planes(history, sign), inside, planes) for sign in signs]
    return Seen(*(np.stack(both, axis=-1) for both in zip(*sides, strict=True)))


def _seen(planes: PlaneHistory, inside: BoolArray, count: int) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Values of `Seen` for one side, each (n, X)."""
    swt, angle = coarse_swt(planes, count)
    highest = swt.copy()
    at = np.nonzero(swt >= (1.0 - 3.0 * SHARE) * swt.max(axis=1, keepdims=True))
    some = planes.take(*at)
    of_swt = some.criterion.curves(*some.on_plane(angle[at]))
    highest[at] = some.criterion.of_maxima(*(reach(curve, inside[at]) for curve in of_swt))
    return swt, angle, highest
