"""Rainflow counting of the strain cycles on one plane.

The swing of a plane is periodic. Counting begins and ends at its largest value, so that every cycle closes:
one closes where the swing, after a turning point and a smaller excursion, comes back to the level of that
turning point. Its time is from the turning point until then; the outermost one's is the whole round. Each has
its own range of the swing and its own largest σ_n within its time, so its own value of the criterion.
"""

from swtstudy.kernel.chebyshev import FINEST, LOBATTO, vertex
from swtstudy.kernel.compiled import jit
from swtstudy.kernel.criterion import lifted, swing_weights, value_of

#: Smallest range of the swing of a cycle that counts, over the largest one: what instants are off. Findley's
#: criterion is not small where the range is.
LEAST_RANGE = 1e-3


@jit
def count_cycles(counting, ask):
    """Write the values of the closed cycles of the history.

    The stress goes straight between two instants. The outermost cycle closes at the end alone, also where the
    largest swing is there more than once.
    """
    n, start, lowest = counting.points, 0, counting.swing[0]
    for i in range(1, n):
        lowest = min(lowest, counting.swing[i])
        if counting.swing[i] > counting.swing[start]:
            start = i
    least = LEAST_RANGE * (counting.swing[start] - lowest)
    top, cycles = 0, 0
    counting.level[0], counting.highest[0] = counting.swing[start], counting.stress[start]
    before, stress_before = counting.swing[start], counting.stress[start]
    for i in range(1, n + 1):
        now, stress = counting.swing[(start + i) % n], counting.stress[(start + i) % n]
        if (before - counting.level[top]) * (now - before) < 0.0:
            top += 1
            counting.level[top], counting.highest[top] = before, stress_before
        while top >= (1 if i == n else 2):
            first, turn = counting.level[top - 1], counting.level[top]
            if abs(now - turn) < abs(first - turn):
                break
            share = (first - before) / (now - before) if now != before else 1.0
            there = stress_before + share * (stress - stress_before)
            tension = max(there, counting.highest[top - 1], counting.highest[top])
            if abs(first - turn) > least:
                counting.value[cycles] = value_of(ask, lifted(ask, tension, abs(first - turn), 0.0))
                cycles += 1
            top = max(top - 2, 0)
            counting.highest[top] = max(counting.highest[top], tension)  # of what is nested in it
        counting.highest[top] = max(counting.highest[top], stress)
        before, stress_before = now, stress
    counting.cycles = cycles


@jit
def follow(counting, history, curves, ask, C, S):
    """Write the history of σ_n and the swing on the plane with cos 2θ = C, sin 2θ = S."""
    of_b, of_c = swing_weights(ask, C, S)
    n = 0
    for rank in range(history.parts):
        z = counting.rank[rank]
        first, intervals = history.first[z], history.intervals[z]
        for j in range(intervals + 1):
            b, c = curves.b[first + j], curves.c[first + j]
            curves.curve[0, j] = curves.a[first + j] + b * C + c * S
            curves.curve[1, j] = curves.d[first + j] + b * of_b + c * of_c
        for j in range(intervals + 1):
            stress, swing, raw = curves.curve[0, j], curves.curve[1, j], curves.curve[1, j]
            if intervals > 1:
                stress = raised(curves.curve[0], j, intervals, 1.0)
                swing = raised(curves.curve[1], j, intervals, 1.0)
                if swing == raw:
                    swing = raised(curves.curve[1], j, intervals, -1.0)
            if j == 0 and n > 0:  # the end of the part before
                n -= 1
                stress = max(stress, counting.stress[n])
                if abs(counting.swing[n] - raw) > abs(swing - raw):
                    swing = counting.swing[n]
            counting.stress[n], counting.swing[n] = stress, swing
            n += 1
    counting.points = n


@jit
def raised(values, j, intervals, sign):
    """Extreme of a curve next to instant j of a part: its parabola's, largest for sign 1, smallest for -1."""
    f = values[j]
    if (j > 0 and sign * values[j - 1] > sign * f) or (j < intervals and sign * values[j + 1] > sign * f):
        return f
    i, step = min(max(j, 1), intervals - 1), FINEST // intervals
    y0, y1, y2 = LOBATTO[(i - 1) * step], LOBATTO[i * step], LOBATTO[(i + 1) * step]
    y, height = vertex(y0, y1, y2, sign * values[i - 1], sign * values[i], sign * values[i + 1])
    return sign * max(height, sign * f) if y0 < y < y2 else f


@jit
def begin_of(history, load, z):
    """Time at which part z begins, in a whole cycle."""
    return history.time[z, 0] + history.mirror[z] * load.period


@jit
def rank_parts(counting, history, load):
    """Write the parts of the sampled cycle in the order of time, without the parts that were cut in two."""
    for z in range(history.parts):
        begin, j = begin_of(history, load, z), z
        while j > 0 and begin_of(history, load, counting.rank[j - 1]) > begin:
            counting.rank[j] = counting.rank[j - 1]
            j -= 1
        counting.rank[j] = z
