"""hvPlot shows results with their names and units."""

import pytest

import swtstudy


@pytest.mark.slow
def test_labels_are_those_of_the_results():
    # Here and not above: it takes seconds, and every process of tests collects all tests.
    pytest.importorskip("hvplot")
    import holoviews
    import hvplot.xarray  # noqa: F401

    dataset = swtstudy.solve(phase=[0, 1, 2], normal_amplitude=[0.25, 0.75], rtol=1e-2)
    drawn = dataset.s.hvplot.line(x="phase", by="normal_amplitude")
    figure = holoviews.render(drawn, backend="bokeh")
    assert figure.xaxis.axis_label == "phase (rad)"
    assert figure.yaxis.axis_label.startswith(dataset.s.attrs["long_name"])
    assert drawn.kdims[0].label == "normal amplitude"
    for amplitude, curve in drawn.items():
        assert (curve.dimension_values("s") == dataset.s.sel(normal_amplitude=amplitude)).all()
