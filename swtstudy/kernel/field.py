"""Stress and criterion at places of the body of one point: named arrays in, arrays out."""

from functools import partial
from typing import NamedTuple

import numpy as np

from swtstudy.kernel.batch import _of_this_thread, _refuse_overflow, _workspace, chunks, warm_up
from swtstudy.kernel.beneath import PLACE, edges, stress_field
from swtstudy.kernel.compiled import new_record
from swtstudy.kernel.contact import solve_cycle
from swtstudy.kernel.growth import lay_out
from swtstudy.kernel.profile import place_of

#: Tolerance of what grew, of the stress itself: 1e-8 of the largest pressure.
GROWTH = 1e-7


class Opened(NamedTuple):
    """The load cycle of one point, solved; in the memory of the thread until it opens the next one.

    Attributes
    ----------
    contact, growth, profile, load, ask
        Records of CYCLE, GROWTH, PROFILE, LOAD and ASK.
    largest
        Place s of the largest contact.
    """

    contact: np.record
    growth: np.record
    profile: np.record
    load: np.record
    ask: np.record
    largest: float


def open_cycle(tolerance=GROWTH, **given):
    """Solve the load cycle of one point.

    Parameters
    ----------
    tolerance
        Of the tables of what grew.
    given
        As of `swtstudy.kernel.batch.chunks`, of one point.

    Returns
    -------
    Opened
        None if there is no equilibrium.
    """
    warm_up()
    _, profiles, _, loads, asks = next(iter(chunks(**given)))
    C, R = _workspace()[:2]
    P, L, Q = profiles[0], loads[0], asks[0]
    solve_cycle(C, L)
    if C["no_equilibrium"]:
        return None
    _refuse_overflow(C["overflow"])
    lay_out(R, C, P, L, tolerance)
    return Opened(C, R, P, L, Q, float(place_of(P, float(C["largest"]))))


def instants_of(opened, angle):
    """Instants of the record from angles of the common period, [0, 2π)."""
    load = opened.load
    return np.mod(angle * (load["rounds"] * load["period"] / (2.0 * np.pi)), load["period"])


def contact_radii(opened, angle):
    """Contact radius at angles of the common period, (m,), in a_H; 0 out of contact."""
    radius = np.empty(angle.size)
    edges(opened.profile, opened.load, instants_of(opened, angle), radius)
    return radius


def stress_at(opened, places, angle):
    """Stress at places (n, 3) in a_H and angles of the common period (m,), shape (n, m, 6)."""
    C, R, P, L, Q, largest = opened
    B = _of_this_thread("place", partial(new_record, PLACE))
    stress = np.empty((len(places), angle.size, 6))
    own = float(Q["poisson_ratio"]), float(Q["friction"])
    stress_field(B, C, R, P, L, *own, places, instants_of(opened, angle), largest, stress)
    _refuse_overflow(B["overflow"])
    return stress
