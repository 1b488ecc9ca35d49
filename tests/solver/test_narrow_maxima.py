"""Points whose largest swt is one of several narrow maxima, all of which a search along the line once missed.

The values are those of an independent solver (a compiled march of the springs with product integration,
searched densely), to 1e-8.
"""

import math
from dataclasses import replace

import numpy as np
import pytest
from recorded import recorded
from scenes import TANGENTIAL_FORCE, points
from solved import solve_points

import swtstudy
from studies.accuracy_speed.textbook import textbook_s
from swtstudy import TabulatedProfile

CASES = recorded("""
ν=0.37 μ=0.45 δ=0.95 u=0.9 ψ=0.5235987755993461 : 0.3067967778
ν=0.17 μ=0.1 δ=0.675 u=0.925 ψ=0.06981317007907506 ω=5 : 0.0626786823
rounded_punch ν=0.47 μ=0.775 δ=0.85 u=0.05 ψ=1.1344640137959652 ω=2 b=0.4 : 0.0357302665
wavy_paraboloid ν=0.46 μ=0.575 δ=0.375 u=0.775 ψ=0.5235987755993461 ω=3/2 h=0.015 λ=8.0 : 0.5552813462
wavy_paraboloid ν=0.02 μ=0.9 δ=0.15 u=0.775 ψ=0.3141592653589793 ω=5/4 h=0.085 λ=8.0 : 1.1069920896
# Two planes, each with a maximum of its own, of which one hides beside the flank of the other's.
ν=0.3 μ=0.3 δ=0.5 u=0.8333333333333334 ψ=2.2689280275926285 : 0.1351836488
rounded_punch ν=0.3 μ=0.3 δ=0.75 u=0.8333333333333334 ψ=3.141592653589793 ω=1/2 b=0.175 : 0.0931248802
rounded_punch ν=0.3 μ=0.3 δ=0.75 u=0.8333333333333334 ψ=3.141592653589793 ω=1/2 b=0.2 : 0.0913278766
# Gross slip: next to the singular edge, at ln(1/ε) of some 31.
truncated_paraboloid ν=0.3 μ=0.95 δ=0.75 u=0.8333333333333334 ψ=1.5 b=1.0 : 2.0695997068
# The largest σ_n is between the instants of a first look, in a part of the cycle where these are lower.
rounded_punch ν=0.08278972 μ=0.72819391 δ=0.89566945 u=1.14432714 ψ=2.06658266 ω=2/5 b=1.75691463
    : 0.6427883836
# Two cusps side by side, and a maximum on the other side of the lower one.
truncated_paraboloid ν=0.3 μ=0.3 δ=0.75 u=0.8333333333333334 ψ=0.3 b=10.0 : 14.1372158623
# Values at the tightest tolerance: what some part of the search is there for.
# A second plane, not far from the one of the first look.
ν=0.0795418 μ=0.574001 δ=0.82084386 u=1.06225358 ψ=1.71521037 ω=4/3 : 0.8357207106
rounded_punch ν=0.37897634 μ=0.30414001 δ=0.70318321 u=0.33407447 ψ=5.72945468 ω=4 b=0.91058865
    : 0.0448058101
wavy_paraboloid ν=0.37897634 μ=0.30414001 δ=0.70318321 u=0.33407447 ψ=5.72945468 ω=4 h=0.0471635 λ=6.1208145
    : 0.0762849428
# After the first round the largest maximum is 1 % below another one.
ν=0.20926969 μ=0.81969808 δ=0.65394187 u=0.21103958 ψ=1.58282955 ω=4 : 0.3160460844
# Between two events the parabola makes a lower maximum of σ_n higher than that at an event.
ν=0.5 μ=4.229670557555671 δ=0.09126814589903608 u=0.014888734975403578 ψ=0.5235987755982988 ω=4
    : 0.5421196932
# Near the centre, as far as the contact shrinks to it.
wavy_paraboloid ν=0.5 μ=0.62186566 δ=0.99749282 u=0.01714169 ψ=1.57079633 ω=1/2 h=0.0033864 λ=13.36175109
    : 0.0234306484
ν=0.4999973854802275 μ=5.779388629006467 δ=0.9999223464479996 u=0.0010563282787570114 ψ=0.0 ω=1/2
    : 0.0840700483
# The largest ε_n of the plane that counts is between the end of a stretch and the instant before it.
ν=0.5 μ=0.00196378431892 δ=0.909306304318 u=1.87128339734 ψ=2.61799387799 ω=4 : 9.6480002316e-06
# The rounding of an instant made pressure at the edge, which had arrived at r.
ν=0.5 μ=0.00221660980058 δ=9.02210516879 u=0.00566247216277 ψ=3.40902415344 ω=8/7 : 8.8383584632e-08
# What sticks at touch-down takes up a slow tangential motion within a thin layer.
ν=0.49993889193 μ=4.58800383075 δ=0.636090314696 u=0.000594840574927 ψ=0.785398163397 ω=3 : 0.017571311110
# Nearer, where contact is lost.
ν=0.5 μ=0.0081136441 δ=6.93747178 u=7.5921989e-05 ψ=2.34399114 ω=1/2 : 1.170560e-08
ν=0.5 μ=0.05539213 δ=5.4026985 u=5.6188342e-05 ψ=5.16040084 : 3.221889e-07
# At a cusp, around which the search does not look farther away before it has looked twice.
truncated_paraboloid ν=0.34210261 μ=0.87115678 δ=0.04084294 u=0.05000156 ψ=3.01743196 ω=2 b=1.31366125
    : 0.1010117911
wavy_paraboloid ν=0.15822604 μ=0.96059685 δ=0.19305387 u=0.33376002 ψ=2.62997834 ω=1/2 h=0.08103229
    λ=6.04912115 : 0.5751403677
""")


@pytest.mark.quick(12)
@pytest.mark.parametrize("rtol", [pytest.param(1e-4, marks=pytest.mark.slow), 1e-6])
@pytest.mark.parametrize(("point", "s"), CASES)
def test_the_largest_of_narrow_maxima(point, s, rtol):
    found = swtstudy.solve(**point, rtol=rtol)
    assert float(found.s) == pytest.approx(s, rel=rtol)
    # The least of these values are those of stresses of 1e-4 beside pressures of 1, whose rounding is claimed
    # as it is bounded; so is that of a ring of a tenth of the contact.
    rounding = 2e-6 * s**0.5 if s < 1e-5 else 5e-6 * s if s > 10.0 else 1e-9 * s**0.5
    assert float(found.s_error) <= 4.0 * rtol * s + rounding


#: With the share of rtol and the least relative difference that the value is right to.
HIDDEN = recorded("""
# Values are the largest of all planes 0.001° apart at 200 or more steps to a stretch.
# All instants of a first look are low where swt is largest: cusps.
truncated_paraboloid ν=0.4655636457652821 μ=0.5228857294484761 δ=0.5971153494463561 u=0.6418379171623361
    ψ=3.7367783323642563 ω=1/3 b=1.643184743546356 : 0.3 2e-6 0.88603342
truncated_paraboloid ν=0.24133013071197962 μ=0.7410949711241699 δ=0.8134315868234379 u=0.4869796433610266
    ψ=0.857309777564019 ω=1/2 b=1.2774338852121896 : 0.3 2e-6 1.2499172698
# A thin ring, in which the maximum stands where it is least deep.
truncated_paraboloid ν=0.5 μ=6.56973857816583 δ=0.6697797654973929 u=0.00010260181324131555
    ψ=3.4033920413889422 ω=7 b=20.0 : 0.3 2e-6 4.90689911
# Of two minima of ε_n the lower one is so broad and lopsided that four steps see 70 % of it. The value is
# that of the largest of all planes 0.05° apart at 40 steps to a stretch.
truncated_paraboloid ν=0.5 μ=0.03 δ=0.82 u=0.025 ψ=0.9292036732051034 ω=2 b=0.024 : 0.3 2e-6 1.737821e-5
# Beside the higher of two maxima along x, 3° apart, each look-up of the extremes turns the plane by 1° only:
# after two of them swt was 4e-4 low. The value is the largest of all planes 0.0025° apart at 300 steps.
ν=0.36478931206386234 μ=0.8465262528074448 δ=0.5709616824123996 u=0.2860685374063668 ψ=4.573917575870801
    ω=1/2 : 1 2e-7 0.11232858
# The search around the cusp itself follows the other plane, 0.8° apart and 3e-4 lower. The value is the
# largest of all planes 0.001° apart at 300 steps to a stretch, there.
wavy_paraboloid ν=0.5 μ=1.4538194680015437 δ=3.162066877907507e-05 u=0.0018804518037344306
    ψ=5.497787143782138 ω=3/4 h=0.00036937652528890654 λ=27.35474980691395 : 0.1 1e-6 0.00645426607
# Five values on two planes are no polynomial: the third one is beside a maximum at which the second plane
# takes over. The value is that of a search at 1e-8, which takes no polynomial for granted.
ν=0.002353892337961405 μ=0.26790450958947226 δ=0.23448422026668145 u=1.184250650493232
    ψ=3.6378434206077497 ω=3/2 : 0.3 1e-8 0.1855460438
# The spring at x slips 2e-4 before it lifts off; the largest σ_n is 6e-5 later, at the begin of a stretch of
# the length 0.7. The value is the largest of all planes 0.0015° apart at 5,000 steps to a stretch.
wavy_paraboloid ν=0.038002 μ=0.060607 δ=0.850945 u=0.91391 ψ=0.912985 ω=3/2 h=0.0370796 λ=5.95356
    : 0.1 2e-7 0.0693624488
# The tangential amplitude is 1e-4 of the normal one: depths of cusps differ by some 1e-8 of that. Taken for
# one, they hid 1.5e-4 of s. The values are those at 1e-8.
ν=0.3 μ=0.3 δ=0.1 u=9.999999999999999e-06 ψ=0.7 : 0 3e-7 0.00547978330
ν=0.3 μ=0.3 δ=0.1 u=7.498942093324552e-06 ψ=0.7 : 0 3e-7 0.00547027190
# A maximum beside a cusp that is almost as high shows in the first round, in which the search stays at the
# cusp. The value is the largest of all planes 0.001° apart at 600 steps to a stretch, at seven positions.
rounded_punch ν=0.22177930939779883 μ=0.3959710877076259 δ=0.336867339199554 u=0.3044249521787499
    ψ=4.382105344563407 ω=3/2 b=0.7273683233397951 : 0.1 1e-7 0.09683958515
# Maxima within half a wave of the tangential load, where it turns as the contact grows.
ν=0.303093 μ=0.551323 δ=0.159597 u=0.00695342 ψ=1.38303 ω=7/2 : 1 6e-5 0.016958
ν=0.473292027 μ=0.786048526 δ=0.0711952675 u=0.00765546352 ψ=5.34499867 ω=7/3 : 1 3e-5 0.0110759416
ν=0.474451158 μ=0.562014958 δ=0.314495667 u=0.00179822349 ψ=0.720519484 ω=5 : 1 3e-5 0.00124041143
ν=0.480959063 μ=0.652829181 δ=0.492215259 u=0.0912375257 ψ=1.98295504 ω=7/3 : 1 3e-5 0.0801615816
""")


@pytest.mark.parametrize("rtol", [1e-3, pytest.param(1e-4, marks=pytest.mark.slow), 1e-6])
@pytest.mark.parametrize(("point", "share", "least", "s"), HIDDEN)
def test_maxima_of_which_a_first_look_sees_little(point, share, least, s, rtol):
    found = swtstudy.solve(**point, rtol=rtol)
    assert float(found.s) == pytest.approx(s, rel=max(share * rtol, least))
    assert abs(float(found.s) - s) <= float(found.s_error) + least * s


def test_edges_that_arrive_at_a_position_after_many_roundings_of_the_instant():
    # Pressure alone, ν = 0: Hertz's radial stress, compressed most in the deepest contact, pulled as the edge
    # passes.
    amplitude = 1.0814068591891146

    def stress(r, a):
        rest = (1.0 - (r / a) ** 2) ** 0.5
        return 2.0 * a / math.pi * ((a / r) ** 2 * (1.0 - rest**3) / 3.0 - rest)

    r, radius = np.linspace(1.11, 1.112, 2001), math.sqrt(1.0 + amplitude)
    pull = 2.0 * r / (3.0 * math.pi)
    expected = np.max(0.5 * pull * (pull - stress(r, radius)))
    found = solve_points(points("paraboloid", 0.0, 0.1, amplitude, 0.0, 0.25 * math.pi, 1, 8), 1e-6)
    assert found.s[0] == pytest.approx(expected, rel=2e-8)


FACE = np.linspace(0.0, 4.0, 60)
FACED = TabulatedProfile("faced", FACE, np.where(FACE > 0.5, (FACE - 0.5) ** 2 * (1.0 + 0.3 * FACE), 0.0))


@pytest.mark.parametrize("rtol", [1e-4, 1e-6])
def test_a_cusp_whose_instant_is_rounded_where_the_load_turns_is_one_cusp(rtol):
    # Told apart by rounding, two cusps hid the maximum beside them: 5e-4 too low. The value is that at 1e-7.
    one = points(FACED, 0.3824, 0.8762, 0.2162, 0.0722, 6.2122, 3, 2)
    mixed = replace(one, control=TANGENTIAL_FORCE)
    assert solve_points(mixed, rtol).s[0] == pytest.approx(0.171475262006, rel=rtol)


@pytest.mark.slow
@pytest.mark.parametrize(
    "load", [(0.4949, 0.001433, 0.0, 0.04296, 4.974, 1, 1), (0.5, 0.1048, 0.0, 0.01602, 4.189, 1, 1)]
)
def test_under_a_constant_normal_load_the_edge_of_the_contact_is_looked_at(load):
    # Next to ν = 1/2 nothing else is in tension.
    point = points("paraboloid", *load)
    found, textbook = solve_points(point, 1e-4), textbook_s(point, 400, 64, 400, 720, aligned=True)
    assert abs(found.critical_x[0]) == textbook.critical_x == 1.0
    assert found.s[0] == pytest.approx(textbook.s, rel=6e-3)
