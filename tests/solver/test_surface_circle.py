"""The surface off the line y = 0 from the line's building blocks."""

import subprocess
import sys

import numpy as np
import pytest
from recorded import recorded

import swtstudy

NARROW_SLIP = {"normal_amplitude": 0.5, "tangential_amplitude": 0.1, "phase": 0.6, "poisson_ratio": 0.5}


#: With what `dense_circle` of studies/checks/off_line.py finds there.
CIRCLES = recorded("""
# A bulk stress: other instants than the line's.
ν=0.4987338 μ=0.4127386 δ=0.17947362 u=0.0248599 ψ=1.2546567 ω=3 B=0.004575401 Bm=-0.01078477 Bψ=5.0540309
    : 0.005518343
# A ridge that is lower where it is first seen, and goes farther than the first steps.
ν=0.48356659824250975 μ=0.933354169353668 δ=0.012078575610872095 u=0.1320909533233835 ψ=3.422809004373904
    : 0.189634188
# Instants that four steps of a stretch do not tell apart.
wavy_paraboloid ν=0.47024462 μ=0.83081176 δ=0.30861073 u=0.05299352 ψ=2.0605469 ω=3 h=0.094358728
    λ=9.7104941 : 0.05644375
# A ridge beside a higher one, whose planes are 10° from it.
ν=0.4989036 μ=0.84880752 F=0.047248676 Q=0.17364532 ψ=4.3070632 ω=2 : 0.14391736
# Two planes close to one another, each with instants of its own.
wavy_paraboloid ν=0.47431964 μ=0.5486751 δ=0.018785796 u=0.085610956 ψ=0.24791074 ω=3 h=0.055907132
    λ=5.337221 : 0.03796671
# The higher one of two maxima is the lower one at the first angles.
truncated_paraboloid ν=0.45549385 μ=0.56359335 δ=0.052659046 u=0.39145783 ψ=4.3890133 b=1.3394178
    : 0.29500192
# Two instants at which the normal strain is least, the lower one between two nodes of a short stretch.
wavy_paraboloid ν=0.49466201 μ=0.67285351 δ=0.054366492 u=0.006378438 ψ=2.1908372 ω=3 h=0.064670071
    λ=7.1832622 : 0.00345027832
# The same: what is seen of either tells the wrong one.
rounded_punch ν=0.4679046 μ=0.82916397 δ=0.12218225 u=0.0095301119 ψ=5.2195242 ω=3 b=0.33066515
    : 0.00463082464
# Ridges whose planes are 2° from one another.
rounded_punch ν=0.47954282 μ=0.91714728 δ=0.022873104 u=0.34318169 ψ=4.5312632 ω=4/3 b=1.4102593
    : 0.23364991705
""")


@pytest.mark.quick(6)
@pytest.mark.parametrize(("point", "highest"), CIRCLES)
def test_no_maximum_of_the_circle_is_overlooked(point, highest):
    solved = swtstudy.solve(**point)
    assert float(solved.s_surface) == pytest.approx(highest, rel=1e-4)
    assert float(solved.s_surface) > 1.001 * float(solved.s)


def test_circles_do_not_know_of_one_another():
    phases = [0.6, 0.601, 0.602]
    together = swtstudy.solve(**(NARROW_SLIP | {"phase": phases})).s_surface
    alone = [float(swtstudy.solve(**(NARROW_SLIP | {"phase": phase})).s_surface) for phase in phases]
    np.testing.assert_allclose(together, alone, rtol=1e-12)


def test_the_line_is_enough_for_more_compressible_bodies():
    solved = swtstudy.solve(**(NARROW_SLIP | {"poisson_ratio": [0.0, 0.3]}))
    np.testing.assert_array_equal(solved.s_surface, solved.s)


@pytest.mark.slow
def test_a_loop_and_its_mirror_image_have_the_same_where_the_line_has_none():
    """A bulk stress presses, so that s is 0 and no side of the circle is the critical point's."""
    vertices = [(0.064, 0.602, 0.293), (0.651, 0.631, -0.852), (0.334, -0.394, 0.320), (0.227, 0.516, -0.109)]
    own = {
        "profile": "power_law",
        "exponent": 1.05,
        "poisson_ratio": 0.5,
        "friction": 0.24,
        "walker_exponent": 0.85,
        "normal_amplitude": 1.2,
    }
    bulk = {"tangential_amplitude": 0.375, "bulk_stress_amplitude": 0.214, "bulk_stress_mean": -0.194}
    found = [
        swtstudy.solve(
            load=swtstudy.LoadPath("loop", [(n, sign * t, b) for n, t, b in vertices]), **own, **bulk
        )
        for sign in (1.0, -1.0)
    ]
    assert [float(each.s) for each in found] == [0.0, 0.0]
    assert float(found[0].s_surface) > 1e-4
    assert float(found[0].s_surface) == pytest.approx(float(found[1].s_surface), rel=1e-9)


@pytest.mark.slow
def test_the_first_circle_of_a_process_is_that_of_its_point():
    """The first one compiles what circles need; the points at hand stay as they are."""
    point, highest = CIRCLES[0]
    code = f"import swtstudy; print(float(swtstudy.solve(**{point!r}).s_surface))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert float(done.stdout) == pytest.approx(highest, rel=1e-4)


def test_beside_the_singular_edge_of_a_face_the_circle_has_no_bound():
    # The line's maximum is 1e-14 from the edge, where in gross slip the pressure rises like ln(1/ε). The
    # field has 21.6 there, at 81° from the line.
    found = swtstudy.solve(
        profile="truncated_paraboloid",
        flat_radius=1.2,
        frequency_ratio="4/1",
        normal_amplitude=0.6,
        tangential_amplitude=0.8,
        phase=0.0,
        friction=0.95,
        poisson_ratio=0.03,
    )
    assert float(found.s) == pytest.approx(2.4829, rel=1e-3)
    assert np.isnan(found.s_surface)
    assert found.swt.validity() == (
        "critical point at the singular edge of the face: off the line y = 0 swt may have no bound there",
    )


#: Highest on a circle between those of the least and the largest contact radius, or beside that of s: what a
#: dense search of the surface by `swtstudy.swt_field` has, confirmed by tests/oracles/circle.py.
BETWEEN_CIRCLES = recorded("""
# A compressive bulk stress.
rounded_punch ν=0.40733219922801944 μ=0.08754683876406814 F=0.5676274974756472 Q=0.19057321310153524
    ψ=4.526449224803094 ω=1/2 b=1.3370989577190642 γ=0.5256303366271905 B=0.025462564697210376
    Bm=-0.08794579295473688 Bψ=5.568612644399586 : 1.28363e-3
# The same at a low ν.
ν=0.2748378535260868 μ=0.3552906083113567 F=0.47451159599711656 Q=0.03624178913360803 ψ=3.707635810002869
    B=0.011934184832296092 Bm=-0.15453053791167254 Bψ=4.132403792521639 : 0.0105349
# Shear.
rounded_punch criterion=fatemi_socie ν=0.02591782625833705 μ=0.6027707058703032
    δ=0.7098622889175545 u=0.4076855922967507 ψ=0.7459202463932626 b=1.9781085174126507
    k=0.8284780578019395 : 0.20059
# A truncated paraboloid.
truncated_paraboloid ν=0.21 μ=0.304 δ=0.121 u=0.81 ω=3/2 ψ=1.544 B=0.00693 Bm=-1.25 Bψ=3.994
    b=0.13 : 0.0190966
# No bulk stress.
ν=0.5 μ=1.5763012527988831 F=0.3216852075987185 Q=0.24091095730600143 ψ=2.128901457600617
    γ=0.7982557662700376 : 0.600495
""")


@pytest.mark.parametrize(("point", "highest"), BETWEEN_CIRCLES)
def test_the_highest_circle_is_found(point, highest):
    assert float(swtstudy.solve(**point).s_surface) == pytest.approx(highest, rel=2e-4)
