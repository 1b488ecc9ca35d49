"""The criterion on grids of positions and planes at many instants: plain loops, against which s is held."""

from swtstudy.kernel.compiled import jit
from swtstudy.kernel.criterion import lifted, swing_weights, value_of
from swtstudy.kernel.history import sample_cycle, write_stress
from swtstudy.kernel.parts import COARSEST, MAX_INSTANTS, ROOM, may_be_refined, refine
from swtstudy.kernel.planes import extremes, fill


@jit
def highest_on_planes(point, largest, places, cosines, sines, halved, found):
    """Write the largest value over planes at places s, and the number of its plane, at x > 0 and x < 0.

    Parameters
    ----------
    largest
        Place s of the largest contact.
    places, cosines, sines
        Shapes (X,) and (k,): places, and cos 2θ and sin 2θ of the planes.
    halved
        How often the coarsest intervals of the parts of the cycle are halved.
    found
        Shape (X, 2, 2): by place and side the value and the number of the plane.
    """
    profile, ask, cycle, history, curves = point.profile, point.ask, point.cycle, point.history, point.curves
    for i in range(places.shape[0]):
        for side in range(2):
            sign = 1.0 - 2.0 * side
            if side == 0 or cycle.shift != 0.0:
                sample_cycle(point, places[i], largest, sign, COARSEST)
                for _ in range(halved):
                    for z in range(history.parts):
                        if may_be_refined(history, cycle, z) and history.instants + 2 * ROOM < MAX_INSTANTS:
                            refine(history, z, cycle, profile, point.load)
                write_stress(point)
            fill(history, curves, sign, ask)
            found[i, side, 0], found[i, side, 1] = 0.0, 0.0
            for k in range(cosines.shape[0]):
                of_b, of_c = swing_weights(ask, cosines[k], sines[k])
                top, high, low = extremes(curves, history.instants, cosines[k], sines[k], of_b, of_c)
                value = value_of(ask, lifted(ask, top, high - low, 0.0))
                if value > found[i, side, 0]:
                    found[i, side, 0], found[i, side, 1] = value, k
