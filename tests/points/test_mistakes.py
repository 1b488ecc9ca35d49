"""Whole messages of wrong parameters, and of what cannot be combined."""

from typing import Any

import numpy as np
import pytest
import xarray as xr
from told import refused, sayings

from swtstudy import LoadPath, TabulatedProfile, solve

#: Loops of the load: with a normal load at rest, with one that moves, and with one that was measured.
UP, MOVE = LoadPath("up", [[0.0, 1.0], [0.0, -1.0]]), LoadPath("move", [[0.5, 1.0], [-0.5, -1.0]])
BULK, FAR = LoadPath("bulk", [[0, 1, 1], [0, -1, -1]]), LoadPath("far", [[2.0, 1.0], [3.0, -1.0]])
MEASURED = LoadPath("measured", [[0.3, 1.0], [-0.3, -1.0]], 200.0)
LARGE = LoadPath("large", [[2e9, 1e10, 3e9], [-2e9, -1e10, 0.0]])
AT_LIMIT = LoadPath("at limit", [[0.0, 1e9, 1e9], [0.0, -1e9, 0.0]])
SMOOTH = LoadPath.harmonic_sum("smooth", [(1, 0.5, 0)], [(1, 1, 0)])
RESTING = LoadPath.harmonic_sum("resting", [(1, 0, 0)], [(1, 1, 0)])
CAP = TabulatedProfile("cap", np.linspace(0.0, 1.0, 40), np.linspace(0.0, 1.0, 40) ** 2)
MANY = np.zeros(1_000_001)


def listed(*values: object, labels: list[object] | None = None) -> xr.DataArray:
    """Values along a list of points."""
    return xr.DataArray([*values], {"test": labels} if labels else None, "test")


#: Calls, and all that is said of each.
TOLD = sayings(r"""
solve(friction=xr.DataArray(MANY, dims="test"), phase=xr.DataArray(MANY, dims="test"))
» friction, phase: found 1000001 points; allowed: at most 1000000 points
solve(friction=MANY)
» friction: found 1000001 values; allowed: at most 1000000 values
solve(friction=MANY[:600_000], poisson_ratio=MANY[:600_000])
» friction, poisson_ratio: found 1200000 values, 4e+11 points; allowed: at most 1000000 values along all axes
solve(friction=xr.DataArray([], dims="test"), phase=xr.DataArray([], dims="test"))
» friction, phase: found no points; allowed: at least one point
solve(profile="wavy_paraboloid", waviness_amplitude=np.linspace(0, 1e-3, 8000), wavelength=np.linspace(5, 6,
    8000))
» waviness_amplitude, wavelength: found 64000000 shapes of the wavy_paraboloid; allowed: at most 50000000
solve(normal_sensitivity=0.3)
» normal_sensitivity: found a value with the criterion swt; allowed: a value with fatemi_socie or findley only
solve(normal_sensitivity=[0.0, 0.3], criterion=["swt"])
» normal_sensitivity: found a value with the criterion swt; allowed: a value with fatemi_socie or findley only
solve(criterion=["swt", "findley", "fatemi_socie"])
» normal_sensitivity: found nothing; allowed: a number ≥ 0 with the criterion findley, fatemi_socie
solve(criterion="findley", normal_sensitivity="x")
» normal_sensitivity: found 'x' (not a number or an expression of numbers, pi, sqrt(), + - * / ( )); allowed:
    a number in [0, 100]
solve(criterion="findley", normal_sensitivity=0.3, walker_exponent=0.4)
» walker_exponent: found a value with the criterion findley; allowed: a value with swt only
solve(criterion=["swt", "findley"], normal_sensitivity=0.3, profile="truncated_paraboloid", flat_radius=1)
» profile: found truncated_paraboloid with the criterion findley; allowed: another profile: where slip
    reverses at its sharp edge, the amplitude of the shear stress has no bound
solve(profile="cylinder")
» normal_force_amplitude, tangential_force_amplitude: found nothing with the profile cylinder; allowed:
    normal_force_amplitude and tangential_force_amplitude: depths and displacements of a plane contact have no
    meaning, only forces have
solve(profile="cylinder", normal_amplitude=0.1, tangential_amplitude=0.2)
» normal_amplitude, tangential_amplitude: found a displacement with the profile cylinder; allowed:
    normal_force_amplitude and tangential_force_amplitude: depths and displacements of a plane contact have no
    meaning, only forces have
solve(profile="cylinder", normal_force_amplitude=0.1, tangential_amplitude=0.2)
» tangential_amplitude: found a displacement with the profile cylinder; allowed: tangential_force_amplitude:
    depths and displacements of a plane contact have no meaning, only forces have
solve(profile=["cylinder", "paraboloid", "rounded_flat"], flat_half_width=0.5, normal_force_amplitude=0.1)
» tangential_force_amplitude: found nothing with the profile cylinder, rounded_flat; allowed:
    tangential_force_amplitude: depths and displacements of a plane contact have no meaning, only forces have
solve(profile="cylinder", load=UP)
» tangential_force_amplitude: found nothing with the profile cylinder; allowed: tangential_force_amplitude:
    depths and displacements of a plane contact have no meaning, only forces have
solve(profile="cylinder", load=UP, normal_amplitude=0.5)
» normal_amplitude: found a displacement with the profile cylinder; allowed: normal_force_amplitude and
    tangential_force_amplitude: depths and displacements of a plane contact have no meaning, only forces have
solve(profile="cylinder", load=MOVE)
» normal_force_amplitude, tangential_force_amplitude: found nothing with the profile cylinder; allowed:
    normal_force_amplitude and tangential_force_amplitude: depths and displacements of a plane contact have no
    meaning, only forces have
solve(load=["harmonic", MOVE])
» normal_amplitude: found nothing; allowed: a value: it scales the loops, and is the amplitude of the harmonic
    load
» tangential_amplitude: found nothing; allowed: a value: it scales the loops, and is the amplitude of the
    harmonic load
solve(load=["harmonic", UP], normal_force_amplitude=0.1)
» tangential_amplitude: found nothing; allowed: a value: it scales the loops, and is the amplitude of the
    harmonic load
solve(load=["harmonic", MOVE], profile="cylinder")
» normal_force_amplitude, tangential_force_amplitude: found nothing with the profile cylinder; allowed:
    normal_force_amplitude and tangential_force_amplitude: depths and displacements of a plane contact have no
    meaning, only forces have
solve(load=["harmonic", BULK], normal_amplitude=0.1, tangential_amplitude=0.2)
» bulk_stress_amplitude: found nothing; allowed: a value: it scales the loops, and is the amplitude of the
    harmonic load
solve(load=UP, bulk_stress_amplitude=[0.0, 0.2, 0.1])
» bulk_stress_amplitude: found 0.2 with a loop of two columns, 'up'; allowed: 0, or a loop with the bulk
    stress as its third column; bulk_stress_mean goes with all
solve(load=FAR)
» load: found 'far' with a normal column from 2 to 3, far from 0; allowed: deviations from the mean normal
    load: take its mean, 2.5, off (absolute = true, LoadPath.absolute)
solve(load=FAR, normal_amplitude=-1)
» normal_amplitude: found -1 (out of range); allowed: a number in [0, 10]
solve(load=FAR, normal_amplitude=0.5, tangential_amplitude=0.5, friction=-1)
» friction: found -1 (out of range); allowed: a number in [0, 10]
» load: found 'far' with a normal column from 2 to 3, far from 0; allowed: deviations from the mean normal
    load: take its mean, 2.5, off (absolute = true, LoadPath.absolute)
solve(load=MOVE, normal_force_amplitude=0.3, tangential_amplitude=0.4)
» load: found 'move' with a normal load that is not constant, and normal_force+tangential_displacement;
    allowed: two displacements or two forces; or a normal load at rest (normal_force_amplitude = 0, or scale =
    { normal = 0 } under [loads.NAME])
solve(load=[MOVE, UP, SMOOTH], normal_amplitude=0.3, tangential_force_amplitude=0.4)
» load: found 'move', 'smooth' with a normal load that is not constant, and
    normal_displacement+tangential_force; allowed: two displacements or two forces; or a normal load at rest
    (normal_amplitude = 0, or scale = { normal = 0 } under [loads.NAME])
solve(load=[UP, MEASURED], normal_amplitude=0.3, tangential_force_amplitude=0.4)
» load: found 'measured' with a normal load that is not constant, and normal_displacement+tangential_force;
    allowed: two displacements or two forces; or a normal load at rest (normal_amplitude = 0, or scale = {
    normal = 0 } without absolute under [loads.NAME])
solve(load=[RESTING, UP], normal_amplitude=0.3, tangential_force_amplitude=0.4)
» load: found harmonics, 'resting', and normal_displacement+tangential_force; allowed: two displacements or
    two forces; or vertices
solve(load=MEASURED)
» load: found 'measured' with a mean normal load of 200, without units; allowed: [units], or
    swtstudy.physical; or normal_force_amplitude = 1/200 or the like
solve(load=LARGE)
» load: found 'large' with a normal of 2e+09; allowed: at most 1e+09, δ0
» load: found 'large' with a tangential of 1e+10; allowed: at most 1e+09, μ E* δ0/G*
» load: found 'large' with a bulk stress of 3e+09; allowed: at most 1e+09, E* δ0/a_H
solve(load=[UP, LARGE], normal_amplitude=0, tangential_force_amplitude=[1.0, 0.0], bulk_stress_amplitude=0)
» load: found 'large' with a tangential of 1e+10; allowed: at most 1e+09, μ E* δ0/G*
solve(normal_amplitude=1, normal_force_amplitude=1, tangential_amplitude=1, tangential_force_amplitude=1)
» normal_amplitude, normal_force_amplitude: found both; allowed: one of the two: it says what is prescribed
» tangential_amplitude, tangential_force_amplitude: found both; allowed: one of the two: it says what is
    prescribed
solve(profile=["rounded_punch", "power_law"], exponent=1.5)
» flat_radius: found nothing; allowed: a number in [0, 100] (rounded_punch needs it)
solve(flat_radius=[0.1, 0.2])
» flat_radius: found an axis, which no profile here has (paraboloid); allowed: only with the profile
    rounded_punch or truncated_paraboloid
solve(profile="power_law", flat_radius=0.2, exponent=1.5)
» flat_radius: found 0.2, which no profile here has (power_law); allowed: only with the profile rounded_punch
    or truncated_paraboloid
solve(wavelength=3, exponent=2)
» wavelength: found 3, which no profile here has (paraboloid); allowed: only with the profile wavy_paraboloid
    or wavy_cylinder
» exponent: found 2, which no profile here has (paraboloid); allowed: only with the profile power_law or
    power_law_cylinder
solve(profile="s p h")
» profile: found 's p h' (no such profile); allowed: one of paraboloid, rounded_punch, truncated_paraboloid,
    wavy_paraboloid, power_law, cylinder, rounded_flat, wavy_cylinder, power_law_cylinder; your own:
    [profiles.NAME] in a study, swtstudy.TabulatedProfile in Python
solve(profile="rounded_ponch", flat_radius=0.5)
» profile: found 'rounded_ponch' (no such profile); allowed: did you mean rounded_punch? known: paraboloid,
    rounded_punch, truncated_paraboloid, wavy_paraboloid, power_law, cylinder, rounded_flat, wavy_cylinder,
    power_law_cylinder
solve(load="foo")
» load: found 'foo' (no such load); allowed: one of harmonic; your own: [loads.foo] in a study,
    swtstudy.LoadPath in Python
solve(criterion="foo")
» criterion: found 'foo' (no such criterion); allowed: one of swt, fatemi_socie, findley
solve(profile=[UP])
» profile[0]: found <LoadPath up> (not a name); allowed: one of paraboloid, rounded_punch,
    truncated_paraboloid, wavy_paraboloid, power_law, cylinder, rounded_flat, wavy_cylinder,
    power_law_cylinder; your own: [profiles.NAME] in a study, swtstudy.TabulatedProfile in Python
solve(load=CAP)
» load: found TabulatedProfile('cap', 40 points up to 1) (not a name); allowed: one of harmonic; your own:
    [loads.NAME] in a study, swtstudy.LoadPath in Python
solve(profile=CAP, normal_amplitude=3.0)
» profile: found cap; allowed: the depth 4 is beyond the table of cap, which ends at the radius 1: the contact
    is as large as that at the depth 2
solve(radius=50)
» radius: found a parameter of real contacts; allowed: this in a study with [units], or swtstudy.physical
solve(E=7e4, P=0.5, Q=1, u=1, f=0.5, sigma=1)
» E: found a parameter of real contacts; allowed: young_modulus in a study with [units], or swtstudy.physical
» P: found unknown parameter 'P'; allowed: did you mean normal_force_amplitude? list all: swtstudy list
    --parameters
» Q: found unknown parameter 'Q'; allowed: did you mean tangential_force_amplitude? list all: swtstudy list
    --parameters
» u: found unknown parameter 'u'; allowed: did you mean tangential_amplitude? list all: swtstudy list
    --parameters
» f: found unknown parameter 'f'; allowed: did you mean friction or profile (f)? list all: swtstudy list
    --parameters
» sigma: found unknown parameter 'sigma'; allowed: one of 26 names, list all: swtstudy list --parameters
solve(critical_distance=-1)
» critical_distance: found -1 (out of range); allowed: a number in (0, 10]
solve(critical_distance=[0.1, 0.1, 11])
» critical_distance[1]: found 0.1, the same as critical_distance[0]; allowed: distinct values
» critical_distance[2]: found 11 (out of range); allowed: a number in (0, 10]
solve(critical_distance=[])
» critical_distance: found an empty axis; allowed: at least one value
solve(friction=listed(0.1, -0.2))
» friction[1]: found -0.2 (out of range); allowed: a number in [0, 10]
solve(friction=np.array([0.1, 0.1, -0.2]), poisson_ratio=np.float64(0.7))
» poisson_ratio: found 0.7 (out of range); allowed: a number in [0, 0.5]
» friction[1]: found 0.1, the same as friction[0]; allowed: distinct values
» friction[2]: found -0.2 (out of range); allowed: a number in [0, 10]
solve(friction=listed(0.1, -0.2, -0.3, 11), phase=listed(1, 2, 3, 4))
» friction: found -0.2 (out of range) at [1]; 2 more like it; allowed: a number in [0, 10]
solve(friction=listed("0,1", "0.2"), phase=listed(1, 2))
» friction: found '0,1' (not a number or an expression of numbers, pi, sqrt(), + - * / ( )) at [0]; allowed: a
    number in [0, 10]
solve(friction=listed(0.1, 0.2, 0.3), phase=listed(1, 2), tangential=listed(1, 2))
» tangential: found unknown parameter 'tangential'; allowed: did you mean tangential_amplitude or
    tangential_force_amplitude? list all: swtstudy list --parameters
» friction, phase, tangential: found lengths or coordinates that differ along test; allowed: the same ones
solve(friction=listed(0.1, 0.2, labels=[1, 2]), phase=listed(1, 2, labels=[1, 3]))
» friction, phase: found lengths or coordinates that differ along test; allowed: the same ones
solve(friction=listed(0.1, 0.2, labels=["a", None]), phase=listed(1, 2, labels=["a", None]))
» friction, phase: found nan along test; allowed: coordinates of numbers, texts or dates
solve(load=[UP, LoadPath("up", [[0.0, 1.0], [0.0, -0.5]])])
» load[1]: found <LoadPath up>, another load with the name of load[0]; allowed: a name of its own
solve(load=[UP, UP])
» load[1]: found <LoadPath up>, the same as load[0]; allowed: distinct values
solve(frequency_ratio="65/64")
» frequency_ratio: found '65/64' (numerator or denominator too large: the common period would be too long);
    allowed: a positive rational p/q with p, q ≤ 64
solve(frequency_ratio="64/65")
» frequency_ratio: found '64/65' (no small fraction: the common period of the two oscillations would be too
    long); allowed: a positive rational p/q with p, q ≤ 64
solve(frequency_ratio=0.123456789)
» frequency_ratio: found 0.123456789 (irrational, or no small fraction: the common period of the two
    oscillations would be too long); allowed: a positive rational p/q with p, q ≤ 64
solve(frequency_ratio=0)
» frequency_ratio: found 0 (not positive); allowed: a positive rational p/q with p, q ≤ 64
solve(friction=["sqrt(4", "2*", "1e308*pi", "sqrt(0-1)", "2 3"])
» friction[0]: found 'sqrt(4' (not a number, as where a * or a parenthesis is missing); allowed: a number in
    [0, 10]
» friction[1]: found '2*' (not a number, as where a * or a parenthesis is missing); allowed: a number in [0,
    10]
» friction[2]: found '1e308*pi' (not a finite number); allowed: a number in [0, 10]
» friction[3]: found 'sqrt(0-1)' (square root of a negative number); allowed: a number in [0, 10]
» friction[4]: found '2 3' (not a number, as where a * or a parenthesis is missing); allowed: a number in [0,
    10]
solve(phase=[[0, 1]], friction={0.1})
» phase: found [[0, 1]]; allowed: a single value or a one-dimensional sequence
» friction: found {0.1}; allowed: a single value or a one-dimensional sequence
""")


@pytest.mark.parametrize(("call", "lines"), TOLD)
def test_whole_messages(call: str, lines: list[str]) -> None:
    assert str(refused("", lambda: eval(call))).splitlines() == lines


@pytest.mark.parametrize(
    "given",
    [
        {"load": FAR, "normal_amplitude": 0.0},
        {"load": [UP, BULK], "bulk_stress_amplitude": 0.1},
        {"load": MEASURED, "normal_amplitude": 0.1},
        {"load": AT_LIMIT},
        {"load": LARGE, "normal_amplitude": 0.1, "tangential_amplitude": 0.05, "bulk_stress_amplitude": 0.1},
        {"load": SMOOTH, "normal_amplitude": 0.0, "tangential_force_amplitude": 0.4},
        {"profile": "cylinder", "load": UP, "tangential_force_amplitude": 0.4},
        {"criterion": ["swt"], "normal_sensitivity": 0.0, "walker_exponent": 0.4},
        {"criterion": "findley", "normal_sensitivity": 0.0, "walker_exponent": 0.5},
        {"frequency_ratio": ["64/63", "1/64", 64, "0.3333333333"]},
        {"profile": CAP, "normal_amplitude": 0.9},
    ],
)
def test_what_is_just_allowed(given: dict[str, Any], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("swtstudy.points.solve.solve_grid", lambda grid, *_: grid.size)
    assert solve(**given) == (
        4 if "frequency_ratio" in given else 2 if given.get("load") == [UP, BULK] else 1
    )
