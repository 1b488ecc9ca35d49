"""The stationary load cycle of the contact, in the coordinate of the memory diagram alone.

The spring at coordinate G has the offset o = u - τ, the displacement at which it would be free. Friction
(|τ| ≤ w) keeps it within

    α + G ≤ o ≤ β - G,    α = v - n,  β = v + n,

so that α pushes o up where one way slips, β pushes it down where the other way slips, and new ground gets
o = v. At each instant the diagram o(G) is a stack of few pieces from the centre to the edge G = n:

    LINE  o = level + slope · G: slope 0 without slip, 1 along α_k + G, -1 along β_k - G, dv/dn where both
          loads grew in proportion
    GROWN o = v(t′) with n(t′) = G

Each piece knows the piece beneath it, so that one tree of pieces holds the diagrams of all instants. Between
events the state is smooth: a stretch of time in which the edge moves, and perhaps one slip front.
"""

import numpy as np

from swtstudy.kernel.chebyshev import FINEST
from swtstudy.kernel.compiled import fields, jit
from swtstudy.kernel.events import out_of_equilibrium, turning_points
from swtstudy.kernel.load import DIFFERENCE, NORMAL, SUM, instant_of, load_at, rates_at

LINE, GROWN = 0, 1
#: No piece: beneath the lowest one, and where the whole contact slips.
NONE = -1
#: Slopes of pieces.
FLAT, ALONG_ALPHA, ALONG_BETA = np.array([0.0, 1.0, -1.0])
#: Drive of the springs in a stretch: α, β, nothing (stick), or no contact.
ALPHA, STICK, BETA, OPEN = 1, 0, -1, 2

MAX_PIECES, MAX_STRETCHES, MAX_EVENTS = 8190, 8190, 6151
CYCLE = np.dtype(
    [
        *fields("i8", "pieces stretches events"),
        ("overflow", "i8"),  # 1: more pieces or stretches than there is room for
        ("no_equilibrium", "i8"),  # 1: there is no cycle
        ("may_slide", "i8"),  # 1: the whole contact slips, or parts
        *fields("i8", "gross_slip lift_off any_slip"),
        *fields("f8", "largest smallest"),  # coordinate of the edge
        ("shift", "f8"),  # of the stick zone, see `swtstudy.kernel.shift`
        ("event", "f8", (MAX_EVENTS,)),
        *fields("i8", "beneath kind", (MAX_PIECES,)),
        ("used", "i8", (MAX_PIECES,)),  # 1: in the diagram at some instant of the cycle
        *fields("f8", "level slope", (MAX_PIECES,)),  # of a LINE; else the slope is 0
        ("born", "f8", (MAX_PIECES, 2)),  # GROWN: the time it grew in
        *fields("f8", "start start_s", (MAX_PIECES,)),  # coordinate and place of the lower end
        ("time", "f8", (MAX_STRETCHES, 2)),  # begin and end of the stretches
        ("piece", "i8", (MAX_STRETCHES,)),  # the piece that holds the front
        ("push", "i8", (MAX_STRETCHES,)),  # ALPHA, BETA, STICK or OPEN
        # Coordinates of the edge, and of the front, or of the edge in stick, at both ends.
        *fields("f8", "edge front", (MAX_STRETCHES, 2)),
        ("intervals", "i8", (MAX_STRETCHES,)),  # between the instants whose places are known
        ("interpolated", "i8", (MAX_STRETCHES,)),  # 1: places at any instant follow from these
        ("place", "f8", (MAX_STRETCHES, FINEST + 1, 2)),  # s of edge and front at Lobatto points of time
    ]
)
#: If unloading retraces growth this closely, nothing slips: v - o(n) is rounding.
RETRACED = 1e-12
#: No stretch of time is shorter.
SHORTEST = 1e-13


@jit
def offset(cycle, load, i, G):
    """o(G) on piece i."""
    if cycle.kind[i] == GROWN:
        return load_at(load, instant_of(load, NORMAL, G, cycle.born[i, 0], cycle.born[i, 1]))[1]
    return cycle.level[i] + cycle.slope[i] * G


@jit
def front_on(cycle, load, i, push, level, top):
    """Coordinate on piece i, up to top, where o - G = α (push ALPHA) or o + G = β (push BETA).

    On a GROWN piece o - G was α, and o + G was β, when the ground at G touched.
    """
    if cycle.kind[i] == GROWN:
        which = DIFFERENCE if push == ALPHA else SUM
        G = load_at(load, instant_of(load, which, level, cycle.born[i, 0], cycle.born[i, 1]))[0]
    elif cycle.slope[i] != push:
        G = (level - cycle.level[i]) / (cycle.slope[i] - push)
    else:
        G = top  # the whole piece slips at once, when its level is reached
    return min(max(G, cycle.start[i]), top)


@jit
def add_piece(cycle, beneath, slope, level, start):
    """Index of a new piece, a LINE."""
    i = cycle.pieces
    if i + 1 >= MAX_PIECES:
        cycle.overflow = 1
        return i
    cycle.pieces += 1
    cycle.beneath[i], cycle.kind[i], cycle.level[i], cycle.slope[i] = beneath, LINE, level, slope
    cycle.start[i], cycle.used[i] = start, 0
    return i


@jit
def add_stretch(cycle, begin, end, piece, push, edge_begin, edge_end, front_begin, front_end):
    """Append a smooth stretch of time."""
    k = cycle.stretches
    if k + 1 >= MAX_STRETCHES:
        cycle.overflow = 1
        return
    cycle.stretches += 1
    cycle.piece[k], cycle.push[k] = piece, push
    cycle.time[k, 0], cycle.time[k, 1] = begin, end
    cycle.edge[k, 0], cycle.edge[k, 1] = edge_begin, edge_end
    cycle.front[k, 0], cycle.front[k, 1] = front_begin, front_end


@jit
def first_diagram(cycle, load, events, m):
    """Event at which the cycle starts, and the diagram there.

    At the instant where α is largest, every spring that ever slips has just been pushed up, o = α_max + G,
    and a spring that never slips has o = clip(0, α_max + G, β_min - G). From here one cycle is the stationary
    one, exactly. A contact that lifts off remembers nothing.
    """
    largest, alpha_max, beta_min, cycle.may_slide = 0, -1e300, 1e300, 1
    for i in range(m - 1):
        n, v = load_at(load, events[i])
        if load_at(load, 0.5 * (events[i] + events[i + 1]))[0] < 0.0:
            return i, add_piece(cycle, NONE, FLAT, v, 0.0)
        if v - n > alpha_max:
            alpha_max, largest = v - n, i
        beta_min = min(beta_min, v + n)
    cycle.may_slide = alpha_max > beta_min + RETRACED  # more than by rounding
    if alpha_max >= beta_min:  # gross slip
        return largest, add_piece(cycle, NONE, ALONG_ALPHA, alpha_max, 0.0)
    n = load_at(load, events[largest])[0]
    top, start = NONE, 0.0
    if beta_min < 0.0:  # at the centre o = β_min - G
        top, start = add_piece(cycle, NONE, ALONG_BETA, beta_min, 0.0), 0.5 * (beta_min - alpha_max)
    elif alpha_max < 0.0:  # at the centre o = 0
        top, start = add_piece(cycle, NONE, FLAT, 0.0, 0.0), -alpha_max
        if beta_min < -alpha_max:
            top, start = add_piece(cycle, top, ALONG_BETA, beta_min, beta_min), 0.5 * (beta_min - alpha_max)
    if start < n:
        top = add_piece(cycle, top, ALONG_ALPHA, alpha_max, start)
    return largest, top


@jit
def grow(cycle, load, top, begin, end):
    """Growth in stick: new ground keeps the load at which it touched."""
    n0, v0 = load_at(load, begin)
    n1, v1 = load_at(load, end)
    n0 = max(n0, 0.0)
    beneath = cycle.beneath[top] if cycle.start[top] >= n0 else top
    if load.sides > 0:
        slope = min(max((v1 - v0) / (n1 - n0), -1.0), 1.0)
        top = add_piece(cycle, beneath, slope, v0 - slope * n0, n0)
    else:
        top = add_piece(cycle, beneath, FLAT, 0.0, n0)
        cycle.kind[top], cycle.born[top, 0], cycle.born[top, 1] = GROWN, begin, end
    add_stretch(cycle, begin, end, top, STICK, n0, n1, n0, n1)
    return top


@jit
def slip(cycle, load, top, push, begin, end):
    """A slip front moves inwards from the edge until `end`, or until the retreating edge catches it.

    Returns the new top piece, the instant reached, and whether the front was caught.
    """
    which = DIFFERENCE if push == ALPHA else SUM
    n_begin, n_end = load_at(load, begin)[0], load_at(load, end)
    level = n_end[1] - push * n_end[0]
    retreats = n_end[0] < n_begin
    t, front = begin, n_begin
    while not cycle.overflow:
        n0 = load_at(load, t)[0]
        if top == NONE:
            if end > t:
                add_stretch(cycle, t, end, NONE, push, n0, n_end[0], 0.0, 0.0)
            return add_piece(cycle, NONE, float(push), level, 0.0), end, False
        start = cycle.start[top]
        whole = offset(cycle, load, top, start) - push * start
        passes = push * (level - whole) > 0.0
        stop = instant_of(load, which, whole, t, end) if passes else end
        G = start if passes else front_on(cycle, load, top, push, level, front)
        n1 = load_at(load, stop)[0]
        if retreats and n1 < G - 1e-12:  # push · (v - o(n)) falls through 0
            low, high = t, stop
            for _ in range(60):
                middle = 0.5 * (low + high)
                n, v = load_at(load, middle)
                if n >= start and push * (v - offset(cycle, load, top, n)) > 0.0:
                    low = middle
                else:
                    high = middle
            if low > t + SHORTEST:
                n1 = load_at(load, low)[0]
                add_stretch(cycle, t, low, top, push, n0, n1, front, n1)
            return top, low, True
        if stop > t + SHORTEST:
            add_stretch(cycle, t, stop, top, push, n0, n1, front, G)
            t = stop
        front = G
        if passes:
            top = cycle.beneath[top]
            continue
        if n1 > G:
            top = add_piece(cycle, top, float(push), level, G)
        return top, end, False
    return top, end, False


@jit
def retreat(cycle, load, top, begin, end):
    """The edge retreats and nothing slips: unloading retraces what grew."""
    t, n = begin, load_at(load, begin)[0]
    n_end = load_at(load, end)[0]
    while cycle.start[top] > n_end and cycle.beneath[top] != NONE:
        start = cycle.start[top]
        stop = instant_of(load, NORMAL, start, t, end)
        if stop > t + SHORTEST:
            add_stretch(cycle, t, stop, top, STICK, n, start, n, start)
            t, n = stop, start
        top = cycle.beneath[top]
    if end > t + SHORTEST:
        add_stretch(cycle, t, end, top, STICK, n, n_end, n, n_end)
    return top


@jit
def piece_at(cycle, top, G):
    """The piece of the diagram under top that holds G."""
    while cycle.start[top] > G and cycle.beneath[top] != NONE:
        top = cycle.beneath[top]
    return top


@jit
def unload(cycle, load, top, begin, end):
    """The edge retreats faster than v moves: the ground there slips as its memory says.

    Returns the new top piece.
    """
    largest = 0.0
    for j in range(1, 4):
        n, v = load_at(load, begin + 0.25 * j * (end - begin))
        largest = max(largest, abs(v - offset(cycle, load, piece_at(cycle, top, n), n)))
    if largest <= RETRACED:
        return retreat(cycle, load, top, begin, end)
    n, v = load_at(load, begin + 1e-3 * (end - begin))
    push = ALPHA if v >= offset(cycle, load, piece_at(cycle, top, n), n) else BETA
    t = begin
    for _ in range(100):
        top, t, caught = slip(cycle, load, top, push, t, end)
        if not caught:
            return top
        push = -push
    cycle.overflow = 1
    return top


@jit
def solve_cycle(cycle, load):
    """One stationary load cycle; half of it where the other half is its mirror image."""
    cycle.pieces, cycle.stretches, cycle.overflow, cycle.shift = 0, 0, 0, 0.0
    events = cycle.event
    m = turning_points(load, events)
    cycle.events, cycle.no_equilibrium = m, out_of_equilibrium(load, events, m)
    if cycle.no_equilibrium:
        return
    first, top = first_diagram(cycle, load, events, m)
    for step in range(m - 1):
        e = (first + step) % (m - 1)
        turn = load.period if first + step >= m - 1 else 0.0
        begin, end = events[e] + turn, events[e + 1] + turn
        if (load.mirrored and begin > events[first] + 0.5 * load.period - 1e-7) or cycle.overflow:
            break
        n, v, dn, dv, ddn, ddv = rates_at(load, 0.5 * (begin + end))
        if n < 0.0:
            v_end = load_at(load, end)[1]
            add_stretch(cycle, begin, end, NONE, OPEN, 0.0, 0.0, 0.0, 0.0)
            top = add_piece(cycle, NONE, FLAT, v_end, 0.0)
        elif dn > abs(dv):
            top = grow(cycle, load, top, begin, end)
        elif -dn > abs(dv):
            top = unload(cycle, load, top, begin, end)
        elif dn == 0.0 and dv == 0.0:  # nothing moves but perhaps the bulk stress
            add_stretch(cycle, begin, end, top, STICK, n, n, n, n)
        else:
            push = ALPHA if dv > 0.0 else BETA
            top, t, caught = slip(cycle, load, top, push, begin, end)
            if caught:
                top = unload(cycle, load, top, t, end)
    mark_used(cycle)


@jit
def mark_used(cycle):
    """Mark the pieces of the stationary cycle, and note what happens in it."""
    cycle.largest, cycle.smallest = 0.0, 1e300
    cycle.gross_slip, cycle.lift_off, cycle.any_slip = 0, 0, 0
    for i in range(cycle.pieces):
        cycle.used[i] = 0
    for k in range(cycle.stretches):
        cycle.largest = max(cycle.largest, cycle.edge[k, 0], cycle.edge[k, 1])
        cycle.smallest = min(cycle.smallest, cycle.edge[k, 0], cycle.edge[k, 1])
        if cycle.push[k] == OPEN:
            cycle.lift_off = 1
        elif cycle.push[k] != STICK:
            cycle.any_slip = 1
            if cycle.piece[k] == NONE:
                cycle.gross_slip = cycle.may_slide
        i = cycle.piece[k]
        while i != NONE and cycle.used[i] == 0:
            cycle.used[i] = 1
            i = cycle.beneath[i]
