"""The largest value of the criterion along the surface line y = 0.

Positions are places s = √(x² - b²) on the profile, in which roots at the edge of a face are smooth, and
-√(b² - x²) under the face. The value, here swt, is a maximum over planes and instants of smooth functions, so
that its kinks point down and only downward curvature can hide a higher one between two places: on an interval
of width w,

    swt ≤ chord + K (s - s₁)(s₂ - s)/2,   K ≥ -swt″.

Pieces of the line end at its cusps, the places where the edge, a slip front or the growth turns. On a piece,
an angle makes root cusps at its ends smooth. The interval with the highest bound is halved until no bound
exceeds the best value by more than the tolerance; what is left is the error.
"""

from math import cos, pi, sqrt

import numpy as np

from swtstudy.kernel import INNERMOST
from swtstudy.kernel.at_place import ASKED, MAX_SEEN, RULED_OUT, evaluate
from swtstudy.kernel.compiled import fields, jit
from swtstudy.kernel.contact import MAX_STRETCHES, NONE
from swtstudy.kernel.criterion import SWT
from swtstudy.kernel.cusps import GROUPS, cusps, ends_group
from swtstudy.kernel.history import FIRST, is_sharp
from swtstudy.kernel.planes import above
from swtstudy.kernel.profile import place_of

MAX_INTERVALS = 65_543
#: A search ends after so many positions.
MOST_POSITIONS = 20_000
#: After so many positions the search asks whether what is left is rounding.
MANY = 500
#: Rounding of values raises the bound of an interval by this times itself at most: the ends are off by once,
#: and an eighth of `TRUST` times a third difference by 2.25 and of a second one by half.
OF_BOUND = 4.0
#: Rounding of the distance of two slip fronts over the largest contact.
OF_DISTANCE = 1e-13
#: Rounding of the pressure next to an edge, of which it is the root: the edge's own is some 4e-16. An edge
#: that rests has none where its place is known in closed form.
OF_PRESSURE = 3e-8
SEARCH = np.dtype(
    [
        ("cusp", "f8", (14 * MAX_STRETCHES,)),
        ("last", "i8"),  # number of the last cusp
        ("positions", "i8"),  # that have been evaluated
        *fields("f8", "smallest largest"),  # places s of the smallest and the largest contact
        ("singular", "i8"),  # 1: the face's edge is singular
        ("crowd", "f8"),  # length over which many cusps are spread; 0 if there are few
        *fields("f8", "best place sign angle"),  # the largest value, its place s, the sign of x, and 2θ
        ("tension", "f8"),  # the smaller one of largest σ_n and half the range of the swing, where they count
        ("pressure", "f8"),  # the largest one there
        ("value", "f8", (2,)),  # at the last position, on both sides
        ("seen", "f8", (MAX_SEEN,)),  # places of the positions, in the order of the search
        *fields("f8", "seen_value seen_angle", (MAX_SEEN, 2)),  # values and 2θ there; -1 where not asked for
        ("intervals", "i8"),
        *fields("f8", "ends piece", (MAX_INTERVALS, 2)),  # ends in angles on the piece, ends of the piece
        ("beside", "f8", (MAX_INTERVALS, 2)),  # lengths of the pieces beside it
        ("cusps", "i8", (MAX_INTERVALS, 2)),  # a group of pieces: its first and last cusp; 0, 0 if it is none
        ("at_ends", "f8", (MAX_INTERVALS, 2, 2)),  # values at both ends, on both sides
        ("upper", "i8", (MAX_INTERVALS,)),  # 1: the upper half of what was halved
        ("unseen", "i8", (MAX_INTERVALS,)),  # 1: a piece on which the growth may turn, without a value within
        ("beyond", "f8", (MAX_INTERVALS, 2)),  # value at the other end of the other half
        ("drop", "f8", (MAX_INTERVALS, 2)),  # K w² on both sides
        # The bound; and among many cusps the relative rise over the root of the length.
        *fields("f8", "bound rise", (MAX_INTERVALS,)),
    ]
)
#: Places next to a sharp tip at first.
TIP = np.int64(8)
#: Bound of K w² of a piece of the line at first, in its values or their range; of twice the third difference
#: later on: that may change the second difference by four times as much.
TRUST = 8.0
#: Share of the bound of K w² of an interval that its halves keep, whatever they show.
MEMORY = 0.25
#: Wider pieces, as a share of the largest contact, may have a turn of the growth within.
NARROW = 1e-3
#: Values within a width w of many cusps, spread over d, are higher than at its ends by this times √(w/d) at
#: most, and by this times what is seen in a group.
RISE = 4.0
#: Cusps above this share of the best value are looked beside, up to where the value is so near to that at the
#: cusp, as a share of the tolerance; nowhere nearer than in this angle.
HIGH, BESIDE, FINEST_ANGLE = 0.99, 0.25, 1e-6
#: Largest ratio of the lengths of two pieces beside each other, where it matters, and of the ends of a piece
#: next to a singular edge that is not spaced in ln s.
GRADED = 20.0


@jit
def bound_of(search, k, side):
    """Bound of interval k on one side."""
    f1, f2, drop = search.at_ends[k, 0, side], search.at_ends[k, 1, side], search.drop[k, side]
    if search.unseen[k] and max(f1, f2) > RULED_OUT:
        return 1e300
    if search.crowd > 0.0 and search.ends[k, 1] - search.ends[k, 0] > 3.0:
        return max(f1, f2) + 0.125 * drop
    return above(f1, f2, drop)


@jit
def set_bound(search, k):
    """Bound of interval k over both sides."""
    search.bound[k] = max(bound_of(search, k, 0), bound_of(search, k, 1))


@jit
def position(search, k, angle):
    """Place at an angle on the piece of interval k."""
    left, right = search.piece[k, 0], search.piece[k, 1]
    share = 0.5 - 0.5 * cos(angle)
    if search.singular and left > 0.0 and right > GRADED * left:
        return left * (right / left) ** share
    return left + (right - left) * share


@jit
def set_piece(search, k, left, right):
    """Make interval k a whole piece from left to right, between whose values the trust is a bound."""
    search.piece[k, 0], search.piece[k, 1], search.ends[k, 0], search.ends[k, 1] = left, right, 0.0, pi
    search.upper[k] = 0
    trust = TRUST
    if search.crowd > 0.0:  # roots of distances within the piece
        trust *= min(1.0, search.rise[k] * sqrt((right - left) / search.crowd))
    for side in range(2):
        search.drop[k, side] = trust * max(search.at_ends[k, 0, side], search.at_ends[k, 1, side])
    set_bound(search, k)


@jit
def set_group(search, k, first, last, load):
    """Make interval k the pieces between two cusps: a group, or a piece if there is but one."""
    left, right = search.cusp[first], search.cusp[last]
    search.cusps[k, 0], search.cusps[k, 1] = (first, last) if last > first + 1 else (0, 0)
    search.unseen[k] = 0
    if last == first + 1:
        inside = left >= search.smallest * (1.0 - 1e-9) and right <= search.largest * (1.0 + 1e-9)
        search.unseen[k] = load.sides == 0 and inside and right - left > NARROW * search.largest
        search.beside[k, 0] = left - search.cusp[first - 1] if first > 0 else right - left
        search.beside[k, 1] = search.cusp[last + 1] - right if last < search.last else right
    set_piece(search, k, left, right)


@jit
def grade(search, point, k):
    """Cut interval k beside much shorter pieces, where the value may be the largest.

    The cusps at the other end of a short piece are close to this one, too. A piece that is at most GRADED
    times as long as its neighbour has them at some distance, in its angle. New intervals are the last ones.
    """
    near, new = point.ask.near * search.best, search.intervals
    while k < search.intervals and search.intervals + 1 < MAX_INTERVALS and search.cusps[k, 1] == 0:
        cut = False
        for end in range(2):
            length, f = search.piece[k, 1] - search.piece[k, 0], search.at_ends[k]
            if length <= 2.0 * GRADED * search.beside[k, end] or max(f[end, 0], f[end, 1]) < near:
                continue
            step, m = GRADED * search.beside[k, end], search.intervals
            x = search.piece[k, 1] - step if end else search.piece[k, 0] + step
            evaluate(search, point, x, max(f[0, 0], f[1, 0]) > RULED_OUT, max(f[0, 1], f[1, 1]) > RULED_OUT)
            near, outer = point.ask.near * search.best, search.piece[k, end]
            for side in range(2):
                search.at_ends[m, end, side] = f[end, side]
                search.at_ends[m, 1 - end, side] = search.value[side]
                f[end, side] = search.value[side]
            search.beside[m, end], search.beside[m, 1 - end] = search.beside[k, end], length - step
            search.beside[k, end] = step
            search.unseen[m], search.rise[m] = search.unseen[k], search.rise[k]
            search.cusps[m, 0], search.cusps[m, 1] = 0, 0
            set_piece(search, m, x if end else outer, outer if end else x)
            set_piece(search, k, search.piece[k, 0] if end else x, x if end else search.piece[k, 1])
            search.intervals += 1
            cut = True
        if not cut:
            k = max(k + 1, new)


@jit
def divide(search, point, k, limit):
    """Divide the group of pieces k at its middle cusp. A side without a value above the limit is left out."""
    first, last, m, load = search.cusps[k, 0], search.cusps[k, 1], search.intervals, point.load
    middle = (first + last) // 2
    plus, minus = bound_of(search, k, 0) > limit, bound_of(search, k, 1) > limit
    evaluate(search, point, search.cusp[middle], plus, minus)
    left, right, seen = search.piece[k, 0], search.piece[k, 1], 0.0
    share = (search.cusp[middle] - left) / (right - left)
    for side in range(2):
        f1, f2, f = search.at_ends[k, 0, side], search.at_ends[k, 1, side], search.value[side]
        if plus if side == 0 else minus:
            seen = max(seen, abs(f - f1 - share * (f2 - f1)) / max(f1, f2, f))
        else:
            f1, f2 = RULED_OUT, RULED_OUT
        search.at_ends[k, 0, side], search.at_ends[k, 1, side] = f1, search.value[side]
        search.at_ends[m, 0, side], search.at_ends[m, 1, side] = search.value[side], f2
    seen *= RISE * sqrt(search.crowd / (right - left))
    search.rise[k] = search.rise[m] = min(max(seen, MEMORY * search.rise[k]), RISE)
    set_group(search, k, first, middle, load)
    set_group(search, m, middle, last, load)
    search.intervals += 1
    grade(search, point, k)
    grade(search, point, m)


@jit
def evaluate_cusp(search, point, i, count):
    """Evaluate the cusp at which group i of count - 1 begins, and the one before ends."""
    evaluate(search, point, search.cusp[search.cusps[i, 0]], ASKED, ASKED)
    for side in range(2):
        if i > 0:
            search.at_ends[i - 1, 1, side] = search.value[side]
        search.at_ends[i, 0, side] = search.value[side]


@jit
def first_intervals(search, point):
    """Evaluate cusps and make intervals of the pieces between them, and groups if there are many."""
    search.crowd, search.intervals, load = 0.0, 0, point.load
    if search.last > 2 * GROUPS:
        k = 0
        while search.cusp[k] < 0.5 * search.smallest:
            k += 1
        search.crowd = max(search.largest - search.cusp[k], 1e-6 * search.largest)
    count = 0  # of cusps that begin a group, or end the last one
    for j in range(search.last + 1):
        if ends_group(search, j, search.last, search.largest):
            search.cusps[count, 0] = j
            count += 1
    step = 1
    while step < count:
        step *= 2
    # Scattered: a value that is the largest so far is looked at closely, of a rising row each.
    while step > 1:
        for i in range(step // 2, count, step):
            evaluate_cusp(search, point, i, count)
        step //= 2
    # The centre is the last one: its value may be next to 0, and while it is the largest all planes matter.
    evaluate_cusp(search, point, FIRST, count)
    for k in range(count - 1):
        search.rise[k] = RISE
        set_group(search, k, search.cusps[k, 0], search.cusps[k + 1, 0], load)
    search.intervals = count - 1
    for k in range(search.intervals):
        grade(search, point, k)


@jit
def begin_search(search, point):
    """Make the first intervals of the line."""
    load, profile, ask, cycle = point.load, point.profile, point.ask, point.cycle
    search.smallest, search.largest = place_of(profile, cycle.smallest), place_of(profile, cycle.largest)
    search.last = cusps(search, cycle, profile, load, ask, search.largest) - 1
    search.best, search.place, search.sign, search.angle, search.tension = 0.0, 0.0, 1.0, 0.0, 0.0
    search.pressure, search.positions, search.singular = 0.0, 0, profile.singular
    first_intervals(search, point)


@jit
def search_tip(search, point):
    """Search next to a sharp tip, where the stress is linear in x^m: evenly spaced, then uphill.

    A maximum changes by the square of a distance from it, so the last step follows from the tolerance.
    """
    profile, ask = point.profile, point.ask
    power, best, at, step = 1.0 / (profile.exponent - 1.0), -1.0, 0.0, 1.0 / TIP
    for j in range(TIP):
        evaluate(search, point, INNERMOST * search.largest * (j * step) ** power, ASKED, ASKED)
        if max(search.value[0], search.value[1]) > best:
            best, at = max(search.value[0], search.value[1]), j * step
    while best >= ask.near * search.best and step > 0.1 * sqrt(ask.line):
        step *= 0.5
        for other in (at - step, at + step):
            if 0.0 <= other < 1.0:
                evaluate(search, point, INNERMOST * search.largest * other**power, ASKED, ASKED)
                if max(search.value[0], search.value[1]) > best:
                    best, at = max(search.value[0], search.value[1]), other


@jit
def rounding_beside(cycle, profile, ask, distance, tension):
    """Largest stress that rounding makes at a distance from a turning edge or slip front, over the tension.

    Shear tractions, over μ, go like the root of the distance, which is one over the largest contact.
    """
    root = sqrt(distance + OF_DISTANCE) - sqrt(max(distance - OF_DISTANCE, 0.0))
    of_pressure = OF_PRESSURE if cycle.largest > cycle.smallest or not profile.is_hertz else 0.0
    return (ask.friction * sqrt(2.0) * root + of_pressure) * sqrt(cycle.largest) / tension


@jit
def is_rounding(search, point, k, limit):
    """True if in a long search rounding alone may raise the bound of interval k above the limit."""
    if search.positions < MANY or search.cusps[k, 1] > 0 or search.tension <= 0.0:
        return False
    middle = position(search, k, 0.5 * (search.ends[k, 0] + search.ends[k, 1]))
    distance = min(middle - search.piece[k, 0], search.piece[k, 1] - middle) / search.largest
    rounding = rounding_beside(point.cycle, point.profile, point.ask, distance, search.tension)
    return search.bound[k] <= limit + OF_BOUND * rounding * search.best


@jit
def search_line(search, point):
    """Find the largest swt on the line; returns by how much a higher one may be hidden.

    Parameters
    ----------
    search
        Record of `SEARCH` after `begin_search`.
    point
        `swtstudy.kernel.records.Point`.
    """
    profile, load, ask = point.profile, point.load, point.ask
    if is_sharp(profile):
        search_tip(search, point)
    while True:
        k, limit = highest_bound(search), search.best * (1.0 + ask.line)
        if search.bound[k] <= limit:
            share_curvature(search)
            if load.sides > 0 and (load.bulk_moves or ask.criterion != SWT):
                look_beside_cusps(search, limit)
            k = highest_bound(search)
        full = search.intervals + 2 > MAX_INTERVALS or search.positions > MOST_POSITIONS
        if search.bound[k] <= limit or full or is_rounding(search, point, k, limit):
            return max(search.bound[k] - search.best, 0.0)
        cut(search, point, k, limit)


@jit
def highest_bound(search):
    """The interval with the highest bound."""
    highest = FIRST
    for k in range(search.intervals):
        if search.bound[k] > search.bound[highest]:
            highest = k
    return highest


@jit
def share_curvature(search):
    """Give the two intervals that meet at the best place the curvature through their three values.

    A narrow interval shows a curvature that the wide one beside it has not met.
    """
    left, right, side = NONE, NONE, 0 if search.sign > 0.0 else 1
    for k in range(search.intervals):
        if search.cusps[k, 1] == 0 and search.piece[k, 0] < search.place < search.piece[k, 1]:
            if position(search, k, search.ends[k, 1]) == search.place:
                left = k
            elif position(search, k, search.ends[k, 0]) == search.place:
                right = k
    if left == NONE or right == NONE:
        return
    before, after = search.ends[left, 1] - search.ends[left, 0], search.ends[right, 1] - search.ends[right, 0]
    rise, fall = search.best - search.at_ends[left, 0, side], search.best - search.at_ends[right, 1, side]
    curvature = 2.0 * (rise / before + fall / after) / (before + after)
    search.drop[left, side] = max(search.drop[left, side], curvature * before * before)
    search.drop[right, side] = max(search.drop[right, side], curvature * after * after)
    set_bound(search, left)
    set_bound(search, right)


@jit
def look_beside_cusps(search, limit):
    """Have intervals halved in which the value falls from a high cusp by more than the tolerance.

    At a vertex of the load the bulk stress may fall at once while slip begins, whose tension rises like a
    root; so may the shear stress of the pressure. The sum has a peak beside the cusp, as narrow as the square
    of the friction: no value farther away shows it.
    """
    for k in range(search.intervals):
        if search.cusps[k, 1] > 0 or search.ends[k, 1] - search.ends[k, 0] < FINEST_ANGLE:
            continue
        for end in range(2):
            if search.ends[k, end] != (0.0 if end == 0 else pi):
                continue
            for side in range(2):
                f = search.at_ends[k, end, side]
                fall = f - search.at_ends[k, 1 - end, side]
                if f > HIGH * search.best and fall > BESIDE * (limit - search.best):
                    drop = 8.0 * (limit - f) + 4.0 * fall  # a bound above
                    search.drop[k, side] = max(search.drop[k, side], drop)
                    set_bound(search, k)


@jit
def cut(search, point, k, limit):
    """Cut interval k in two, be it a group of pieces or not; below the limit nothing matters."""
    if search.cusps[k, 1] > 0:
        divide(search, point, k, limit)
    else:
        halve(search, point, k, limit)


@jit
def drop_of_half(f1, f2, f, upper, beyond, before):
    """K w² of the halves of an interval, from its values and its own K w².

    Curvature follows from the second difference, and from how far the new value is off the parabola through
    the three values before: four times that distance is what a third derivative changes in the drop.

    Parameters
    ----------
    f1, f2, f
        Values at the ends and in the middle.
    upper
        1 if the interval is the upper half of what was halved.
    beyond
        Value at the other end of its other half.
    before
        K w² of the interval.
    """
    near, far = (f1, f2) if upper else (f2, f1)
    expected = 0.125 * (3.0 * far + 6.0 * near - beyond)
    drop = max(2.0 * f - f1 - f2, 0.0) + TRUST * abs(f - expected)
    return max(drop, MEMORY * before)


@jit
def halve(search, point, k, limit):
    """Halve interval k. Its upper half becomes the last interval."""
    middle, m = 0.5 * (search.ends[k, 0] + search.ends[k, 1]), search.intervals
    whole = search.ends[k, 1] - search.ends[k, 0] > 3.0
    plus, minus = bound_of(search, k, 0) > limit, bound_of(search, k, 1) > limit
    evaluate(search, point, position(search, k, middle), plus, minus)
    search.intervals += 1
    search.piece[m, 0], search.piece[m, 1] = search.piece[k, 0], search.piece[k, 1]
    search.ends[m, 0], search.ends[m, 1], search.ends[k, 1] = middle, search.ends[k, 1], middle
    # On a piece on which the growth may turn, values at three places within tell what the first one does not.
    unseen = 1 if whole and search.unseen[k] else 0
    search.unseen[k], search.unseen[m], search.cusps[m, 0], search.cusps[m, 1] = unseen, unseen, 0, 0
    upper = search.upper[k]
    search.upper[k], search.upper[m] = 0, 1
    for side in range(2):
        f1, f2, f = search.at_ends[k, 0, side], search.at_ends[k, 1, side], search.value[side]
        if (side == 0 and plus) or (side == 1 and minus):
            if whole:
                drop = max(2.0 * f - f1 - f2, TRUST * (max(f1, f2, f) - min(f1, f2, f)))
            else:
                drop = drop_of_half(f1, f2, f, upper, search.beyond[k, side], search.drop[k, side])
        else:
            f1, f2, drop = RULED_OUT, RULED_OUT, 0.0
        search.at_ends[k, 0, side], search.at_ends[k, 1, side], search.beyond[k, side] = f1, f, f2
        search.at_ends[m, 0, side], search.at_ends[m, 1, side], search.beyond[m, side] = f, f2, f1
        search.drop[k, side] = search.drop[m, side] = drop
    set_bound(search, k)
    set_bound(search, m)
