"""One parameter point from the load to s, and many points in one compiled call."""

from math import sqrt

import numpy as np

from swtstudy.kernel.compiled import jit, new_record
from swtstudy.kernel.contact import CYCLE, solve_cycle
from swtstudy.kernel.growth import GROWTH, lay_out
from swtstudy.kernel.history import HISTORY
from swtstudy.kernel.line import SEARCH, search_line
from swtstudy.kernel.planes import WORK
from swtstudy.kernel.surface import TABLE

#: Rounding of dv/dn: no table is finer.
FINEST_GROWTH = 1e-11
#: Coordinates are rounded to some 4e-14; tractions follow the root of what a slip front is off.
ROUNDING = 2e-7
RESULT = np.dtype(
    [
        ("s", "f8"),
        ("s_error", "f8"),
        ("critical_x", "f8"),
        ("critical_angle", "f8"),  # degrees
        ("positions", "i8"),
        ("instants", "i8"),
        ("gross_slip", "i8"),
        ("lift_off", "i8"),
        ("overflow", "i8"),
    ]
)


def workspace():
    """The memory that one thread needs."""
    return tuple(new_record(kind) for kind in (CYCLE, GROWTH, SEARCH, HISTORY, WORK, TABLE))


@jit
def solve_point(C, R, S, H, W, K, P, L, Q, out):
    """From the load cycle to s at one point.

    What grew is tabulated to a share of the tension that makes s: where s is a small difference of large
    stresses the table is made again, and the search with it.
    """
    solve_cycle(C, L)
    growth, gap, share = Q.growth, 0.0, 1.0
    for _ in range(5):
        lay_out(R, C, P, L, growth)
        gap = search_line(S, H, W, C, R, P, K, L, Q)
        # Tension over the largest stress that slip can make, μ times the pressure.
        share = S.tension / (Q.friction * sqrt(C.largest))
        needed = Q.growth * min(share, 1.0)
        if R.panels == 0 or S.best <= 0.0 or needed >= 0.5 * growth or growth <= FINEST_GROWTH:
            break
        growth = max(0.5 * needed, FINEST_GROWTH)
    out.positions, out.instants = S.positions, H.instants
    out.s, out.critical_x = S.best, S.x
    rounding = ROUNDING / share if S.best > 0.0 else 0.0
    out.s_error = gap + (2.0 * Q.time + rounding) * S.best
    angle = S.angle % (2.0 * np.pi)
    out.critical_angle = 90.0 / np.pi * (angle - 2.0 * np.pi if angle > np.pi else angle)
    out.gross_slip, out.lift_off, out.overflow = C.gross_slip, C.lift_off, C.overflow


@jit
def solve_points(C, R, S, H, W, K, profiles, which, loads, asks, out):
    """Point i: profile which[i], loads[i], asks[i]."""
    for i in range(which.shape[0]):
        solve_point(C, R, S, H, W, K, profiles[which[i]], loads[i], asks[i], out[i])
