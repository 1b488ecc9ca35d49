"""A profile as data: dG/ds over s = √(ξ² - b²), which is smooth for all of them, and its integrals.

G = g/δ0 is the depth at which the spring at radius ξ touches (11). The memory diagram lives in a coordinate:
the depth G, or under prescribed forces the normal force N(ξ) = ∫ ξ dG / ∫_0^{G=1} ξ dG. In a plane contact it
is the line load, and the density is dN/ds with N in E* δ0, whose value at the mean load is π/4. All of these
are integrals of one density, a function of s: `swtstudy.kernel.profiles` has the densities of all profiles.
"""

from math import pi, sqrt

import numpy as np

from swtstudy.kernel.chebyshev import GAUSS, MEANS, ORDER, RUN, clenshaw, fit, panel_of
from swtstudy.kernel.compiled import fields, jit

#: Coordinates of the memory diagram.
DEPTH, FORCE = 0, 1
#: Line load N at the mean load, in E* δ0.
MEAN_LOAD = 0.25 * pi

MAX_PANELS, MAX_KINKS = 1021, 16
PROFILE = np.dtype(
    [
        ("is_hertz", "i8"),  # 1: paraboloid or cylinder, whose functionals have closed forms
        ("plane", "i8"),  # 1: the contact is a strip
        ("singular", "i8"),  # 1: the pressure has no bound at the edge of the face
        ("in_force", "i8"),  # coordinate of the diagram: DEPTH or FORCE
        ("panels", "i8"),
        ("exponent", "f8"),  # n of G = ξⁿ, whose coordinates have closed forms; else 0
        ("power", "f8"),  # and of its coordinate of the diagram
        ("flat_radius", "f8"),  # b/a_H
        ("unit", "f8"),  # coordinate in the units of the density where it is 1
        ("longest", "f8"),  # longest piece over which the profile is smooth
        ("left_out", "f8"),  # relative error of s by what of the profile is left out
        ("kinks", "i8"),  # where the slope changes within a few rows of a table
        ("kink", "f8", (MAX_KINKS, 3)),  # s at its begin, in its middle, at its end
        ("rises", "i8", (2,)),  # near s = 0 the density is as s^j, and the coordinate as sʲ
        *fields("f8", "begin end", (MAX_PANELS,)),  # ends of the panels in s
        ("density", "f8", (MAX_PANELS, ORDER)),  # dG/ds
        ("first_density", "f8", (ORDER,)),  # of the first panel: over s^j
        # Increase of the coordinate within a panel, of the first one over sʲ; and of ∫ ξ dG.
        *fields("f8", "coordinate force", (MAX_PANELS, ORDER + 1)),
        *fields("f8", "coordinate_begin force_begin", (MAX_PANELS + 1,)),
        # Share of a panel at which a place is, over that of its coordinate; of the first one over its root.
        ("place", "f8", (MAX_PANELS, ORDER)),
    ]
)
#: Least density of a panel over its largest one, at most which counts: the stress at the edge of a contact
#: is made where the density may be that much lower than elsewhere in the panel.
STEEPEST = 0.03
#: What `assemble` returns.
ENOUGH, MORE, TOO_MANY = np.arange(3)


@jit
def settle(values, lower, upper, tolerance, floor, narrowest, settled, count, rough):
    """Append panels whose series has died out to the settled panels; returns how many these are.

    Parameters
    ----------
    values
        Shape (m, ORDER): the density at the Gauss points of the panels from lower to upper.
    tolerance, floor
        Last coefficients over the least density, over the floor, or over `STEEPEST` of the largest density,
        whichever is most.
    narrowest
        Panels of this width are settled whatever they miss.
    settled
        Shape (capacity, 3 + ORDER): ends, what the last coefficients are, and values.
    rough
        Shape (m,): becomes True where a panel is not settled.
    """
    series = np.empty(ORDER)
    for i in range(lower.shape[0]):
        fit(values[i], series)
        least, most = abs(values[i, 0]), 0.0
        for k in range(ORDER):
            least, most = min(least, abs(values[i, k])), max(most, abs(values[i, k]))
        missed = max(abs(series[ORDER - 1]), abs(series[ORDER - 2])) / max(least, STEEPEST * most, floor)
        rough[i] = missed > tolerance and upper[i] - lower[i] > narrowest
        if rough[i]:
            continue
        if count >= settled.shape[0]:
            return count
        settled[count, 0], settled[count, 1], settled[count, 2] = lower[i], upper[i], missed
        for k in range(ORDER):
            settled[count, 3 + k] = values[i, k]
        count += 1
    return count


@jit
def assemble(profile, settled, order, largest):
    """Write the panels in their order, up to where the coordinate exceeds largest, and their integrals.

    Under prescribed forces to G = 1 at least, where the unit of force is.
    """
    weighted = profile.in_force and profile.plane == 0
    depth, raw, unit = 0.0, 0.0, MEAN_LOAD if profile.plane else 1.0
    if weighted:
        unit = -1.0
    values, weight, rise = np.empty(ORDER), np.empty(ORDER), np.empty(ORDER + 1)
    profile.coordinate_begin[0], profile.force_begin[0] = 0.0, 0.0
    status = MORE
    for p in range(order.shape[0]):
        if p >= MAX_PANELS:
            return TOO_MANY
        row = settled[order[p]]
        begin, end = row[0], row[1]
        half = 0.5 * (end - begin)
        profile.begin[p], profile.end[p] = begin, end
        for i in range(ORDER):
            s = begin + half * (GAUSS[i] + 1.0)
            values[i], weight[i] = row[3 + i], sqrt(profile.flat_radius * profile.flat_radius + s * s)
        fit(values, profile.density[p])
        gain, load = 0.0, 0.0
        for k in range(ORDER + 1):
            rise[k], profile.force[p, k] = 0.0, 0.0
            for i in range(ORDER):
                rise[k] += half * values[i] * RUN[k, i]
                profile.force[p, k] += half * values[i] * weight[i] * RUN[k, i]
            profile.coordinate[p, k] = profile.force[p, k] if weighted else rise[k]
            gain += rise[k]
            load += profile.force[p, k]
        if weighted and depth < 1.0 <= depth + gain:
            unit = profile.force_begin[p] + clenshaw(profile.force[p], root_of(rise, 1.0 - depth))
        depth += gain
        profile.force_begin[p + 1] = profile.force_begin[p] + load
        raw = profile.force_begin[p + 1] if weighted else depth
        profile.coordinate_begin[p + 1] = raw
        profile.panels = p + 1
        if unit > 0.0 and raw >= largest * unit:
            status = ENOUGH
            break
    profile.unit = unit
    for p in range(profile.panels):
        profile.coordinate_begin[p + 1] /= unit
        for k in range(ORDER + 1):
            profile.coordinate[p, k] /= unit
    first_panel(profile, settled[order[0]], weighted)
    invert(profile)
    return status


@jit
def invert(profile):
    """Series of the place over the coordinate, panel by panel, from which `place_of` starts."""
    values = np.empty(ORDER)
    for p in range(profile.panels):
        low, high = profile.begin[p], profile.end[p]
        below, above = profile.coordinate_begin[p], profile.coordinate_begin[p + 1]
        profile.place[p, :] = 0.0
        profile.place[p, 0] = 1.0
        for i in range(ORDER):
            share = 0.5 * (GAUSS[i] + 1.0)
            of_coordinate = share ** profile.rises[1] if p == 0 else share
            place = place_of(profile, below + of_coordinate * (above - below))
            values[i] = (place - low) / (high - low) / share
        fit(values, profile.place[p])


@jit
def root_of(rise, goal):
    """Where the series of a rise from -1 to 1 is a goal."""
    low, high = -1.0, 1.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        if clenshaw(rise, middle) < goal:
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)


@jit
def first_panel(profile, row, weighted):
    """Series of density and coordinate over their powers of s: digits are kept down to the smallest depth."""
    values = np.empty(ORDER)
    for i in range(ORDER):
        s = 0.5 * row[1] * (GAUSS[i] + 1.0)
        values[i] = row[3 + i] / power_of(s, profile.rises[0])
    fit(values, profile.first_density)
    for i in range(ORDER):
        s = 0.5 * row[1] * (GAUSS[i] + 1.0)
        if weighted and profile.flat_radius > 0.0:  # else ξ = s is in the power
            values[i] *= sqrt(profile.flat_radius * profile.flat_radius + s * s)
    for k in range(ORDER + 1):
        profile.coordinate[0, k] = 0.0
    for k in range(ORDER):
        for i in range(ORDER):
            profile.coordinate[0, k] += MEANS[profile.rises[1] - 1, k, i] * values[i] / profile.unit


@jit
def power_of(s, j):
    """The power s^j for j = 0, 1, 2 or 3."""
    if j == 0:
        return 1.0
    return s if j == 1 else s * s if j == 2 else s * s * s


@jit
def any_power(s, n):
    """The power s^n."""
    return s * s if n == 2.0 else s * s * s if n == 3.0 else s**n


@jit
def on_panel(profile, p, s):
    """The variable of the series of panel p, from -1 to 1, at s."""
    return 2.0 * (s - profile.begin[p]) / (profile.end[p] - profile.begin[p]) - 1.0


@jit
def coordinate_on(profile, p, s):
    """Coordinate of the diagram at s on panel p."""
    value = clenshaw(profile.coordinate[p], on_panel(profile, p, s))
    return power_of(s, profile.rises[1]) * value if p == 0 else profile.coordinate_begin[p] + value


@jit
def density_on(profile, p, s):
    """Density dG/ds at s on panel p."""
    y = on_panel(profile, p, s)
    if p > 0:
        return clenshaw(profile.density[p], y)
    return power_of(s, profile.rises[0]) * clenshaw(profile.first_density, y)


@jit
def coordinate_at(profile, s):
    """Coordinate of the diagram, depth or force, at s."""
    if profile.exponent > 0.0:
        return any_power(s, profile.power)
    return coordinate_on(profile, panel_of(profile.begin, 0, profile.panels, s), s)


@jit
def density_at(profile, s):
    """Density dG/ds, or dN/ds in the plane, at s."""
    n = profile.exponent
    if n > 0.0:
        rate = 2.0 * s if n == 2.0 else n * s ** (n - 1.0)
        return MEAN_LOAD * rate if profile.plane else rate
    return density_on(profile, panel_of(profile.begin, 0, profile.panels, s), s)


@jit
def force_at(profile, s):
    """∫ ξ dG up to s, of a disc."""
    n = profile.exponent
    if n > 0.0:
        return n / (n + 1.0) * any_power(s, n + 1.0)
    p = panel_of(profile.begin, 0, profile.panels, s)
    return profile.force_begin[p] + clenshaw(profile.force[p], on_panel(profile, p, s))


@jit
def place_of(profile, coordinate):
    """Inverse of `coordinate_at`, by Newton's method within a panel."""
    if coordinate <= 0.0:
        return 0.0
    if profile.exponent > 0.0:
        return sqrt(coordinate) if profile.power == 2.0 else coordinate ** (1.0 / profile.power)
    p = panel_of(profile.coordinate_begin, 0, profile.panels, coordinate)
    low, high = profile.begin[p], profile.end[p]
    below, above = profile.coordinate_begin[p], profile.coordinate_begin[p + 1]
    share = (coordinate - below) / (above - below)
    share = min(max(share, 0.0), 1.0)
    if p == 0:
        share = share ** (1.0 / profile.rises[1])
    guess = low + (high - low) * share * clenshaw(profile.place[p], 2.0 * share - 1.0)
    s = min(max(guess, low), high)
    for _ in range(60):
        f = coordinate_on(profile, p, s) - coordinate
        if f > 0.0:
            high = s
        else:
            low = s
        rate = density_on(profile, p, s) / profile.unit
        if profile.in_force and profile.plane == 0:
            rate *= sqrt(profile.flat_radius * profile.flat_radius + s * s)
        new = s - f / rate if rate > 0.0 else 0.5 * (low + high)
        if not (new >= low and new <= high):
            new = 0.5 * (low + high)
        moved = abs(new - s)
        s = new
        if moved <= 1e-8 * s:  # the next step would be its square
            break
    return s


@jit
def radius_of(profile, s):
    """Radius ξ at s."""
    return sqrt(s * s + profile.flat_radius * profile.flat_radius)


def tabulate_profile(
    profile,
    density,
    rises,
    largest,
    tolerance,
    floor=1e-3,
    narrowest=1e-9,
    span=2.0,
    knots=(),
    first_edges=(),
):
    """Fill in the panels of a profile, from the axis to where the coordinate exceeds `largest`.

    Parameters
    ----------
    profile
        Record whose kind, coordinate, flat_radius and longest are known.
    density
        dG/ds as a function of an array of s; dN/ds in the plane.
    rises
        1, 2 or 3, the power of s as which its integral rises at s = 0.
    largest
        Largest coordinate of the diagram that is needed.
    tolerance, floor
        Of the series of panels, see `settle`.
    narrowest
        Least width of a panel.
    span
        So far it is tabulated at first, and each time that this is too short.
    knots
        Ascending places at which panels end rather than in the middle.
    first_edges
        Ends of panels beside the ends of the longest panels.

    Returns
    -------
    float
        The largest share that panels as narrow as allowed miss of the density, each times the root of its
        share of the whole: so much it is of tractions. Infinite if there are too many panels.
    """
    profile.rises[0], profile.rises[1] = rises - 1, rises
    if profile.in_force and not profile.plane and profile.flat_radius == 0.0:
        profile.rises[1] += 1
    settled, count, begin = np.empty((2 * MAX_PANELS, 3 + ORDER)), 0, 0.0
    while True:
        edges = np.linspace(begin, begin + span, max(int(np.ceil(span / profile.longest - 1e-9)), 1) + 1)
        if begin == 0.0 and len(first_edges):
            edges = np.union1d(edges, first_edges[first_edges < span])
        lower, upper = edges[:-1], edges[1:]
        while lower.size:
            half = 0.5 * (upper - lower)[:, None]
            rough = np.zeros(lower.size, np.bool_)
            values = density(lower[:, None] + half * (GAUSS + 1.0))
            count = settle(values, lower, upper, tolerance, floor, narrowest, settled, count, rough)
            if count >= len(settled):
                return np.inf
            middle = (0.5 * (lower + upper))[rough]
            lower, upper = lower[rough], upper[rough]
            if len(knots) and lower.size:
                middle = _at_knots(knots, lower, middle, upper)
            lower, upper = np.concatenate([lower, middle]), np.concatenate([middle, upper])
        status = assemble(profile, settled, np.argsort(settled[:count, 0]), largest)
        if status == TOO_MANY:
            return np.inf
        if status == ENOUGH:
            break
        begin += span
    begin, end, missed = settled[:count, :3].T
    whole = profile.end[profile.panels - 1]
    share = np.sqrt((end - begin) / whole) * np.where((missed > tolerance) & (begin < whole), missed, 0.0)
    return float(share.max())


def _at_knots(knots, lower, middle, upper):
    """The knots nearest to the middles, where they are not next to an end."""
    k = np.clip(np.searchsorted(knots, middle), 1, len(knots) - 1)
    nearest = np.where(middle - knots[k - 1] < knots[k] - middle, knots[k - 1], knots[k])
    margin = 0.02 * (upper - lower)
    return np.where((nearest > lower + margin) & (nearest < upper - margin), nearest, middle)
