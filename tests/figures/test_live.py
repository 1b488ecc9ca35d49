"""The live figure: what it draws is what the solver and the memory diagram say, also after a slider moves."""

import numpy as np
import pytest
from folders import ROOT, STUDIES

import swtstudy
from swtstudy.figures.live import SLIDERS, Explorer, LiveFigure, phases
from swtstudy.results.inspection import load_and_springs
from swtstudy.vocabulary.parameters import PAIRS, PARAMETERS

NOTEBOOK = STUDIES / "explore_live.ipynb"


@pytest.fixture
def live():
    pytest.importorskip("ipywidgets")
    return Explorer()


def test_the_panels_are_those_of_the_point():
    live = LiveFigure()
    given = {"phase": 1.0, "frequency_ratio": "1/2", "friction": 0.4}
    live.redraw(**{**given, "friction": 0.7})
    point = live.redraw(**given)
    load, springs, over_phase = live.figure.axes
    t = np.linspace(0.0, 4.0 * np.pi, 2001)
    path = next(line for line in load.get_lines() if line.get_color() == "black")
    # The path of the paper's eqs. (7, 8), each of its instants once: nothing of the former point is left.
    assert path.get_xdata().max() == pytest.approx((5 / 6 * np.sin(t / 2)).max(), rel=1e-5)
    for u, depth in path.get_xydata()[::97]:
        distance = np.hypot(5 / 6 * np.sin(t / 2) - u, 1.0 + 0.75 * np.sin(t + 1.0) - depth)
        assert distance.min() < 0.01
    assert sum(line.get_color() == "black" for line in load.get_lines()) == 1
    curve, dot = over_phase.get_lines()[:2]
    alone = swtstudy.solve(**{**given, "phase": [0.0, 1.0, np.pi]}, rtol=1e-4)
    assert dot.get_ydata() == pytest.approx(alone.s.values[1:2], rel=1e-3)
    drawn = np.interp([0.0, 1.0, np.pi], curve.get_xdata(), curve.get_ydata())
    assert drawn == pytest.approx(alone.s.values, rel=1e-3)
    assert float(point.s) == dot.get_ydata()[0]
    assert len(springs.get_legend().get_texts()) == 4


def test_the_springs_are_those_of_the_inspection():
    given = {"phase": 1.0, "frequency_ratio": "1/2", "profile": "rounded_punch", "flat_radius": 0.3}
    found, known = load_and_springs(**given), swtstudy.inspect_point(**given)
    assert float(found.largest_radius) == pytest.approx(float(known.largest_radius), rel=1e-12)
    for time in ("depth", "displacement", "normal_force", "tangential_force"):
        at = np.linspace(0.1, 4.0 * np.pi - 0.1, 50)
        drawn = np.interp(at, found.time, found[time])
        assert drawn == pytest.approx(np.interp(at, known.time, known[time]), abs=1e-4)
    # Instants of both: of the largest and the smallest depth.
    for reason in ("δ largest", "δ smallest"):
        one = found.isel(instant=(found.reason == reason).values.argmax())
        assert reason in found.reason
        assert float(one.compression[0]) == pytest.approx(
            1.0 + 0.75 * (1 if "largest" in reason else -1), abs=1e-4
        )
        assert (np.abs(one.force) <= one.compression + 1e-12).all()
        same = known.isel(instant=np.flatnonzero(known.reason == reason))
        if same.instant.size:
            force = np.interp(known.r, one.r, one.force, right=0.0)
            assert force == pytest.approx(same.force.values[0], abs=1e-2)


@pytest.mark.slow
def test_a_slider_may_stop_at_a_phase_of_the_curve_but_for_rounding():
    live = LiveFigure()
    for phase in (phases(1)[2] * (1 + 1e-15), phases(1)[3] * (1 - 4e-16), 2.0 * np.pi, 2.0 * np.pi + 1e-15):
        alone = swtstudy.solve(phase=phase, rtol=1e-4)
        assert float(live.redraw(phase=phase).s) == pytest.approx(float(alone.s), rel=1e-3)


@pytest.mark.slow
def test_the_curve_has_each_period_of_s_alike():
    for ratio, periods in (("1/2", 1), (1, 2), ("3/2", 3), ("4/3", 8), (2, 4)):
        over = phases(ratio)
        step = len(over) // periods
        s = swtstudy.solve(frequency_ratio=ratio, phase=over[: 2 * step], rtol=1e-1).s.values
        if periods > 1:
            assert s[:step] == pytest.approx(s[step:], rel=1e-9)
        assert len(over) == max(72, 36 * periods) + 1


@pytest.mark.slow
def test_a_slider_redraws(live):
    before = live.picture.value
    live.controls["friction"].value = 0.6
    assert live.picture.value != before
    live.controls["phase"].value = 1.3
    known = swtstudy.solve(friction=0.6, phase=1.3, tangential_amplitude=0.83, rtol=1e-4)
    assert float(live.point.s) == pytest.approx(float(known.s), rel=1e-3)
    assert f"s = {float(live.point.s):.4f}</b>, gross slip" in live.caption.value
    # Only what the profile has is shown, and is a parameter.
    live.controls["profile"].value = "wavy_paraboloid"
    assert {"waviness_amplitude", "wavelength"} <= set(live.parameters)
    assert "flat_radius" not in live.parameters
    shown = {name for name, each in live.controls.items() if each.layout.display != "none"}
    assert set(SLIDERS) - shown == {"flat_radius", "flat_half_width", "exponent"}


def test_forces_without_equilibrium_are_said_and_leave_the_picture(live):
    before = live.picture.value
    live.controls["control"].value = "forces"
    assert "no equilibrium" in live.caption.value
    assert live.picture.value == before
    assert live.controls["tangential_amplitude"].description == "tangential force amplitude, QA/(μF0)"
    live.controls["normal_amplitude"].value = 0.5
    live.controls["tangential_amplitude"].value = 0.3
    assert "no equilibrium" not in live.caption.value
    assert live.picture.value != before
    assert live.parameters["tangential_force_amplitude"] == 0.3


def test_every_slider_is_within_what_is_allowed():
    numbers = {n for n, each in PARAMETERS.items() if each.kind == "number" and n not in PAIRS}
    # It has none with the criterion of the sliders.
    assert set(SLIDERS) == numbers - {"normal_sensitivity"}
    assert {SLIDERS[name][:2] for name in ("phase", "bulk_stress_phase")} == {(0.0, 2.0 * np.pi)}
    for name, (low, high, step, begin) in SLIDERS.items():
        each = PARAMETERS[name]
        assert each.lower <= low < low + step <= begin + step <= high + step <= each.upper + step
        assert low > each.lower or not each.open_lower


@pytest.mark.pages
@pytest.mark.filterwarnings("ignore")  # the machinery around the kernel has its own
def test_the_notebook(monkeypatch):
    pytest.importorskip("ipywidgets")
    pytest.importorskip("ipykernel")
    nbformat, nbclient = pytest.importorskip("nbformat"), pytest.importorskip("nbclient")
    notebook = nbformat.read(NOTEBOOK, as_version=4)
    moved = 'live.controls["phase"].value = 2.0\nprint(float(live.point.s))'
    notebook.cells.append(nbformat.v4.new_code_cell(moved))
    monkeypatch.setenv("PYTHONPATH", str(ROOT))
    monkeypatch.setenv("OMP_NUM_THREADS", "1")
    nbclient.NotebookClient(
        notebook, timeout=120, kernel_name="python3", resources={"metadata": {"path": str(NOTEBOOK.parent)}}
    ).execute()
    shown = notebook.cells[1].outputs[0]["data"]
    assert "application/vnd.jupyter.widget-view+json" in shown
    s = swtstudy.solve(phase=2.0, tangential_amplitude=0.83, rtol=1e-4).s
    assert float(notebook.cells[-1].outputs[0]["text"]) == pytest.approx(float(s), rel=1e-3)


@pytest.mark.slow
def test_the_curve_misses_little_of_the_least_value():
    given, live = {"phase": 1.0, "normal_amplitude": 0.85}, LiveFigure()
    live.redraw(**given)
    dense = swtstudy.solve(phase=np.linspace(0.0, np.pi, 241), normal_amplitude=0.85, rtol=1e-3).s
    assert np.nanmin(live.figure.axes[2].get_lines()[0].get_ydata()) < 1.02 * float(dense.min())
