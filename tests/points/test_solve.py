import inspect
import pickle
import re
from decimal import Decimal
from fractions import Fraction

import dask
import dask.array
import numpy as np
import pytest
import stand_in
import xarray as xr
from real import ALUMINIUM
from told import RIG, refused, warned

import swtstudy
from swtstudy import solve


def test_dimensions_in_the_order_given():
    dataset = solve(phase=[0, 1.5, 3.0], profile="paraboloid", normal_amplitude=[0.25, 0.75], rtol=1e-2)
    assert dataset.s.dims == ("phase", "normal_amplitude")
    assert set(dataset.data_vars) == {"s", "s_error", "critical_x", "critical_angle", "regime", "s_surface"}
    assert dataset.friction.ndim == 0
    assert dataset.friction.item() == 0.3
    assert dataset.profile.item() == "paraboloid"
    assert (dataset.s > 0).all()


def test_scalars_give_scalars():
    dataset = solve(phase=np.float64(0.5), frequency_ratio=Fraction(3, 2), friction=np.array(0.2), rtol=1e-2)
    assert dataset.s.ndim == 0
    assert dataset.frequency_ratio.item() == 1.5
    assert dataset.frequency_ratio.attrs["fractions"] == "3/2"


@pytest.mark.parametrize(
    "one", [np.float32(0.25), Decimal("0.25"), Fraction(1, 4), np.array(0.25), xr.DataArray(0.25), "1/4"]
)
def test_any_plain_number_is_a_number_everywhere(one):
    dataset = solve(friction=one, phase=[one, 1], rtol=np.float32(0.05))
    assert dataset.friction.item() == dataset.phase.values[0] == 0.25
    if not isinstance(one, str):
        quarter = one / 4 if isinstance(one, Decimal | Fraction) else one * 0.25
        assert solve(rtol=quarter).attrs["rtol"] == 0.0625
        with pytest.raises(ValueError, match="rtol: found"):
            solve(rtol=one)


@pytest.mark.parametrize("values", [[0, 1], (0, 1), range(2), np.array([0, 1]), np.array([0.0, 1.0])])
def test_any_one_dimensional_sequence_is_a_dimension(values):
    assert solve(phase=values, rtol=1e-2).sizes == {"phase": 2}


def test_symmetric_phases_are_mirrored():
    dataset = solve(phase=[0.7, 0.7 + np.pi, "7/10 + 2*pi"], rtol=1e-2)
    s, x, angle = dataset.s.values, dataset.critical_x.values, dataset.critical_angle.values
    assert s[0] == s[1] == s[2]
    assert x[0] == -x[1] == x[2]
    assert angle[0] == -angle[1] == angle[2]


def test_zero_has_no_sign():
    # Without friction's traction the critical plane is across x, also where the phase is mirrored.
    dataset = solve(tangential_amplitude=0, phase=[0, 4, 6], rtol=1e-2)
    zeros = dataset.critical_angle.values[dataset.critical_angle.values == 0.0]
    assert zeros.size
    assert not np.signbit(zeros).any()


def test_the_order_of_values_does_not_matter():
    forth = solve(phase=[0.1, 0.9, 2.5], friction=[0.2, 0.6], rtol=1e-2)
    back = solve(friction=[0.6, 0.2], phase=[2.5, 0.9, 0.1], rtol=1e-2)
    assert (back.s.transpose(*forth.s.dims).values[::-1, ::-1] == forth.s.values).all()


@pytest.mark.parametrize(
    ("parameters", "message"),
    [
        ({"friction": float("nan")}, "not a finite number"),
        ({"friction": None}, "not a number"),
        ({"µ": 0}, r"did you mean friction \(μ\)\?"),
        ({"G*uA": 0}, r"did you mean tangential_amplitude \(uA\)\?"),
        ({"Poisson": 0}, r"did you mean poisson_ratio\?"),
        ({"phase": [[0, 1]]}, "one-dimensional"),
        ({"profile": "Sphere"}, r"allowed: did you mean paraboloid \(sphere\)\?"),
        ({"criterion": "FS"}, r"allowed: did you mean fatemi_socie \(FS\)\?"),
        ({"rtoll": 1e-3}, r"rtoll: found unknown .* did you mean rtol\?"),
        ({"rtol": float("nan")}, "rtol"),
        ({"friction": 10**5000}, "found int with too many digits"),
        ({"friction": [[10**5000]]}, "found list with too many digits"),
        ({"friction": np.ma.array(1.0, mask=True)}, "not a number"),
        ({"friction": np.array([True])}, "not a number"),
        ({"friction": b"0.3"}, "not a number"),
        ({"friction": {"start": 0.1, "stop": 0.3}}, "one-dimensional"),
        ({"friction": iter([0.1, 0.3])}, "one-dimensional"),
        ({"phase": bytearray(b"a")}, "not a number"),
        ({"phase": memoryview(b"a")}, "not a number"),
        ({"phase": xr.Dataset({"a": 1.0})}, "one-dimensional"),
        ({"phase": type("Shy", (), {"__repr__": lambda self: 1 / 0})()}, "found Shy that cannot be shown"),
        ({"friction": np.ma.array([1.0, 2.0], mask=[0, 1])}, "found masked .not a number"),
    ],
)
def test_bad_input_is_a_value_error(parameters, message):
    with pytest.raises(ValueError, match=message):
        solve(**parameters)


def test_the_package_exports_lazily():
    assert dir(swtstudy) == sorted(swtstudy.__all__)
    assert all(hasattr(swtstudy, name) for name in dir(swtstudy))
    with pytest.raises(AttributeError):
        swtstudy.nothing  # noqa: B018


FORCES = dask.array.from_array([100.0, 200.0], chunks=1)


def test_axes_of_dask_are_solved_lazily_and_give_the_same_bits():
    given = {"normal_amplitude": [0.25, 0.75], "rtol": 1e-2, "quantities": ["dissipation"]}
    phase = np.linspace(0.0, 6.0, 3)
    now = swtstudy.solve(phase=phase, **given)
    later = swtstudy.solve(phase=dask.array.from_array(phase, chunks=2), **given)
    assert later.s.chunks == ((2, 1), (2,))
    assert {name for name in later if dask.is_dask_collection(later[name].data)} == {*now.data_vars}
    xr.testing.assert_identical(later.compute(scheduler="threads"), now)


@pytest.mark.slow
def test_lazy_means_have_their_own_dimensions():
    given = {"critical_distance": [0.1, 0.2], "rtol": 0.1}
    later = swtstudy.solve(phase=dask.array.from_array([0.5], chunks=1), **given)
    xr.testing.assert_identical(later.compute(), swtstudy.solve(phase=[0.5], **given))


def test_axes_of_dask_are_solved_when_they_are_computed_and_once(monkeypatch):
    counting = stand_in.Counting()
    monkeypatch.setattr(stand_in.SOLVER, counting)
    later = swtstudy.solve(phase=dask.array.from_array(np.linspace(0.1, 3.0, 6), chunks=3), rtol=1e-2)
    assert counting.points == 0
    later.compute()
    assert counting.points == 6


@pytest.mark.parametrize("axis", ["phase", "frequency_ratio"])
def test_an_axis_without_effect_is_warned_of(axis):
    loop = swtstudy.LoadPath("to and fro", [[0.0, 0.5], [0.0, -0.5]])
    with pytest.warns(UserWarning, match=f"^{axis} has no effect: what it is of does not oscillate"):
        found = swtstudy.solve(load=loop, **{axis: [1, 2]}, rtol=1e-2)
    assert found.s[0] == found.s[1]


@pytest.mark.parametrize("geometry", ["axisymmetric", "plane"])
def test_a_table_smoothed_by_much_of_its_rise_is_warned_of(geometry):
    """Its contact at the mean load is 1 wide, where it rises by 0.5."""
    radius, forces = (
        np.linspace(0.0, 2.0, 200),
        {"normal_force_amplitude": 0.2, "tangential_force_amplitude": 0.1},
    )
    rough = swtstudy.TabulatedProfile("pad", radius, 0.5 * radius**2, 0.0055, geometry)
    with pytest.warns(
        UserWarning, match=r"^profile pad: its smoothing is 0.011 of its rise within the contact"
    ):
        swtstudy.solve(profile=rough, **forces, rtol=1e-2)
    fine = swtstudy.TabulatedProfile("pad", radius, 0.5 * radius**2, 0.0045, geometry)
    _, told = warned(swtstudy.solve, profile=fine, **forces, rtol=1e-2)
    assert told == []


def test_arrays_of_dask_are_sequences_of_contacts():
    rig = {"young_modulus": 7e4, "poisson_ratio": 0.3, "radius": 50.0, "friction": 0.5}
    pull = {"tangential_force_amplitude": 20.0}
    contacts = (swtstudy.physical(**rig, **pull, normal_force=each) for each in ([100, 200], FORCES))
    one, other = (each.solve(rtol=1e-2) for each in contacts)
    xr.testing.assert_identical(one, other)


def test_lazy_results_can_be_pickled():
    later = swtstudy.solve(phase=dask.array.from_array([0.1, 3.0], chunks=1), rtol=1e-2)
    xr.testing.assert_identical(pickle.loads(pickle.dumps(later)).compute(), later.compute())


def test_axes_of_dask_are_checked_at_once():
    refused("friction", swtstudy.solve, friction=dask.array.from_array([0.1, -1.0], chunks=1))


@pytest.mark.parametrize(
    "function", [swtstudy.solve, swtstudy.physical, swtstudy.optimise, swtstudy.read_signal]
)
def test_help_lists_every_parameter(function):
    names = {*inspect.signature(function).parameters} - {"rtol"}
    assert not names & {"parameters", "given"}
    text = inspect.getdoc(function)
    for name in names:
        assert re.search(rf"^(?:.*, )?{name}(?:, .*)?$", text, re.MULTILINE), name
    if function is not swtstudy.read_signal:
        assert {"friction", "phase", "profile", "walker_exponent"} <= names
        assert "friction\n    coefficient of friction, μ; a number in [0, 10]" in text


def test_arrays_over_one_dimension_are_a_list_of_points():
    table = {"friction": [0.1, 0.4, 0.4], "frequency_ratio": ["1/2", 1, "1/2"], "phase": [0.0, 3.0, 5.0]}
    arrays = {n: xr.DataArray(v, dims="test", coords={"test": [*"abc"]}) for n, v in table.items()}
    beside = {"normal_amplitude": [0.25, 0.75], "quantities": ["dissipation"], "rtol": 1e-2}
    found = swtstudy.solve(**arrays, **beside)
    assert found.s.dims == ("test", "normal_amplitude")
    assert found.indexes["test"].tolist() == [*"abc"]
    assert found.friction.dims == ("test",)
    for i in range(3):
        one = swtstudy.solve(**{name: values[i] for name, values in table.items()}, **beside)
        xr.testing.assert_equal(
            found.isel(test=i, drop=True)[[*one]].reset_coords(drop=True), one.reset_coords(drop=True)
        )
    lazy = swtstudy.solve(**{name: array.chunk(test=2) for name, array in arrays.items()}, **beside)
    assert lazy.s.chunks == ((2, 1), (2,))
    xr.testing.assert_identical(lazy.compute(), found)


def test_a_list_of_points_may_be_along_one_of_its_parameters():
    phase = xr.DataArray([0.0, 3.0], dims="phase")
    found = swtstudy.solve(phase=phase, friction=xr.DataArray([0.2, 0.3], dims="phase"), rtol=1e-2)
    assert found.indexes["phase"].tolist() == [0.0, 3.0]
    assert found.sel(phase=3.0).friction == 0.3


def test_a_list_of_contacts():
    table = {"normal_force": [100.0, 200.0], "tangential_force_amplitude": [20.0, 30.0]}
    contacts = swtstudy.physical(**RIG, **{n: xr.DataArray(v, dims="test") for n, v in table.items()})
    assert contacts.peak_pressure.dims == ("test",)
    found = contacts.solve(rtol=1e-2)
    assert found.SWT.dims == ("test", "body")
    for i in range(2):
        one = swtstudy.physical(**RIG, **{name: values[i] for name, values in table.items()}).solve(rtol=1e-2)
        np.testing.assert_array_equal(found.SWT[i], one.SWT)


def test_a_list_of_contacts_has_bodies_and_no_sum_of_loads():
    forces = {
        "normal_force": [100.0, 200.0],
        "tangential_force_amplitude": [2.0, 2.0],
        "poisson_ratio": [0.2, 0.4],
    }
    arrays = {name: xr.DataArray(values, dims="test") for name, values in forces.items()}
    contacts = swtstudy.physical(**RIG | arrays)
    one = swtstudy.physical(**RIG | {name: values[1] for name, values in forces.items()})
    np.testing.assert_array_equal(contacts.solve(rtol=1e-2).SWT[1], one.solve(rtol=1e-2).SWT)
    along = xr.DataArray([0.1, 0.2], dims="test")
    refused("^critical_distance: found a value for each", contacts.solve, critical_distance=along)
    loads = xr.DataArray(np.empty(2, object), dims="test")
    loads[:] = [swtstudy.LoadPath(name, [[0.0, 1.0], [0.0, -1.0]]) for name in "ab"]
    loaded = swtstudy.physical(**RIG | arrays, load=loads)
    refused("^blocks: found a load of each point", loaded.solve, constants=ALUMINIUM, blocks={"a": 1, "b": 2})


#: Different loops.
TWO_OF_A_NAME = [swtstudy.LoadPath("a", [[0.0, end], [0.0, -1.0]]) for end in (1.0, 0.5)]


@pytest.mark.parametrize(
    ("dim", "given", "words"),
    [
        ("test", {"friction": [0.1, -0.2]}, r"^friction: found -0.2 \(out of range\) at \[1\]"),
        (
            "test",
            {"friction": [0.1]},
            "^phase, friction: found lengths or coordinates that differ along test",
        ),
        ("test", {"critical_distance": [0.1, 0.2]}, "^critical_distance: found a value for each point"),
        ("regime", {"friction": [0.1, 0.2]}, "^phase, friction: found DataArrays over 'regime', a name in"),
        ("control", {"friction": [0.1, 0.2]}, "^phase, friction: found DataArrays over 'control'"),
        ("SWT", {"friction": [0.1, 0.2]}, "^phase, friction: found DataArrays over 'SWT'"),
        ("", {"friction": [0.1, 0.2]}, "^phase, friction: found DataArrays over ''"),
        ("test", {"load": [*TWO_OF_A_NAME]}, "^load: found another load with the name of"),
        ("test", {"phase": [*np.array([1, 2], "m8[s]")], "friction": [1, 2]}, "^phase: .*not a number"),
    ],
)
def test_mistakes_in_a_list_of_points(dim, given, words):
    arrays = {}
    for name, values in {"phase": [1.0, 2.0], **given}.items():
        arrays[name] = xr.DataArray(np.empty(len(values), object) if name == "load" else values, dims=dim)
        arrays[name][:] = values
    error = refused(words, swtstudy.solve, **arrays)
    assert len(error.mistakes) == 1


@pytest.mark.parametrize("labels", [["a", "b"], [10, 20], np.array(["2026-01-30", "2026-02-01"], "M8[s]")])
def test_labels_of_a_list_stay(labels):
    arrays = {name: xr.DataArray([0.1, 0.2], {"test": labels}, "test") for name in ("friction", "phase")}
    found = swtstudy.solve(**arrays, rtol=1e-2)
    assert found.test.values.tolist() == arrays["phase"].test.values.tolist()
    assert f"test = {str(found.test.values[1])[:10]}" in repr(found.swt)


def test_a_label_that_is_no_name_of_a_point():
    arrays = {n: xr.DataArray([0.1, 0.2], {"test": [1, np.nan]}, "test") for n in ("friction", "phase")}
    refused(
        "^friction, phase: found nan along test; allowed: coordinates of numbers", swtstudy.solve, **arrays
    )


def test_there_is_one_list_of_points():
    one, other = (xr.DataArray([0.1, 0.2], dims=dim) for dim in ("test", "case"))
    words = (
        "^poisson_ratio, walker_exponent: found another list of points, over case; allowed: one list, over"
    )
    refused(words, swtstudy.solve, friction=one, phase=one, poisson_ratio=other, walker_exponent=other)


def test_lists_of_points_are_no_grid():
    """Three lists of 3,000 values would be 27 billion points."""
    names = ("friction", "phase", "normal_amplitude")
    with pytest.raises(ValueError, match=r"27000000000 points are too many .* \[sample\]"):
        swtstudy.solve(**dict.fromkeys(names, np.linspace(0.1, 0.9, 3000)))
