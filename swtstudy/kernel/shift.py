"""The stick zone off centre: a bulk stress in proportion to the tangential load moves it.

In the stick zone both surfaces keep their relative strain. The strain of a change of the bulk stress is
balanced by tractions, of which the part that makes the stick zone is off centre (Nowell and Hills 1987). A
slip front that has moved inwards by Δ in the coordinate of the diagram bounds a stick zone whose centre is at
d = shift · Δ, so that each piece of the diagram has a centre of its own, and the superposition stays:

    cylinder  q ~ A(x; a) - A(x - d; c),   e = |d| = a σ_B/(4 μ p0)
    sphere    the same with discs,         e = 4 a σ_B/(π (1+ν)(4-3ν) μ p0)

for bodies of equal moduli; with others e goes with the strain of the body that carries the bulk stress over
the mean of both. That is exact for the cylinder under a constant normal load while the stick zone stays
within the contact, e + c ≤ a, and nearly so for the sphere, whose transverse strain is balanced in part only.
A bulk stress that follows the tangential load nearly (`swtstudy.kernel.loops.slope_of`) moves the stick zone
as if it did exactly; its own stress is that of each instant.
"""

from swtstudy.kernel.compiled import jit
from swtstudy.kernel.events import stick_limit
from swtstudy.kernel.load import load_at
from swtstudy.kernel.profile import coordinate_at, place_of

#: Rounding of the limits of partial slip and of a stick zone that fits into the contact.
ROUNDING = 1e-9


@jit
def shift_of(load, profile, ask, events, m):
    """Shift of a stick zone over how far the coordinate of its end is below the edge's; 0 where it stays.

    Parameters
    ----------
    events, m
        Events of the load, and how many there are.
    """
    if load.bulk_slope == 0.0 or ask.pulled == 0.0 or ask.friction == 0.0 or not profile.is_hertz:
        return 0.0
    stick, nu = stick_limit(load, events, m), ask.poisson_ratio
    if stick < -ROUNDING:  # the whole contact slides
        return 0.0
    stiffness = 4.0 if profile.plane else (1.0 + nu) * (4.0 - 3.0 * nu)
    shift = 2.0 * ask.pulled * load.bulk_slope / (ask.friction * stiffness)
    edge, stick = load_at(load, 0.0)[0], max(stick, 0.0)
    room = place_of(profile, edge) - place_of(profile, stick)
    return shift if abs(shift) * (edge - stick) <= room * (1.0 + ROUNDING) else 0.0


@jit
def centre_of(profile, shift, load, reach, s):
    """Centre of the stick zone of size s, which reaches the edge at most.

    Parameters
    ----------
    load, reach
        Coordinate and place of the edge.
    """
    if shift == 0.0:
        return 0.0
    room = max(reach - s, 0.0)
    return min(max(shift * (load - coordinate_at(profile, s)), -room), room)


@jit
def more_work(profile, shift, nu, moved, force, rate):
    """By how much the shift raises the work of friction over the change of the load.

    While the load rises from 0 to Q, friction does k d² Q more than without the shift: k is the curvature
    along x of the displacements by Hertz's traction, over the largest of them.

    Parameters
    ----------
    moved
        How far the front has moved inwards from the edge, in the coordinate of the diagram.
    force, rate
        The tangential force that has moved it, and its derivative.
    """
    curvature = 0.5 if profile.plane else (4.0 - 3.0 * nu) / (4.0 * (2.0 - nu))
    return curvature * shift * shift * moved * (2.0 * force + moved * rate)
