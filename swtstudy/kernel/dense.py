"""The criterion on grids of positions and planes at many instants: plain loops, against which s is held."""

from swtstudy.kernel.compiled import jit
from swtstudy.kernel.criterion import lifted, swing_weights, value_of
from swtstudy.kernel.history import sample_cycle, write_stress
from swtstudy.kernel.parts import COARSEST, MAX_INSTANTS, ROOM, may_be_refined, refine
from swtstudy.kernel.planes import extremes, fill


@jit
def highest_on_planes(H, W, C, R, P, K, L, Q, largest, places, cosines, sines, halved, found):
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
    for i in range(places.shape[0]):
        for side in range(2):
            sign = 1.0 - 2.0 * side
            if side == 0 or C.shift != 0.0:
                sample_cycle(H, C, R, P, K, L, Q, places[i], largest, sign, COARSEST)
                for _ in range(halved):
                    for z in range(H.parts):
                        if may_be_refined(H, C, z) and H.instants + 2 * ROOM < MAX_INSTANTS:
                            refine(H, z, C, P, L)
                write_stress(H, C, P, L, K, Q)
            fill(H, W, sign, Q)
            found[i, side, 0], found[i, side, 1] = 0.0, 0.0
            for k in range(cosines.shape[0]):
                of_b, of_c = swing_weights(Q, cosines[k], sines[k])
                top, high, low = extremes(W, H.instants, cosines[k], sines[k], of_b, of_c)
                value = value_of(Q, lifted(Q, top, high - low, 0.0))
                if value > found[i, side, 0]:
                    found[i, side, 0], found[i, side, 1] = value, k
