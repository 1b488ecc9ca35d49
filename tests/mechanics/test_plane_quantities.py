"""Quantities of plane contacts, and what results say of them."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from oracles.strips import STRIPS, Strip
from scenes import PLANE_NAMES, plane_points, random_plane_points

import swtstudy
from swtstudy.figures.profile import _height
from swtstudy.mechanics.control.coordinate import StripDisplacement, unit_half_load
from swtstudy.mechanics.indenter import make_profile
from swtstudy.mechanics.stress import work
from swtstudy.mechanics.stress.scene import scene_of
from swtstudy.mechanics.stress.work import Conjugate
from swtstudy.vocabulary.choices import FAMILIES

Array = NDArray[np.float64]


def slip_work(pull: float, count: int = 4000) -> float:
    """Work per cycle by the local slip of Cattaneo and Mindlin's contact, over μP_0 · μδ0.

    From +Q to −Q the shear in the slip zone turns from μp to −μp, and q − q_before is twice that of a
    contact that moves for the first time by Q: ∮ = 2 ∫ 2 μp · slip dx over one side, twice, one way and back.
    """
    c = np.sqrt(1.0 - pull)
    # Slip is what the displacements by the change of the shear lack to those of the stick zone:
    # u′ = −(2/π) ∫ q ds/(x − s), of √(a² − s²): −2 x within, −2 (x − √(x² − a²)) beyond; the pressure is ½ √.
    x = c + (1.0 - c) * (np.arange(count) + 0.5) / count
    gradient = -2.0 * (0.5 * np.sqrt(x * x - c * c))  # times μ: what remains of both, of a change by 1
    slip = 2.0 * np.cumsum(gradient) * (1.0 - c) / count
    pressure = 0.5 * np.sqrt(1.0 - x * x)
    one_way = 2.0 * float((np.abs(slip) * pressure).sum()) * (1.0 - c) / count
    return 2.0 * one_way / (0.25 * np.pi)


def of(function: str, batch):  # type: ignore[no-untyped-def]
    return getattr(work, function)(scene_of(batch), unit_half_load(batch.profile, batch.shape, len(batch)))


@pytest.mark.parametrize("pull", [0.3, 0.6, 0.9])
def test_dissipated_work(pull: float) -> None:
    found, error = of("dissipated_work", plane_points("cylinder", 0.3, 0.4, 0.0, pull))
    assert found[0] == pytest.approx(slip_work(pull), rel=1e-3)
    assert error[0] < 1e-5 * found[0]
    if pull == 0.6:
        assert found[0] == pytest.approx(0.0420060 / (0.25 * np.pi), rel=1e-5)


def test_radii_and_force_ratio() -> None:
    """c = √(1 − Q/(μP)) at constant load; at most 1.4 P_0 with half-width √1.4 of a cylinder."""
    still = plane_points("cylinder", 0.3, 0.4, 0.0, [0.3, 0.6])
    np.testing.assert_allclose(of("permanent_stick_radius", still), np.sqrt([0.7, 0.4]), rtol=1e-12)
    np.testing.assert_allclose(of("largest_force_ratio", still), [0.3, 0.6], rtol=1e-9)
    moving = plane_points("cylinder", 0.3, 0.4, 0.4, 0.2, 1.0)
    np.testing.assert_allclose(of("largest_contact_radius", moving), np.sqrt(1.4), rtol=1e-12)


@pytest.mark.slow
@pytest.mark.parametrize("name", PLANE_NAMES)
def test_work_of_a_loop_does_not_depend_on_where_the_body_is_held(name: str) -> None:
    """∮ Q dU against a fine march of the diagram's own answer; a constant share of the load adds nothing."""
    batch = random_plane_points(4, 3, name)
    found, _ = of("dissipated_work", batch)
    scene, unit = scene_of(batch), unit_half_load(batch.profile, batch.shape, len(batch))
    assert (found > 0.0).all()
    conjugate = Conjugate.whole(scene, unit, 64)
    load = scene.cycle.load
    share = 0.5 - 0.5 * np.cos(np.pi * np.arange(1, 2001) / 2001)
    instant = scene.cycle.begin[..., None] + (scene.cycle.end - scene.cycle.begin)[..., None] * share
    moved, force = (
        conjugate.at(instant).reshape(len(batch), -1),
        load.tangential(instant).reshape(len(batch), -1),
    )
    for held in (0.0, 0.7):
        way = moved + held * force
        after, next_one = np.roll(way, -1, axis=1), np.roll(force, -1, axis=1)
        work_done = 0.5 * ((force + next_one) * (after - way)).sum(axis=1)
        np.testing.assert_allclose(work_done, found, rtol=2e-4, atol=1e-7)


def test_one_point_in_curves_and_in_a_figure() -> None:
    given = {
        "profile": "cylinder",
        "normal_force_amplitude": 0.4,
        "tangential_force_amplitude": 0.3,
        "phase": 1.0,
    }
    point = swtstudy.inspect_point(**given)
    assert not {"depth", "displacement"} & {*point}
    np.testing.assert_allclose(point.normal_force.max(), 1.4, rtol=1e-4)
    swing = float(np.ptp(point.normal_strain.values)) / 2.0
    assert float(point.normal_stress.max()) * swing == pytest.approx(float(point.s), rel=1e-3)
    # The diagram: within its bounds, and its integral over the loads is the tangential force.
    assert (np.abs(point.force) <= point.compression + 1e-12).all()
    figure = swtstudy.inspect(**given)
    titles = [axes.get_title("left") for axes in figure.axes if axes.get_title("left")]
    assert len(titles) == 7
    assert not any("displacement" in title for title in titles)


def test_swt_along_a_cylinder_does_not_depend_on_y() -> None:
    given = {
        "profile": "cylinder",
        "normal_force_amplitude": 0.0,
        "tangential_force_amplitude": 0.5,
        "friction": 0.6,
    }
    field = swtstudy.swt_field(x=-1.0, y=0.0, z=0.0, **given)
    assert float(field.s_local) == pytest.approx(0.18, rel=1e-6)
    given["normal_force_amplitude"] = 0.4
    # Alone, each place has the instants at which the edge passes its x.
    alone = [float(swtstudy.swt_field(x=-1.1, y=y, z=0.0, **given).s_local) for y in (0.0, 3.0)]
    assert alone[0] == alone[1]
    stress = swtstudy.stress_field(
        x=[-1.2, 0.4], y=2.0, z=[0.0, 0.2], time=[0.3], bulk_stress_mean=0.1, **given
    )
    expected = 0.3 * (stress.sigma_xx + stress.sigma_zz)
    np.testing.assert_allclose(stress.sigma_yy, expected, atol=1e-15)


@pytest.mark.parametrize("strip", STRIPS, ids=str)
def test_displacement_of_a_strip_grows_by_its_logarithm(strip: Strip) -> None:
    """dU = −½ ln ξ dT: −(2/π) ln ξ for each unit of load, N_0 = π/4 of them."""
    shape = {name: np.array([value]) for name, value in strip.shape.items()}
    moved = StripDisplacement(make_profile(strip.profile, shape, np.array([1.8])))
    radius, step = strip.flat + np.array([[0.2, 0.5, 0.9, 1.4]]), 1e-5
    rise = moved.of(radius + step) - moved.of(radius - step)
    load = moved.profile.depth(radius + step) - moved.profile.depth(radius - step)
    np.testing.assert_allclose(rise, -0.5 * np.log(radius) * load, rtol=1e-6, atol=1e-12)
    np.testing.assert_allclose(moved.compliance(radius), -0.5 * np.log(radius), rtol=1e-14)


@pytest.mark.parametrize("name", PLANE_NAMES)
def test_a_picture_of_a_profile(name: str) -> None:
    """f from N is the profile itself."""
    shape = {"flat_half_width": 0.5, "waviness_amplitude": 0.01, "wavelength": 5.0, "exponent": 4.0}
    own = {key: shape[key] for key in FAMILIES[name].shape}
    profile = make_profile(name, {key: np.array([value]) for key, value in own.items()}, np.ones(1))
    x = np.linspace(0.0, 1.4, 50)
    k = 2.0 * np.pi / (5.0 * 0.1)
    expected = {
        "cylinder": 0.5 * x**2,
        "rounded_flat": 0.5 * np.maximum(x - 0.5, 0.0) ** 2,
        "wavy_cylinder": 0.5 * x**2 + 0.01 * (1.0 - np.cos(k * x)),
        "power_law_cylinder": x**4 / 3.0,
    }[name]
    np.testing.assert_allclose(_height(profile, x), expected, atol=1e-5 * expected.max())
    figure = swtstudy.draw_profile(profile=name, **own)
    assert "line load" in figure.axes[1].get_title("left")
