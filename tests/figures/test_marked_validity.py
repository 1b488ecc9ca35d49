"""Marks in figures of the points that are outside of what the model holds for."""

import numpy as np
import pytest
from drawn import draw, keys
from made_up import made_up

from swtstudy import Study

#: The tests look at what is drawn, not at its layout.
pytestmark = pytest.mark.usefixtures("unwrapped")

AMPLITUDE, FRICTION = np.linspace(0.1, 1.0, 10), np.linspace(0.2, 0.8, 7)


@pytest.fixture
def results():
    """Beyond first yield where u + μ > 1.3; N = 10⁵/u³, above 10⁷ where u < 0.2154."""
    dataset = made_up(
        lambda friction, tangential_amplitude: friction * tangential_amplitude,
        friction=FRICTION,
        tangential_amplitude=AMPLITUDE,
    )
    ratio = (dataset.tangential_amplitude + dataset.friction) / 1.3 - 1e-9
    cycles = 1e5 / dataset.tangential_amplitude**3 + 0.0 * dataset.friction
    dims = dataset.s.dims
    dataset = dataset.assign(yield_ratio=ratio.transpose(*dims), cycles=cycles.transpose(*dims))
    return dataset.assign_attrs(contact="{}")


BEYOND = AMPLITUDE[None, :] + FRICTION[:, None] > 1.3 + 1e-6
LONG = np.broadcast_to(AMPLITUDE < 0.2154, BEYOND.shape)


def marks(axes, words):
    return [line for line in axes.lines if str(line.get_label()) == words]


@pytest.mark.parametrize("kind", ["lines", "life"])
def test_a_band_is_under_the_part_of_a_line_that_is_outside(results, kind):
    layout = keys("tangential_amplitude", "friction", y=("cycles",), kind=kind, validity=True)
    axes = draw(results, layout).axes[0]
    bands = marks(axes, "outside: first yield, extrapolated life")
    assert len(bands) == len(FRICTION)
    for band, row in zip(bands, BEYOND | LONG, strict=True):
        x = np.asarray(band.get_ydata() if kind == "life" else band.get_xdata())
        # Each point, and one beside it, so that a point alone has a band too.
        np.testing.assert_allclose(x[::2][row], AMPLITUDE[row])
        np.testing.assert_allclose(x[1::2][row], AMPLITUDE[row], atol=1.1e-4)
        assert np.isnan(x.reshape(-1, 2)[~row]).all()
        assert (x[1::2] != x[::2]).all()
        assert band.get_zorder() < min(line.get_zorder() for line in axes.lines if line not in bands)
    plain = draw(results, keys("tangential_amplitude", "friction", y=("cycles",), kind=kind))
    assert not marks(plain.axes[0], "outside: first yield, extrapolated life")


def test_nothing_outside_has_no_mark(results):
    inside = results.assign(yield_ratio=0.0 * results.yield_ratio)
    layout = keys("tangential_amplitude", "friction", validity=True)
    plain = keys("tangential_amplitude", "friction")
    assert len(draw(inside, layout).axes[0].lines) == len(draw(inside, plain).axes[0].lines)


def test_a_study_may_ask_for_them():
    text = 'title = "t"\n[axes]\nphase = [0, 1]\n[figure]\nx = "phase"\nvalidity = true\n'
    study = Study.from_text(text)
    assert study.figure is not None
    assert study.figure.validity
    assert type(study.figure).from_json(study.figure.to_json()) == study.figure
