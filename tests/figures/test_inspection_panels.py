"""What each panel of the picture of one point draws, against numbers that do not come from the panels."""

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import to_hex, to_rgba
from matplotlib.figure import Figure

import swtstudy
from swtstudy.figures import point as panels
from swtstudy.figures.point import STATE_COLOURS, draw_forces, limits

#: Cattaneo's: every number in the picture is known. The largest swt is at x = −1, where it trails.
CATTANEO = {"normal_amplitude": 0, "tangential_amplitude": 0.36, "friction": 0.5}
MOVING = {"frequency_ratio": "1/2", "phase": 0.4, "normal_amplitude": 0.5}


@pytest.fixture(scope="module")
def cattaneo():
    return swtstudy.inspect_point(**CATTANEO)


@pytest.fixture(scope="module")
def moving():
    return swtstudy.inspect_point(**MOVING)


@pytest.fixture
def axes():
    return Figure().subplots()


def levels(axes, upright):
    """Places of the lines across the whole panel."""
    lines = (
        line.get_xdata() if upright else line.get_ydata() for line in axes.lines if len(line.get_xdata()) == 2
    )
    return sorted(float(ends[0]) for ends in lines if ends[0] == ends[1])


def numbers(axes):
    """The numbered discs: number and place."""
    return {int(text.get_text()): text.get_position() for text in axes.texts if text.get_text().isdigit()}


def curves_of(axes, count):
    """Curves of so many points: those of the instants, and two bounds for each of them."""
    curves = [line for line in axes.lines if len(line.get_xdata()) == count]
    named = [line for line in curves if line.get_label().startswith("instant")]
    bounds = [line.get_ydata() for line in curves if line not in named]
    assert len(bounds) == 2 * len(named)
    return named, list(zip(bounds[::2], bounds[1::2], strict=True))


def test_slip(cattaneo, axes):
    panels.draw_slip(axes, cattaneo)
    # Stick for r < c = √(1 − U) always; the critical point is at the edge r = a.
    assert levels(axes, False) == pytest.approx([0.8, 1.0], abs=1e-6)
    assert abs(float(cattaneo.critical_x)) == pytest.approx(1.0, abs=1e-6)
    np.testing.assert_allclose(axes.lines[0].get_ydata(), 1.0)
    assert levels(axes, True) == pytest.approx(cattaneo.instant_time.values)
    top = axes.get_ylim()[1]
    assert axes.get_ylim() == pytest.approx((0.0, 1.15))
    for number, place in numbers(axes).items():
        assert place == pytest.approx((float(cattaneo.instant_time[number - 1]), 0.95 * top))
    words = [text.get_text() for text in axes.get_legend().get_texts()]
    assert words == ["stick", "forward slip", "backward slip", "critical point", "always sticks"]
    mesh = axes.images[0]
    np.testing.assert_array_equal(
        np.asarray(mesh.get_array()).reshape(cattaneo.state.T.shape), cattaneo.state.T
    )


def test_cells_of_the_slip_map(axes):
    """A cell goes half way to its neighbours, also where these are not equally far."""
    states = swtstudy.slip_map([0.2, 0.9, 1.4], time=[0.0, 1.0, 2.0, 3.0], phase=0.5)
    patches = panels.draw_slip_map(axes, states)
    canvas = FigureCanvasAgg(axes.figure)
    axes.set(ylim=(0.0, 1.65), autoscale_on=False)
    axes.lines[0].set_visible(False)  # the edge of the contact
    canvas.draw()
    seen = np.asarray(canvas.buffer_rgba())
    for r, row in ((0.02, 0), (0.5, 0), (0.6, 1), (1.1, 1), (1.2, 2)):
        for column in (1, 2):
            across, up = axes.transData.transform((column + 0.3, r))
            colour = seen[seen.shape[0] - 1 - round(up), round(across)] / 255.0
            code = int(states.state.transpose("r", "time")[row, column])
            assert colour == pytest.approx(to_rgba(patches[code].get_facecolor()), abs=0.01)
    np.testing.assert_array_equal(axes.lines[0].get_ydata(), states.contact_radius)


def test_springs(cattaneo, axes):
    """Springs of the paraboloid: w = 1 − ξ²; at the turning points τ = ±min(w, U)."""
    panels.draw_springs(axes, cattaneo)
    radius = cattaneo.r.values
    w = np.maximum(1.0 - radius**2, 0.0)
    named, bounds = curves_of(axes, len(radius))
    assert [line.get_label() for line in named] == [f"instant {number}" for number in cattaneo.instant.values]
    for upper, lower in bounds:
        np.testing.assert_allclose(upper, w, atol=1e-12)
        np.testing.assert_allclose(lower, -w, atol=1e-12)
    turning = 0
    for time, line in zip(cattaneo.instant_time.values, named, strict=True):
        u = 0.36 * np.sin(time)
        if abs(u) > 0.36 - 1e-9:
            turning += 1
            np.testing.assert_allclose(line.get_ydata(), np.sign(u) * np.minimum(w, 0.36), atol=1e-9)
    assert turning == 2
    assert axes.get_xlim() == pytest.approx((0.0, 1.05))


def test_tractions(cattaneo, axes):
    """q between ±μ p, with the μ of the point: p = 2/π √(1 − r²) over E* √(δ0/R)."""
    panels.draw_tractions(axes, cattaneo)
    x = cattaneo.x.values
    p = 2 / np.pi * np.sqrt(np.maximum(1.0 - x**2, 0.0))
    named, bounds = curves_of(axes, len(x))
    for line in named:
        np.testing.assert_array_equal(line.get_xdata(), x)
    for upper, lower in bounds:
        np.testing.assert_allclose(upper, 0.5 * p, atol=1e-9)
        np.testing.assert_allclose(lower, -0.5 * p, atol=1e-9)
    less = 2 / np.pi * np.sqrt(np.maximum(0.64 - x**2, 0.0))
    turning = 0
    for time, line in zip(cattaneo.instant_time.values, named, strict=True):
        for turn, sense in ((np.pi / 2, 1.0), (3 * np.pi / 2, -1.0)):
            if abs(time - turn) < 1e-9:
                turning += 1
                np.testing.assert_allclose(line.get_ydata(), sense * 0.5 * (p - less), atol=1e-9)
    assert turning == 2
    assert axes.get_xlim() == pytest.approx((-1.08, 1.08))
    assert -axes.get_ylim()[0] == axes.get_ylim()[1] == pytest.approx(1.3 * 0.5 * 2 / np.pi, rel=0.02)
    assert levels(axes, True) == [float(cattaneo.critical_x)]


def test_what_always_sticks_is_shaded(cattaneo, axes):
    panels.draw_swt(axes, cattaneo)
    (zone,) = axes.patches
    box = zone.get_extents().transformed(axes.transData.inverted())
    assert (box.x0, box.x1) == pytest.approx((-0.8, 0.8))
    (words,) = (text for text in axes.texts if text.get_text() == "always\nsticks")
    assert words.get_position() == pytest.approx((0.0, 0.04 * float(cattaneo.s)))


@pytest.mark.parametrize("angle", [8.0, -8.0, 65.0, -65.0])
def test_the_plane_is_drawn_as_it_lies(moving, axes, angle):
    """x to the right, z down: the normal (cos φ, sin φ) points down for φ > 0, the plane into the body."""
    panels._draw_plane(axes, angle)
    (inset,) = axes.child_axes
    cosine, sine = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    plane = inset.lines[1].get_xydata()
    assert plane[0].tolist() == [0.0, 0.0]
    assert np.hypot(*plane[1]) == pytest.approx(0.85)
    assert plane[1] @ [cosine, -sine] == pytest.approx(0.0, abs=1e-12)
    assert plane[1, 1] < 0.0
    arrow = next(text for text in inset.texts if text.get_text() == "")
    assert np.subtract(arrow.xy, arrow.xyann) == pytest.approx([0.6 * cosine, -0.6 * sine])
    assert arrow.xyann == pytest.approx(0.42 / 0.85 * plane[1])
    (number,) = (text for text in inset.texts if text.get_text())
    assert number.get_text() == f"{angle:.1f}°".replace("-", "−")
    assert number.get_position() == (-1.3, -0.5)  # beside the body, at half of its depth


def test_what_does_not_change_has_room_too():
    for value, size, middle in ((0.0, 0.0, 1.0), (2.0, 0.0, 2.0), (0.5, 1.0, 1.0)):
        low, high = limits(np.full(3, value), 0.1, 0.2, size)
        assert low == pytest.approx(value - 0.05 * middle - 0.1 * 0.1 * middle)
        assert high == pytest.approx(value + 0.05 * middle + 0.2 * 0.1 * middle)
    # The noise of a measured load is no change, half of a per cent is.
    low, high = limits(np.array([1.0, 1.004]), 0.0, 0.0)
    assert high - low == pytest.approx(0.1, rel=0.01)
    assert 0.5 * (low + high) == pytest.approx(1.002)
    assert limits(np.array([1.0, 1.006]), 0.0, 0.0) == (1.0, 1.006)


def test_a_colour_is_a_state_or_an_instant(moving, axes):
    """No curve of a panel has the colour of stick or slip, and each instant has its own in all panels."""
    states = {to_hex(colour) for colour in STATE_COLOURS}
    panels.draw_springs(axes, moving)
    instants = [line for line in axes.lines if line.get_label().startswith("instant")]
    colours = {int(line.get_label().split()[1]): to_hex(line.get_color()) for line in instants}
    assert len({*colours.values()}) == len(colours) == moving.instant.size
    assert not {*colours.values()} & states
    for draw in (panels.draw_stress, panels.draw_swt, panels.draw_tractions, draw_forces, panels.draw_load):
        axes = Figure().subplots()
        draw(axes, moving)
        for one in axes.figure.axes:
            assert not {to_hex(line.get_color()) for line in one.lines} & states
        for text in axes.texts:
            if text.get_text().isdigit():
                assert to_hex(text.get_bbox_patch().get_edgecolor()) == colours[int(text.get_text())]


@pytest.mark.parametrize(("criterion", "k"), [("findley", 0.3), ("fatemi_socie", 0.7)])
def test_a_point_of_a_criterion_of_shear(axes, criterion, k):
    """What s is made of stands in the picture: the swing and the largest tension on the critical plane."""
    point = swtstudy.inspect_point(**MOVING, criterion=criterion, normal_sensitivity=k)
    panels.draw_stress(axes, point)
    assert axes.figure.axes == [axes]  # both are stresses
    curves = {line.get_label(): line.get_ydata() for line in axes.lines}
    tension, shear = curves[r"$\sigma_n$"], curves[r"$\tau$"]
    amplitude = 0.5 * np.ptp(shear)
    made = amplitude + k * tension.max() if criterion == "findley" else amplitude * (1.0 + k * tension.max())
    assert tension.max() > 0.0
    assert made == pytest.approx(float(point.s), rel=1e-4)
    assert float(point.s_local.max()) == pytest.approx(float(point.s), rel=1e-3)
    # The plane, turned in the section: τ = sin 2θ (σ_zz − σ_xx)/2 + cos 2θ σ_xz, σ_n with the same σ_zz.
    angle = np.radians(float(point.shown_angle))
    c, s = np.cos(angle), np.sin(angle)
    xx, xz = point.sigma_xx.values, point.sigma_xz.values
    zz = (tension - c * c * xx - 2.0 * s * c * xz) / (s * s)
    np.testing.assert_allclose(shear, s * c * (zz - xx) + (c * c - s * s) * xz, atol=1e-9)
    other = Figure().subplots()
    panels.draw_swt(other, point)
    words = {"findley": "Findley stress", "fatemi_socie": "Fatemi–Socie parameter"}[criterion]
    assert other.get_title("left") == f"{words} along the surface"
    assert "SWT" not in other.get_ylabel()


@pytest.mark.slow
@pytest.mark.parametrize("amplitude", [0.02, 0.1, 0.3, 0.5, 0.9])
def test_labels_of_the_radii_have_room(amplitude):
    figure = swtstudy.inspect(normal_amplitude=amplitude)
    figure.get_layout_engine().execute(figure)
    (axes,) = (each for each in figure.axes if "(F)" in each.get_title("left"))
    least, largest = (
        next(text.get_window_extent() for text in axes.texts if word in text.get_text())
        for word in ("min", "max")
    )
    (inset,) = axes.child_axes
    assert not least.overlaps(largest)
    assert not least.overlaps(inset.get_window_extent())
