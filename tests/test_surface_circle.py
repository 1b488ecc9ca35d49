"""The surface off the line y = 0 from the line's building blocks."""

import numpy as np
import pytest

import swtstudy
from swtstudy.mechanics.contact import solve_cycle
from swtstudy.mechanics.field import contact_states
from swtstudy.mechanics.instants import Nodes
from swtstudy.mechanics.profiles import make_profile
from swtstudy.mechanics.protocol import Protocol
from swtstudy.mechanics.surface_circle import circle_gain, circle_stress
from swtstudy.mechanics.surface_stress import History, SurfaceLine
from swtstudy.mechanics.swt_line import Scene


def contact():
    one = (np.array([v]) for v in (0.5, 0.1, 0.6))
    return solve_cycle(Protocol(*one, 1, 1)), make_profile("paraboloid", {}, np.array([1.5]))


@pytest.mark.parametrize("r", [0.4, 0.9, 1.2, 1.5])
def test_stress_is_that_of_the_field(r):
    cycle, profile = contact()
    interval = np.repeat(np.arange(cycle.begin.shape[1]), 3)
    share = np.tile([0.1, 0.5, 0.9], cycle.begin.shape[1])
    instant = cycle.begin[0, interval] + share * (cycle.end - cycle.begin)[0, interval]
    angle = np.linspace(0.0, np.pi, 7)
    line = SurfaceLine(cycle, profile, np.array([[r]]), 8.0)
    history = line.history(Nodes(interval[None], instant[None], np.arange(instant.size)[None, None]))
    blocks = History(*(getattr(history, name)[0, 0] for name in history.__dataclass_fields__))
    states = contact_states(cycle, profile, interval, instant, cells=200)
    expected = states.stress(r * np.cos(angle), r * np.sin(angle), 0.0, 0.4, 0.3)
    np.testing.assert_allclose(circle_stress(blocks, 0.3, 0.4, angle), expected, rtol=0, atol=1e-6)


def test_gain():
    cycle, profile = contact()
    two = np.zeros(2, dtype=np.intp)
    scene = Scene(cycle.take(two), profile.take(two), np.array([0.3, 0.5]), np.array([0.3, 0.3]))
    solved = swtstudy.solve(
        poisson_ratio=[0.3, 0.5], normal_amplitude=0.5, tangential_amplitude=0.1, phase=0.6
    )
    gain, angle = circle_gain(scene, solved.critical_x.values)
    assert gain[0] == angle[0] == 0.0
    assert gain[1] > 0.005
    assert 0.2 < angle[1] < 0.8
