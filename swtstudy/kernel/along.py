"""The criterion along the surface line: where it exceeds a limit, and its plane at one place."""

from math import sqrt

from swtstudy.kernel.at_place import ASKED, MAX_SEEN, evaluate
from swtstudy.kernel.compiled import jit
from swtstudy.kernel.history import FIRST
from swtstudy.kernel.line import MAX_INTERVALS, MOST_POSITIONS, begin_search, bound_of, cut

#: A lower value may hide between two places, by this share of the values there.
MAPPED = 5e-3


@jit
def excess(S, k, limit):
    """Bound of interval k over its ends and the limit: 1 at most where nothing matters."""
    most = 0.0
    for side in range(2):
        known = (1.0 + MAPPED) * max(S.at_ends[k, 0, side], S.at_ends[k, 1, side])
        most = max(most, bound_of(S, k, side) / max(known, limit))
    return most


@jit
def map_line(S, H, W, C, R, P, K, L, Q, limit):
    """Halve the line until no interval hides anything that exceeds its ends or the limit; write it into S."""
    point = H, W, C, R, P, K, L, Q
    begin_search(S, point)
    while S.intervals + 2 <= MAX_INTERVALS and S.positions <= min(MOST_POSITIONS, MAX_SEEN - 1):
        k, most = FIRST, 0.0
        for i in range(S.intervals):
            hidden = excess(S, i, limit)
            if hidden > most:
                k, most = i, hidden
        if most <= 1.0:
            break
        cut(S, point, k, limit)


@jit
def plane_at(S, H, W, C, R, P, K, L, Q, largest, x):
    """2θ of the critical plane at a signed x."""
    S.best, S.positions, S.largest, b = 0.0, 0, largest, P.flat_radius
    place = sqrt(abs(x * x - b * b)) * (1.0 if abs(x) >= b else -1.0)
    evaluate(S, (H, W, C, R, P, K, L, Q), place, ASKED, ASKED)
    if L.mirrored:
        return S.seen_angle[0, 0] if x >= 0.0 else -S.seen_angle[0, 0]
    return S.seen_angle[0, 0 if x >= 0.0 else 1]
