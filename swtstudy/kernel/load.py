"""The load cycle (7), (8) as data: a sum of harmonics, or a closed polygon, in normal and tangential load.

The normal load n is an indentation depth δ/δ0 or a normal force F_N/F_0, the tangential load v a
displacement G*u/(μE*δ0) or a force F_x/(μF_0). α = v - n and β = v + n bound the offsets of the springs
(`swtstudy.kernel.contact`). If one of both is a displacement and the other one a force, the harmonics are
the prescribed normal load's, and n is the normal load in the kind of the tangential load, a function of
the profile. A bulk stress B may go with them, which moves the stick zone (`swtstudy.kernel.shift`). Time runs
over [0, period): 2π for harmonics, the number of sides for a polygon. `swtstudy.kernel.loads` makes loads.
"""

from math import cos, sin, sqrt

import numpy as np

from swtstudy.kernel.chebyshev import panel_of
from swtstudy.kernel.compiled import fields, jit

#: The four functions of time: n, v, α = v - n, β = v + n.
NORMAL, TANGENTIAL, DIFFERENCE, SUM = np.arange(4)
#: Components of a load: n, v, B.
BULK = 2

#: How a normal load becomes a coordinate of the diagram: it is one, by a power law, by series on panels.
UNMAPPED, BY_POWER, BY_SERIES = np.arange(3)
#: Smaller normal loads are mapped in proportion: a power law has derivatives without bounds at 0.
LEAST = 1e-12

#: Rounding of a load.
ROUNDED = 1e-15
MAX_HARMONICS, MAX_VERTICES, MAX_MAP, MAP_ORDER = 64, 2001, 1021, 18
LOAD = np.dtype(
    [
        ("sides", "i8"),  # of a polygon; 0 for harmonics
        ("terms", "i8"),
        ("fastest", "i8"),  # largest order of the harmonics
        ("mirrored", "i8"),  # 1: n(t + π) = n(t), v(t + π) = -v(t), and B is constant
        ("bulk_moves", "i8"),  # 1: B changes
        *fields("f8", "bulk_range normal_range", (2,)),  # smallest and largest B and n
        ("bulk_slope", "f8"),  # dB/dv where n is constant and B moves in proportion to v, or nearly; else 0
        ("bulk_exact", "i8"),  # 1: in proportion
        ("period", "f8"),
        ("rounds", "i8"),  # how often a round of the load runs through the cycle
        ("rest", "f8", (3,)),  # mean of n, v and B
        ("order", "i8", (MAX_HARMONICS,)),
        *fields("f8", "cosine sine", (3, MAX_HARMONICS)),
        ("vertex", "f8", (3, MAX_VERTICES)),  # of n, v and B; the first one once more at the end
        *fields("i8", "normal_force tangential_force"),  # 1: this load is a force
        ("map", "i8"),  # how n follows from the harmonics: UNMAPPED, BY_POWER or BY_SERIES
        ("waves", "f8"),  # half waves of the profile that the edge passes
        ("map_power", "f8"),
        ("map_panels", "i8"),
        ("map_begin", "f8", (MAX_MAP + 1,)),
        ("map_series", "f8", (MAX_MAP, MAP_ORDER)),
    ]
)


@jit
def power(c, s, k):
    """Cos kt and sin kt from c = cos t and s = sin t: the k-th power of a complex number."""
    if k == 1:
        return c, s
    x, y = 1.0, 0.0
    while k > 0:
        if k & 1:
            x, y = x * c - y * s, x * s + y * c
        c, s = c * c - s * s, 2.0 * c * s
        k >>= 1
    return x, y


@jit
def mapped(load, x):
    """The diagram's normal load n of a prescribed one, and two derivatives; bodies that are apart stay so."""
    if x <= 0.0:
        return x, 1.0, 0.0
    first = load.map_begin[1] if load.map == BY_SERIES else LEAST
    if load.map == BY_POWER or x < first:
        p = load.map_power
        scale = 1.0
        if load.map == BY_SERIES:  # up to the first panel
            scale = load.map_series[0, 0] / first**p
        elif x < first:
            scale, p = LEAST ** (p - 1.0), 1.0
        value = scale * x**p
        return value, p * value / x, p * (p - 1.0) * value / (x * x)
    k = panel_of(load.map_begin, np.int64(1), load.map_panels, x)
    width = 2.0 / (load.map_begin[k + 1] - load.map_begin[k])
    y = (x - load.map_begin[k]) * width - 1.0
    b1, b2, d1, d2, e1, e2 = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for i in range(MAP_ORDER - 1, 0, -1):
        e1, e2 = 4.0 * d1 + 2.0 * y * e1 - e2, e1
        d1, d2 = 2.0 * b1 + 2.0 * y * d1 - d2, d1
        b1, b2 = load.map_series[k, i] + 2.0 * y * b1 - b2, b1
    value, rate, bend = load.map_series[k, 0] + y * b1 - b2, b1 + y * d1 - d2, 2.0 * d1 + y * e1 - e2
    return value, width * rate, width * width * bend


@jit
def side_at(load, t):
    """The side of a polygon at an instant, and the share of it that has passed."""
    side = int(t)
    return side - load.sides if side >= load.sides else side, t - side


@jit
def on_side(load, component, t):
    """A component of a polygon at one instant."""
    side, share = side_at(load, t)
    before, after = load.vertex[component, side], load.vertex[component, side + 1]
    return before + share * (after - before)


@jit
def load_at(load, t):
    """N and v at one instant."""
    if load.sides > 0:
        return on_side(load, NORMAL, t), on_side(load, TANGENTIAL, t)
    n, v = load.rest[0], load.rest[1]
    x, y = cos(t), sin(t)
    for i in range(load.terms):
        c, s = power(x, y, load.order[i])
        n += load.cosine[0, i] * c + load.sine[0, i] * s
        v += load.cosine[1, i] * c + load.sine[1, i] * s
    if load.map != UNMAPPED:
        n = mapped(load, n)[0]
    return n, v


@jit
def rates_at(load, t):
    """N, v and their first and second derivatives: n, v, n′, v′, n″, v″."""
    if load.sides > 0:
        side, (n, v) = side_at(load, t)[0], load_at(load, t)
        dn = load.vertex[0, side + 1] - load.vertex[0, side]
        dv = load.vertex[1, side + 1] - load.vertex[1, side]
        return n, v, dn, dv, 0.0, 0.0
    n, v, dn, dv, ddn, ddv = load.rest[0], load.rest[1], 0.0, 0.0, 0.0, 0.0
    x, y = cos(t), sin(t)
    for i in range(load.terms):
        k = float(load.order[i])
        c, s = power(x, y, load.order[i])
        term = load.cosine[0, i] * c + load.sine[0, i] * s
        n += term
        ddn -= k * k * term
        dn += k * (load.sine[0, i] * c - load.cosine[0, i] * s)
        term = load.cosine[1, i] * c + load.sine[1, i] * s
        v += term
        ddv -= k * k * term
        dv += k * (load.sine[1, i] * c - load.cosine[1, i] * s)
    if load.map != UNMAPPED:
        n, rate, bend = mapped(load, n)
        dn, ddn = rate * dn, rate * ddn + bend * dn * dn
    return n, v, dn, dv, ddn, ddv


@jit
def bulk_at(load, t):
    """B at one instant."""
    if load.bulk_moves == 0:
        return load.rest[BULK]
    if load.sides > 0:
        return on_side(load, BULK, t)
    total = load.rest[BULK]
    x, y = cos(t), sin(t)
    for i in range(load.terms):
        c, s = power(x, y, load.order[i])
        total += load.cosine[BULK, i] * c + load.sine[BULK, i] * s
    return total


@jit
def has_bulk(load):
    """True if there is a bulk stress."""
    return load.bulk_range[0] != 0.0 or load.bulk_range[1] != 0.0


@jit
def bulk_rates(load, t):
    """The first and second derivative of B, for harmonics."""
    rate, bend = 0.0, 0.0
    x, y = cos(t), sin(t)
    for i in range(load.terms):
        k = float(load.order[i])
        c, s = power(x, y, load.order[i])
        rate += k * (load.sine[BULK, i] * c - load.cosine[BULK, i] * s)
        bend -= k * k * (load.cosine[BULK, i] * c + load.sine[BULK, i] * s)
    return rate, bend


@jit
def combined(which, n, v):
    """One of n, v, α = v - n, β = v + n; of rates likewise."""
    if which == NORMAL:
        return n
    if which == TANGENTIAL:
        return v
    return v - n if which == DIFFERENCE else v + n


@jit
def function_at(load, which, t):
    """One of n, v, α, β and its rate."""
    n, v, dn, dv, ddn, ddv = rates_at(load, t)
    return combined(which, n, v), combined(which, dn, dv)


@jit
def value_at(load, which, t):
    """One of n, v, α, β."""
    n, v = load_at(load, t)
    return combined(which, n, v)


@jit
def instant_of(load, which, level, begin, end):
    """Instant in [begin, end] at which a function that is monotone there passes a level.

    Newton's method within a bracket, to rounding: the sign of v - o(n) hangs on it where unloading retraces
    the growth.
    """
    at_begin = value_at(load, which, begin) - level
    at_end = value_at(load, which, end) - level
    if at_begin * at_end > 0.0:
        return begin if abs(at_begin) < abs(at_end) else end
    if at_begin == at_end:
        return begin
    if abs(at_end) <= ROUNDED:  # near a turning point the root of that would be an instant of its own
        return end
    share = -at_begin / (at_end - at_begin)
    if load.sides > 0:
        return begin + (end - begin) * share
    rate_begin = function_at(load, which, begin)[1]
    rate_end = function_at(load, which, end)[1]
    t = begin + (end - begin) * share
    if abs(rate_begin) * (end - begin) < 0.2 * abs(at_end - at_begin):  # starts like a parabola
        t = begin + (end - begin) * sqrt(share)
    elif abs(rate_end) * (end - begin) < 0.2 * abs(at_end - at_begin):
        t = end - (end - begin) * sqrt(1.0 - share)
    for _ in range(60):
        f, rate = function_at(load, which, t)
        f -= level
        if abs(f) <= ROUNDED:
            return t
        if f * at_begin > 0.0:
            begin = t
        else:
            end = t
        new = t - f / rate if rate != 0.0 else 0.5 * (begin + end)
        if not (new > begin and new < end):
            new = 0.5 * (begin + end)
        moved = abs(new - t)
        t = new
        if moved < 1e-13:
            break
    return t


@jit
def distinct(z, count, gap):
    """Sort the first values of z, drop values within gap of the one before; returns how many are left."""
    step = count // 2
    while step > 0:  # Shell's method: Numba takes seconds to compile a sort
        for i in range(step, count):
            value, j = z[i], i
            while j >= step and z[j - step] > value:
                z[j] = z[j - step]
                j -= step
            z[j] = value
        step //= 2
    kept = 1
    for i in range(1, count):
        if z[i] - z[kept - 1] > gap:
            z[kept] = z[i]
            kept += 1
    return kept
