"""The cycle of one point at instants that are given: contact, springs, stress and criterion, as is drawn."""

import numpy as np

from swtstudy.kernel.at_place import ASKED, evaluate
from swtstudy.kernel.compiled import fields, jit
from swtstudy.kernel.contact import OPEN, offset, piece_at
from swtstudy.kernel.growth import coordinates_at, find_stretch
from swtstudy.kernel.history import begin_history, stress
from swtstudy.kernel.load import bulk_at, load_at
from swtstudy.kernel.parts import split
from swtstudy.kernel.profile import coordinate_at, place_of
from swtstudy.kernel.work import answer_at, other_at, over_piece

STATE = np.dtype(
    [
        ("stretch", "i8"),
        ("sign", "f8"),  # of all that is tangential: -1 in the mirrored half of a cycle
        ("push", "i8"),  # what pushes the springs
        *fields("f8", "normal tangential bulk"),  # n, v and B
        ("front", "f8"),  # coordinate of the slip front: of the edge in stick
        *fields("f8", "edge_s front_s"),  # places of edge and front
        *fields("f8", "other_normal answer"),  # the loads that are not prescribed
    ]
)


@jit
def write_states(cycle, growth, profile, load, conjugate, instants, out):
    """Write the states of the contact at instants in [0, period]."""
    for i in range(instants.shape[0]):
        k, t, sign = find_stretch(cycle, load, instants[i])
        state = out[i]
        n, v = load_at(load, t)
        edge, front = coordinates_at(cycle, load, k, t)
        state.stretch, state.sign, state.push = k, sign, cycle.push[k]
        if sign < 0.0 and cycle.push[k] != OPEN:
            state.push = -cycle.push[k]
        state.normal, state.tangential, state.bulk = n, sign * v, bulk_at(load, instants[i])
        state.front, state.edge_s, state.front_s = front, place_of(profile, edge), place_of(profile, front)
        state.other_normal = other_at(profile, conjugate, state.edge_s)
        state.answer = sign * answer_at(cycle, growth, profile, conjugate, k, state.edge_s, state.front_s)


@jit
def write_springs(cycle, growth, profile, load, conjugate, states, places, largest, compression, force):
    """Write compression and tangential force of springs at places s, by state and spring.

    With prescribed forces these are values of springs, too; in the plane, which has no springs, values
    of the diagram.
    """
    for j in range(places.shape[0]):
        s = places[j]
        at = coordinate_at(profile, s) if s <= largest else np.inf
        for i in range(states.shape[0]):
            state = states[i]
            k = state.stretch
            compression[i, j], force[i, j] = 0.0, 0.0
            if state.push == OPEN or at >= state.normal:
                continue
            of_springs = profile.in_force and profile.plane == 0
            w = state.normal - at
            if of_springs:
                w = other_at(profile, conjugate, state.edge_s) - other_at(profile, conjugate, s)
            compression[i, j], force[i, j] = w, state.push * w
            if at < state.front:
                piece = piece_at(cycle, cycle.piece[k], at)
                if of_springs:
                    held = conjugate.inside[piece] + over_piece(cycle, growth, profile, conjugate, piece, s)
                    force[i, j] = state.answer - state.sign * held
                else:
                    force[i, j] = state.tangential - state.sign * offset(cycle, load, piece, at)


@jit
def write_stress(point, states, place, largest, side):
    """Write the stress at place s on one side, as a history of the instants of the states."""
    profile, ask, cycle, table, history = point.profile, point.ask, point.cycle, point.table, point.history
    begin_history(point, place, largest, side)
    for i in range(states.shape[0]):
        state = states[i]
        own = state.stretch, state.edge_s, state.front_s, state.sign
        stress(history, i, cycle, profile, table, *own, ask)
        history.bulk[i] = state.bulk
    history.instants = states.shape[0]


@jit
def write_parts(point, place, largest, side):
    """Cut the cycle where the stress at place s on one side has cusps in time.

    The times of the parts are in the history; a mirrored cycle has half of them.
    """
    cycle, history = point.cycle, point.history
    begin_history(point, place, largest, side)
    for k in range(cycle.stretches):
        if history.parts + 7 >= history.first.shape[0]:
            cycle.overflow = 1
            return
        split(history, cycle, point.profile, point.load, k)


@jit
def write_values(search, point, largest, places, values, angles):
    """Write the criterion and 2θ of the critical plane at places s, at x > 0 and at x < 0."""
    for i in range(places.shape[0]):
        search.best, search.positions, search.largest = 0.0, 0, largest
        evaluate(search, point, places[i], ASKED, ASKED)
        for side in range(2):
            values[i, side], angles[i, side] = search.value[side], search.seen_angle[0, side]
