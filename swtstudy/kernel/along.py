"""The criterion along the surface line: where it exceeds a limit, and its plane at one place."""

from math import sqrt

from swtstudy.kernel.at_place import ASKED, MAX_SEEN, evaluate
from swtstudy.kernel.compiled import jit
from swtstudy.kernel.history import FIRST
from swtstudy.kernel.line import MAX_INTERVALS, MOST_POSITIONS, begin_search, bound_of, cut

#: A lower value may hide between two places, by this share of the values there.
MAPPED = 5e-3


@jit
def excess(search, k, limit):
    """Bound of interval k over its ends and the limit: 1 at most where nothing matters."""
    most = 0.0
    for side in range(2):
        known = (1.0 + MAPPED) * max(search.at_ends[k, 0, side], search.at_ends[k, 1, side])
        most = max(most, bound_of(search, k, side) / max(known, limit))
    return most


@jit
def map_line(search, point, limit):
    """Halve the line until no interval of the search hides what exceeds its ends or the limit."""
    begin_search(search, point)
    while search.intervals + 2 <= MAX_INTERVALS and search.positions <= min(MOST_POSITIONS, MAX_SEEN - 1):
        k, most = FIRST, 0.0
        for i in range(search.intervals):
            hidden = excess(search, i, limit)
            if hidden > most:
                k, most = i, hidden
        if most <= 1.0:
            break
        cut(search, point, k, limit)


@jit
def plane_at(search, point, largest, x):
    """2θ of the critical plane at a signed x."""
    search.best, search.positions, search.largest, b = 0.0, 0, largest, point.profile.flat_radius
    place = sqrt(abs(x * x - b * b)) * (1.0 if abs(x) >= b else -1.0)
    evaluate(search, point, place, ASKED, ASKED)
    if point.load.mirrored:
        return search.seen_angle[0, 0] if x >= 0.0 else -search.seen_angle[0, 0]
    return search.seen_angle[0, 0 if x >= 0.0 else 1]
