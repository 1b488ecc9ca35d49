"""The field on the surface line against the surface formulas: two ways from the memory to the stress."""

import numpy as np
import pytest
from scenes import points

from swtstudy.mechanics import solve_points
from swtstudy.mechanics.body.body_maximum import body_maximum
from swtstudy.mechanics.body.histories import Histories, SpringCells
from swtstudy.mechanics.contact.cycle import solve_cycle
from swtstudy.mechanics.contact.memory import GROWTH
from swtstudy.mechanics.control.coordinate import DepthCoordinate
from swtstudy.mechanics.events.stretches import Nodes
from swtstudy.mechanics.indenter import make_profile
from swtstudy.mechanics.load.bimodal import BimodalLoad
from swtstudy.mechanics.stress.contact_states import contact_states
from swtstudy.mechanics.stress.history import stresses
from swtstudy.mechanics.stress.line import SurfaceLine
from swtstudy.mechanics.stress.scene import scene_of

PROFILES = {
    "paraboloid": {},
    "rounded_punch": {"flat_radius": [0.5]},
    "truncated_paraboloid": {"flat_radius": [0.5]},
    "wavy_paraboloid": {"waviness_amplitude": [0.05], "wavelength": [20**0.5]},
    "power_law": {"exponent": [1.5]},
}
# δA/δ0, p, q, uA, ψ: without growth in stick, with one growth, with several that begin at one depth, with
# lift-off.
LOADS = {
    "slip": (0.75, 1, 1, 5 / 6, 0.0),
    "growth": (0.75, 1, 1, 5 / 6, 1.0),
    "growths": (0.75, 1, 4, 0.3, 0.5),
    "lift-off": (1.5, 1, 2, 0.9, 2.0),
    "constant": (0.0, 1, 1, 0.5, 0.0),
}


def contact(load, name):
    amplitude, p, q, displacement, phase = LOADS[load]
    one = (np.array([v]) for v in (amplitude, displacement, phase))
    shape = {key: np.array(value) for key, value in PROFILES[name].items()}
    return solve_cycle(BimodalLoad(*one, p, q)), make_profile(name, shape, np.array([1.0 + amplitude]))


@pytest.mark.parametrize("name", PROFILES)
@pytest.mark.parametrize("load", LOADS)
def test_surface_line(load, name):
    cycle, profile = contact(load, name)
    rng = np.random.default_rng(1)
    interval = rng.integers(0, cycle.begin.shape[1], 30)
    low, high = cycle.begin[0, interval], cycle.end[0, interval]
    instant = low + (high - low) * rng.uniform(size=30)
    # Inside of a flat face, between, and out of contact; not at the ring where the pressure is infinite.
    r = np.array([0.2, 0.45, 0.6, 0.85, 1.1, 1.4, 1.9])
    friction, poisson_ratio = 0.4, 0.3
    states = contact_states(cycle, DepthCoordinate(profile), interval, instant, cells=100)
    stress = states.stress(np.concatenate([r, -r]), 0.0, 0.0, friction, poisson_ratio)

    line = SurfaceLine(cycle, DepthCoordinate(profile), r[None], 9.0)
    every = np.broadcast_to(np.arange(instant.size), (1, r.size, instant.size))
    history = line.history(Nodes(interval[None], instant[None], every))
    ν, μ = np.array([poisson_ratio]), np.array([friction])
    expected = [np.stack(stresses(history, ν, μ, side), axis=-1)[0] for side in (1.0, -1.0)]
    np.testing.assert_allclose(stress[..., [0, 1, 2, 4]], np.concatenate(expected), rtol=0, atol=1e-5)
    assert np.abs(stress[..., [3, 5]]).max() == 0.0


def test_touch_down_leaves_no_ground_of_rounding():
    """Where contact was made at δ = 1e-15, ground had grown with the displacement of an earlier instant."""
    one = (np.array([v]) for v in (1.5, 0.1, 1.0088946151077967))
    memory = solve_cycle(BimodalLoad(*one, 1, 2)).memory
    assert (memory.stop[np.isfinite(memory.start) & (memory.slope == GROWTH)] > 1e-3).all()


@pytest.mark.parametrize("cells", [60, 960])
def test_cells_that_are_merged_beside_a_face_have_no_gradient_of_rounding(cells):
    """Next to the edge of a face, ends of cells are as near to one another as roundings."""
    scene = scene_of(points("truncated_paraboloid", 0.3, 0.4, 0.75, 5 / 6, 1.0, flat_radius=0.5))
    cycle, place = scene.cycle, np.array([[0.56], [0.0], [0.0]])
    instant = 0.5 * (cycle.begin + cycle.end)
    stress = Histories(scene, *place, SpringCells.of(scene, cells, 0.56)).stress(instant)[0]
    line = SurfaceLine(cycle, scene.coordinate, place[:1], 9.0)
    every = np.arange(instant.size)[None]
    history = line.history(Nodes(every, instant, every[None]))
    expected = np.stack(stresses(history, scene.poisson_ratio, scene.friction, 1.0), axis=-1)[0, 0]
    np.testing.assert_allclose(stress[:, [0, 1, 2, 4]], expected, rtol=0, atol=1e-4)


def test_cells_are_halved_towards_the_circle_where_the_stress_is_wanted():
    """A maximum at three cusps within 1e-7 of r, in cells of 4e-3: 3e-3 of swt was missing, or too much."""
    point = points(
        "wavy_paraboloid",
        poisson_ratio=0.39937803,
        friction=0.91078136,
        normal_amplitude=0.64925636,
        tangential_amplitude=0.00738393,
        phase=3.19487142,
        waviness_amplitude=0.09632214,
        wavelength=7.4128082,
    )
    found = solve_points(point, 1e-6)
    _, at_line = body_maximum(scene_of(point), float(found.critical_x[0]))
    assert float(at_line.swt) == pytest.approx(found.s[0], rel=3e-5)
