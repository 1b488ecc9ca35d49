"""All that is said of points outside of the model's limits, word by word, of results that are made up."""

from typing import Any

import numpy as np
import pytest
import xarray as xr
from made_up import made_up
from told import sayings

from swtstudy.points.validity import outside, outside_words

NAN, INF = np.nan, np.inf
#: Numbers of regimes.
PARTIAL_SLIP, GROSS_SLIP, NOT_FINITE, NO_EQUILIBRIUM = 1, 2, 4, 5


def of_three(
    coords: dict[str, Any] | None = None, attrs: dict[str, str] | None = None, **variables: Any
) -> xr.Dataset:
    """Results at three phases, s = 1 in partial slip, but for some variables."""
    found = made_up(lambda phase: 0.0 * phase + 1.0, phase=[0.0, 1.0, 2.0])
    columns = {n: v if isinstance(v, xr.DataArray) else ("phase", np.array(v)) for n, v in variables.items()}
    return found.assign(columns).assign_coords(coords or {}).assign_attrs(attrs or {})


FORCES = {"tangential_force_amplitude": ("phase", [1.5, 1.0, 1.2])}
LOST_FORCES = {"regime": [5, 1, 5], "prescribed_force_ratio": [1.5, 1.0, 1.2]}
UNITS = {"attrs": {"contact": "{}"}}
PRESSURE = xr.DataArray([3.0, 4.0, 5.0], dims="phase", attrs={"units": "MPa"})

#: Results, the lines on what is outside, and that in a few words; then lines on what is inside.
TOLD = sayings(r"""
of_three()
of_three(yield_ratio=[0.5, 1.0, 1.25])
» beyond first yield at 1 of 3 points: largest von Mises stress over the yield strength up to 1.25, limit 1,
    at phase = 2
» Outside of the model: first yield at 1 of 3 points (1.25 of the strength).
of_three(yield_ratio=[0.5, 1.0, NAN])
» inside: largest von Mises stress over the yield strength up to 1, limit 1
of_three(yield_ratio=[NAN] * 3)
of_three(yield_ratio=[INF] * 3)
» beyond first yield at all 3 points: largest von Mises stress over the yield strength up to inf, limit 1, at
    phase = 0
» Outside of the model: first yield at all 3 points (inf of the strength).
of_three(radius_ratio=[0.05, 0.1, 0.2])
» contact too large for half-spaces at 1 of 3 points: contact radius over R up to 0.2, limit 0.1, at phase = 2
» Outside of the model: half-spaces at 1 of 3 points (0.2 of R).
of_three(slide_ratio=[0.1, 0.3, 0.2])
» slide too long for a contact that stays in place at 2 of 3 points: slide over contact radius up to 0.3,
    limit 0.1, at phase = 1
» Outside of the model: slide at 2 of 3 points (0.3 of the contact radius).
of_three(bulk_shift_ratio=[0.1, 0.2, 0.05])
» shift of the stick zone by bulk strain too large to be left out at 1 of 3 points: shift over the width of
    the slip zone up to 0.2, limit 0.1, at phase = 1; s is too low at the edge in tension, it should be up to
    6 % at 0.1, 24 % at 0.5, 38 % at 1 higher for Q ≥ 0.2 μP
» Outside of the model: stick-zone shift at 1 of 3 points (0.2 of the slip zone).
of_three(bulk_shift_ratio=[0.1, 0.2, NAN])
» shift of the stick zone by bulk strain unknown at 1 of 3 points: known of the paraboloid and the cylinder
    alone
» shift of the stick zone by bulk strain too large to be left out at 1 of 3 points: shift over the width of
    the slip zone up to 0.2, limit 0.1, at phase = 1; s is too low at the edge in tension, it should be up to
    6 % at 0.1, 24 % at 0.5, 38 % at 1 higher for Q ≥ 0.2 μP
» Outside of the model: shift of the stick zone by bulk strain unknown at 1 of 3 points; stick-zone shift at 1
    of 3 points (0.2 of the slip zone).
of_three(bulk_shift_ratio=[0.1, 0.2, NAN], regime=[1, 1, GROSS_SLIP])
» shift of the stick zone by bulk strain too large to be left out at 1 of 3 points: shift over the width of
    the slip zone up to 0.2, limit 0.1, at phase = 1; s is too low at the edge in tension, it should be up to
    6 % at 0.1, 24 % at 0.5, 38 % at 1 higher for Q ≥ 0.2 μP
» Outside of the model: stick-zone shift at 1 of 3 points (0.2 of the slip zone).
of_three(bulk_shift_ratio=[0.5, 0.2, 0.0], stick_zone=[1, 0, 0])
» shift of the stick zone by bulk strain too large to be left out at 1 of 3 points: shift over the width of
    the slip zone up to 0.2, limit 0.1, at phase = 1; s is too low at the edge in tension, it should be up to
    6 % at 0.1, 24 % at 0.5, 38 % at 1 higher for Q ≥ 0.2 μP
» stick zone left in place at 1 of 3 points, moved by the bulk stress at 1 of 3 points
» Outside of the model: stick-zone shift at 1 of 3 points (0.2 of the slip zone); stick zone left in place at
    1 of 3 points, moved by the bulk stress at 1 of 3 points.
of_three(bulk_shift_ratio=[0.5, 0.2, 0.0], stick_zone=[1, 2, 0])
» inside: shift over the width of the slip zone up to 0, limit 0.1
» inside: stick zone moved approximately at 1 of 3 points: the rise of the stress at the edge in tension is
    right within 4 %, or within 9 % where the bulk stress follows the tangential load but nearly
of_three(regime=[PARTIAL_SLIP, NOT_FINITE, NOT_FINITE], s=[1.0, INF, INF], status=[0, 0, 1])
» s is not finite at 1 of 3 points: swt grows without bound towards an edge
» Outside of the model: s is not finite at 1 of 3 points.
of_three(regime=[5, 5, 1])
» no equilibrium at 2 of 3 points: the normal force pulls at some instant, or the bodies never touch
» Outside of the model: no equilibrium at 2 of 3 points.
of_three(regime=[5, 5, 1], prescribed_force_ratio=[1.0, 1.0, 3.0])
» no equilibrium at 2 of 3 points: the normal force pulls at some instant, or the bodies never touch
» Outside of the model: no equilibrium at 2 of 3 points.
of_three(regime=[NO_EQUILIBRIUM] * 3, status=[1, 0, 0], prescribed_force_ratio=[9.0, 2.0, 1.5])
» no equilibrium at 2 of 3 points: the tangential force is up to 2 times μ F_N at phase = 1
» Outside of the model: no equilibrium at 2 of 3 points.
of_three(regime=[5, 5, 1], prescribed_force_ratio=[1.5, INF, 3.0])
» no equilibrium at 2 of 3 points: there is a tangential force while the normal force is 0 or pulls at phase =
    1
» Outside of the model: no equilibrium at 2 of 3 points.
of_three(**LOST_FORCES, coords={**FORCES, "normal_force_amplitude": 0.0})
» no equilibrium at 2 of 3 points: tangential_force_amplitude 1.5 exceeds 1, in μ F_N at phase = 0
» Outside of the model: no equilibrium at 2 of 3 points.
of_three(**LOST_FORCES, coords={**FORCES, "normal_amplitude": 0.0, "load": "harmonic"}, **UNITS)
» no equilibrium at 2 of 3 points: tangential_force_amplitude 1.5 exceeds μ F_N = 1 at phase = 0
» Outside of the model: no equilibrium at 2 of 3 points.
of_three(**LOST_FORCES, coords={**FORCES, "normal_force_amplitude": 0.5})
» no equilibrium at 2 of 3 points: the tangential force is up to 1.5 times μ F_N at phase = 0
» Outside of the model: no equilibrium at 2 of 3 points.
of_three(**LOST_FORCES, coords={**FORCES, "normal_amplitude": 0.5})
» no equilibrium at 2 of 3 points: the tangential force is up to 1.5 times μ F_N at phase = 0
» Outside of the model: no equilibrium at 2 of 3 points.
of_three(**LOST_FORCES, coords={**FORCES, "normal_amplitude": 0.0, "load": "loop"})
» no equilibrium at 2 of 3 points: the tangential force is up to 1.5 times μ F_N at phase = 0
» Outside of the model: no equilibrium at 2 of 3 points.
of_three(**LOST_FORCES, coords={**FORCES, "normal_amplitude": 0.0, "load": ("phase", ["harmonic", "harmonic",
    "loop"])})
» no equilibrium at 2 of 3 points: the tangential force is up to 1.5 times μ F_N at phase = 0
» Outside of the model: no equilibrium at 2 of 3 points.
of_three(**LOST_FORCES, coords={"normal_amplitude": 0.0})
» no equilibrium at 2 of 3 points: the tangential force is up to 1.5 times μ F_N at phase = 0
» Outside of the model: no equilibrium at 2 of 3 points.
of_three(s_surface=[1.0, 3.0, 1.5])
» s is not the largest value at 2 of 3 points: s_surface is up to 3 times as large at phase = 1
» Outside of the model: s is not the largest value at 2 of 3 points.
of_three(s=[1.0, 0.0, 2.0], s_surface=[1.5, 1.0, 2.0])
» s is not the largest value at 2 of 3 points: s is 0, and s_surface is not, at phase = 1
» Outside of the model: s is not the largest value at 2 of 3 points.
# Within the error of s it is no other value.
of_three(s_surface=[1.0, 1.0 + 0.9e-6, 1.0])
of_three(s=[NAN, 1.0, 1.0], s_surface=[NAN, NAN, 1.0], critical_x=[0.0] * 3)
» critical point at the singular edge of the face at 1 of 3 points: off the line y = 0 swt may have no bound
    there
» Outside of the model: critical point at the singular edge of the face at 1 of 3 points.
of_three(critical_x=[0.0, 1.0, -1.0], coords={"exponent": 1.5})
» swt is largest at the tip at 1 of 3 points: s depends on how a real tip is rounded
» Outside of the model: swt is largest at the tip at 1 of 3 points.
of_three(critical_x=[0.0, -1e-13, 0.0], coords={"exponent": ("phase", [1.5, 1.9, 2.0])})
» swt is largest at the tip at 2 of 3 points: s depends on how a real tip is rounded
» Outside of the model: swt is largest at the tip at 2 of 3 points.
of_three(peak_pressure=PRESSURE, **UNITS)
» inside: peak_pressure up to 5 MPa; whether that yields is unknown without a yield_strength
of_three(peak_pressure=PRESSURE, yield_ratio=[0.3] * 3, **UNITS)
» inside: largest von Mises stress over the yield strength up to 0.3, limit 1
of_three(peak_pressure=PRESSURE)
# Percentiles go with their life, and a life that is infinite is none that is too long.
of_three(cycles=[5.0, 1e3, 2e8], cycles_10=[1.0] * 3, cycles_volume=[5.0, 5.0, INF], cycles_line=[1e4, 1e4,
    6.0], FS_cycles=[1e2, 1e7, NAN], FS_cycles_point=[1.0, 1e4, 1e4], SWT=[1.0, 2.0, 3.0], **UNITS)
» cycles extrapolated at 2 of 3 points: 5 to 2·10⁸, while the constants are known for 100 to 10⁷
» cycles_volume extrapolated at 2 of 3 points: 5, while the constants are known for 100 to 10⁷
» cycles_line extrapolated at 1 of 3 points: 6, while the constants are known for 100 to 10⁷
» FS_cycles_point extrapolated at 1 of 3 points: 1, while the constants are known for 100 to 10⁷
» Outside of the model: cycles, cycles_volume extrapolated at 2 of 3 points and cycles_line, FS_cycles_point
    extrapolated at 1 of 3 points (beyond 100 to 10⁷).
of_three(cycles=[5.0, 1e3, 2e8])
""")


@pytest.mark.parametrize(("results", "said"), TOLD)
def test_what_is_said_of_limits(results: str, said: list[str]) -> None:
    found = eval(results)
    lines, words = found.swt.validity(), outside_words(found)
    inside = found.swt.validity(inside=True)
    assert inside[: len(lines)] == lines
    assert [*lines, *[words] * bool(words), *(f"inside: {each}" for each in inside[len(lines) :])] == said


def test_which_values_are_outside() -> None:
    """Of the points, of what has further dimensions, and of what lacks one; the words say of which limits."""
    beyond = {"yield_ratio": [0.5, 1.5, 1.0], "slide_ratio": [0.0, 0.0, 0.2], "s_surface": [2.0, 1.0, 1.0]}
    beyond |= {"bulk_shift_ratio": [0.5, 0.5, NAN], "stick_zone": [1, 2, 0]}
    lives = xr.DataArray([[1e3, 1e3, 1e3], [1e3, INF, 5.0]], dims=("place", "phase"))
    found = of_three(**beyond, cycles=lives, worst=xr.DataArray(1.0), **UNITS)
    everything = "outside: first yield, slide, the line y = 0"
    for name, expected, words in (
        ("s", [True, True, True], everything),
        ("s_surface", [False, True, True], "outside: first yield, slide"),
        ("cycles", [[True] * 3, [True] * 3], f"{everything}, extrapolated life"),
        ("worst", True, everything),
    ):
        told = outside(found, found[name])
        assert told.dims == found[name].dims
        assert told.values.tolist() == expected
        assert told.attrs == {"long_name": words}
    inside = of_three(cycles=[1e2, 1e7, 5.0], attrs={"contact": "{}"})
    assert outside(inside, inside.s).attrs == {"long_name": "outside: "}
    assert outside(inside, inside.cycles).values.tolist() == [False, False, True]


def test_a_point_without_coordinates_has_its_number() -> None:
    found = of_three(yield_ratio=[0.5, 1.0, 1.25]).drop_vars("phase")
    assert found.swt.validity()[0].endswith("up to 1.25, limit 1, at phase = 2")
    flat = (
        of_three(yield_ratio=[0.5, 1.25, 1.0]).expand_dims(friction=[0.3]).stack(point=["friction", "phase"])
    )
    assert flat.swt.validity()[0].endswith(", at friction = 0.3, phase = 1")
