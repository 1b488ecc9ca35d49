"""One parameter point from the load to s, and many points in one compiled call."""

from math import nan, pi, sqrt

import numpy as np

from swtstudy.kernel import NEAREST
from swtstudy.kernel.circle import beside_singular_edge, needs_circle
from swtstudy.kernel.compiled import fields, jit
from swtstudy.kernel.contact import CYCLE, solve_cycle
from swtstudy.kernel.criterion import SWT, degrees, far_field
from swtstudy.kernel.growth import GROWTH, lay_out
from swtstudy.kernel.history import HISTORY
from swtstudy.kernel.line import begin_search, rounding_beside, search_line
from swtstudy.kernel.load import bulk_at, has_bulk, load_at
from swtstudy.kernel.planes import CURVES, NOISE
from swtstudy.kernel.profile import place_of
from swtstudy.kernel.records import Point
from swtstudy.kernel.shift import shift_of
from swtstudy.kernel.surface import TABLE
from swtstudy.vocabulary.choices import REGIMES

#: Rounding of dv/dn: no table is finer.
FINEST_GROWTH = 1e-11
#: What is no distance, over the largest contact.
ONE_PLACE = 1e-15
#: In gross slip s grows like 1/(1 - μ), its place nears the singular edge like exp(-1/(1 - μ)): from here on
#: there is no continuum that small.
TEARS = 0.995
#: Nearer to the singular edge of a face than this share of it the circle may be higher at any ν.
BESIDE_EDGE = 1e-3
#: If the bulk stress alone is as high as this share of s, it makes s.
SAME = 1e-7
#: The regimes by number.
STICK, PARTIAL_SLIP, GROSS_SLIP, LIFT_OFF, NOT_FINITE, NO_EQUILIBRIUM = np.arange(len(REGIMES))
RESULT = np.dtype(
    [
        *fields("f8", "s s_error critical_x critical_angle"),  # the angle in degrees
        ("shift", "f8"),  # of the stick zone, see `swtstudy.kernel.shift`
        *fields("i8", "regime positions instants overflow"),
        ("s_surface", "f8"),  # s; NaN at the singular edge of a face; what the circle has where it is higher
        ("circle", "i8"),  # 1: the circle may be higher
        ("place", "f8"),  # s of critical_x on the profile
        ("growth", "f8"),  # tolerance of the tables of what grew
    ]
)
#: Kinds of the records of a point that are not given, as `swtstudy.kernel.records.Point` has them.
OF_POINT = CYCLE, GROWTH, TABLE, HISTORY, CURVES


@jit
def regime_of(cycle, load, profile, ask):
    """Regime of the stationary cycle."""
    if profile.singular and is_torn(cycle, load, profile, ask):
        return NOT_FINITE
    if cycle.lift_off:
        return LIFT_OFF
    if cycle.gross_slip:
        return GROSS_SLIP
    return PARTIAL_SLIP if cycle.any_slip else STICK


@jit
def is_torn(cycle, load, profile, ask):
    """True if swt grows without bound, or nearly, towards the singular edge of a face.

    With |τ| = w at the innermost spring a plane near 45° is in tension that grows like ln(1/ε) for μ > 1; in
    gross slip the strain does, too. If contact is lost, springs pull before the pressure comes.
    """
    b, largest = profile.flat_radius, place_of(profile, cycle.largest)
    ring = sqrt(b * b + largest * largest) - b
    nearest = NEAREST * min(ring, max(b, 1e-3 * (b + ring)))
    # Depth g = ξ √(ξ² - b²) at ξ = b + nearest.
    margin = (b + nearest) * sqrt(nearest * (2.0 * b + nearest))
    lost = cycle.smallest <= margin
    slips, pulled, moves = False, False, False
    for k in range(cycle.stretches):
        for e in range(2):
            n, v = load_at(load, cycle.time[k, e])
            slips = slips or abs(v) >= n - margin
            moves = moves or v != 0.0
            pulled = pulled or (n <= margin and bulk_at(load, cycle.time[k, e]) > 0.0)
    torn = (slips and ask.friction > 1.0) or (cycle.gross_slip and ask.friction >= TEARS) or lost
    if torn and ask.friction > 0.0 and moves:
        return True
    return lost and pulled and ask.poisson_ratio < 0.5


@jit
def is_idle(cycle, load, profile, ask):
    """True if s is 0: nothing moves, or pressure alone makes no tension at ν = 1/2 and in the plane."""
    still, pulls, v0 = cycle.largest == cycle.smallest, False, load_at(load, cycle.time[0, 0])[1]
    for k in range(cycle.stretches):
        v = load_at(load, cycle.time[k, 1])[1]
        still = still and (v == v0 or ask.friction == 0.0)
        pulls = pulls or (v != 0.0 and ask.friction > 0.0)
    if has_bulk(load):
        return still and load.bulk_range[1] == load.bulk_range[0]
    return still or (ask.criterion == SWT and not pulls and (ask.poisson_ratio == 0.5 or profile.plane))


@jit
def tension_share(cycle, ask, tension, pressure):
    """Tension over the largest stress that slip can make, μ times the pressure; 1 at most, or without.

    The largest pressure at the place counts where it is above that of a sphere, 2/π √depth: at a face's edge.
    """
    largest = ask.friction * max(sqrt(cycle.largest), 0.5 * pi * pressure)
    return tension / largest if 0.0 < tension < largest else 1.0


@jit
def rounding_share(cycle, profile, ask, place, tension):
    """Largest stress that rounding makes at a place, over the tension.

    The rounding of the distance to a turning edge or slip front matters if the distance is small and not 0:
    then the place itself is not this turning point.
    """
    largest, nearest = place_of(profile, cycle.largest), 1.0
    for k in range(cycle.stretches):
        for e in range(2):
            for G in (cycle.edge[k, e], cycle.front[k, e]):
                distance = abs(place_of(profile, G) - place) / largest
                if distance > ONE_PLACE:
                    nearest = min(nearest, distance)
    return rounding_beside(cycle, profile, ask, nearest, tension)


@jit
def solve_point(search, point, out):
    """From the load cycle to s at one point.

    The growth is tabulated to a share of the tension that makes s: where s is a small difference of large
    stresses the table is made again, and the search with it.
    """
    load, profile, ask, cycle, growth = point.load, point.profile, point.ask, point.cycle, point.growth
    out.s, out.s_error, out.critical_x, out.critical_angle = nan, nan, nan, nan
    out.shift = 0.0
    out.positions, out.instants, out.overflow, out.regime = 0, 0, 0, NO_EQUILIBRIUM
    out.s_surface, out.circle, out.place, out.growth = nan, 0, 0.0, ask.growth
    solve_cycle(cycle, load)
    if cycle.no_equilibrium:
        return
    out.overflow, out.regime = cycle.overflow, regime_of(cycle, load, profile, ask)
    if out.regime == NOT_FINITE or cycle.overflow:
        return
    cycle.shift = out.shift = shift_of(load, profile, ask, cycle.event, cycle.events)
    out.s, out.s_error, out.s_surface, out.circle = 0.0, 0.0, 0.0, needs_circle(load, profile, ask)
    if is_idle(cycle, load, profile, ask):
        return
    tolerance, gap, coarse = ask.growth, 0.0, 0.0
    for _ in range(5):
        out.growth, tolerance = tolerance, lay_out(growth, cycle, profile, load, tolerance)
        coarse = tolerance if tolerance > out.growth else 0.0
        fine_enough = coarse > 0.0 or growth.panels == 0 or tolerance <= FINEST_GROWTH
        begin_search(search, point)
        needed = ask.growth * tension_share(cycle, ask, search.tension, search.pressure)
        if fine_enough or needed >= 0.5 * tolerance:
            gap = search_line(search, point)
            needed = ask.growth * tension_share(cycle, ask, search.tension, search.pressure)
        if fine_enough or needed >= 0.5 * tolerance:
            break
        tolerance = max(0.5 * needed, FINEST_GROWTH)
    out.positions, out.instants, out.overflow = search.positions, point.history.instants, cycle.overflow
    out.s, out.place = search.best, search.place
    if search.best == 0.0:  # tension within rounding is taken for none
        out.s_error = gap + NOISE * cycle.largest
    else:
        rounding = rounding_share(cycle, profile, ask, search.place, search.tension)
        rounding += coarse / tension_share(cycle, ask, search.tension, search.pressure)
        out.s_error = gap + (ask.time + rounding + profile.left_out) * search.best
        x = sqrt(profile.flat_radius * profile.flat_radius + search.place * abs(search.place))
        out.critical_x = search.sign * x + 0.0  # no -0 at the centre
        out.critical_angle = degrees(search.angle)
    if has_bulk(load):
        far, angle = far_field(ask, load.bulk_range[1], load.bulk_range[0], profile.plane)
        if far > 0.0 and far >= (1.0 - SAME) * search.best:
            out.s, out.s_error = far, max(search.best + out.s_error - far, 0.0)
            out.critical_x, out.critical_angle = nan, degrees(angle)
    if beside_singular_edge(profile, out.critical_x, BESIDE_EDGE):
        out.circle = not profile.plane
    out.s_surface = nan if beside_singular_edge(profile, out.critical_x, NEAREST) else out.s


@jit
def solve_points(search, room, profiles, which, loads, asks, out):
    """Point i: profile which[i], loads[i], asks[i]; ``room`` has the records of the kinds `OF_POINT`."""
    for i in range(which.shape[0]):
        solve_point(search, Point(loads[i], profiles[which[i]], asks[i], *room), out[i])
