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
def count_cycles(N, Q):
    """Write the values of the closed cycles of the history.

    The stress goes straight between two instants. The outermost cycle closes at the end alone, also where the
    largest swing is there more than once.
    """
    n, start, lowest = N.points, 0, N.swing[0]
    for i in range(1, n):
        lowest = min(lowest, N.swing[i])
        if N.swing[i] > N.swing[start]:
            start = i
    least = LEAST_RANGE * (N.swing[start] - lowest)
    top, cycles = 0, 0
    N.level[0], N.highest[0] = N.swing[start], N.stress[start]
    before, stress_before = N.swing[start], N.stress[start]
    for i in range(1, n + 1):
        now, stress = N.swing[(start + i) % n], N.stress[(start + i) % n]
        if (before - N.level[top]) * (now - before) < 0.0:
            top += 1
            N.level[top], N.highest[top] = before, stress_before
        while top >= (1 if i == n else 2):
            first, turn = N.level[top - 1], N.level[top]
            if abs(now - turn) < abs(first - turn):
                break
            share = (first - before) / (now - before) if now != before else 1.0
            there = stress_before + share * (stress - stress_before)
            tension = max(there, N.highest[top - 1], N.highest[top])
            if abs(first - turn) > least:
                N.value[cycles] = value_of(Q, lifted(Q, tension, abs(first - turn), 0.0))
                cycles += 1
            top = max(top - 2, 0)
            N.highest[top] = max(N.highest[top], tension)  # of what is nested in it
        N.highest[top] = max(N.highest[top], stress)
        before, stress_before = now, stress
    N.cycles = cycles


@jit
def follow(N, H, W, Q, C, S):
    """Write the history of σ_n and the swing on the plane with cos 2θ = C, sin 2θ = S."""
    of_b, of_c = swing_weights(Q, C, S)
    n = 0
    for rank in range(H.parts):
        z = N.rank[rank]
        first, intervals = H.first[z], H.intervals[z]
        for j in range(intervals + 1):
            b, c = W.b[first + j], W.c[first + j]
            W.curve[0, j] = W.a[first + j] + b * C + c * S
            W.curve[1, j] = W.d[first + j] + b * of_b + c * of_c
        for j in range(intervals + 1):
            stress, swing, raw = W.curve[0, j], W.curve[1, j], W.curve[1, j]
            if intervals > 1:
                stress = raised(W.curve[0], j, intervals, 1.0)
                swing = raised(W.curve[1], j, intervals, 1.0)
                if swing == raw:
                    swing = raised(W.curve[1], j, intervals, -1.0)
            if j == 0 and n > 0:  # the end of the part before
                n -= 1
                stress = max(stress, N.stress[n])
                if abs(N.swing[n] - raw) > abs(swing - raw):
                    swing = N.swing[n]
            N.stress[n], N.swing[n] = stress, swing
            n += 1
    N.points = n


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
def rank_parts(N, H, L):
    """Write the parts of the sampled cycle in the order of time, without the parts that were cut in two."""
    for z in range(H.parts):
        begin, j = H.time[z, 0] + H.mirror[z] * L.period, z
        while j > 0 and H.time[N.rank[j - 1], 0] + H.mirror[N.rank[j - 1]] * L.period > begin:
            N.rank[j] = N.rank[j - 1]
            j -= 1
        N.rank[j] = z
