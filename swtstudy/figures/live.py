"""A figure of one parameter point that sliders in a notebook redraw.

The sliders need the extra "live".
"""

from __future__ import annotations

from fractions import Fraction
from io import BytesIO
from math import pi
from os import PathLike
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg

from swtstudy.figures.point import draw_load, draw_load_plane, draw_springs
from swtstudy.figures.sheet import Figure
from swtstudy.figures.style import entitle, save_figure, styled
from swtstudy.figures.words import tick_in_pi
from swtstudy.points.grid import SHAPE_COLUMNS
from swtstudy.points.solve import solve
from swtstudy.points.values import read_value
from swtstudy.results.inspection import load_and_springs
from swtstudy.vocabulary.arrays import FloatArray
from swtstudy.vocabulary.choices import FAMILIES, REGIMES
from swtstudy.vocabulary.parameters import CONTROLS, PAIRS, PARAMETERS
from swtstudy.vocabulary.wording import axis_words

#: Phases from 0 to 2π, no fewer in a period of s(ψ), and the accuracy asked of s: what a picture shows.
_PHASES, _LEAST, _RTOL = 72, 36, 1e-3


class LiveFigure:
    """Load path, memory diagram and s over the phase, side by side.

    Attributes
    ----------
    figure
        The matplotlib figure, of three axes.
    """

    def __init__(self) -> None:
        with styled():
            # Its own layout: matplotlib's would cost as much as everything else that is drawn.
            self.figure = Figure((13.5, 4.6), dpi=80)
            self.figure.subplots(1, 3)
            self.figure.subplots_adjust(left=0.055, right=0.99, bottom=0.22, top=0.94, wspace=0.25)
        self._canvas = FigureCanvasAgg(self.figure)

    def redraw(self, **parameters: object) -> xr.Dataset:
        """Draw the point of some parameters; what is not given has the values of Table 1.

        Parameters
        ----------
        **parameters
            Single values, as for `swtstudy.solve`.

        Returns
        -------
        xarray.Dataset
            The point, as from `swtstudy.solve`.

        Raises
        ------
        StudyError
            A ValueError with every mistake in the parameters, or that they have no equilibrium.
        """
        dataset = load_and_springs(**parameters)  # names what is wrong
        row = PARAMETERS["phase"]
        phase = float(read_value(row, parameters.get("phase", row.default)))  # type: ignore[arg-type]
        curve = phases(parameters.get("frequency_ratio", 1))
        # A phase that is one of these but for rounding takes its place.
        over = {"phase": np.union1d(curve[np.abs(curve - phase) > 1e-6], phase)}
        solved = solve(rtol=_RTOL, **{**parameters, **over})  # type: ignore[arg-type]
        load, springs, over_phase = self.figure.axes
        with styled():
            for axes in self.figure.axes:
                axes.clear()
            (draw_load if "displacement" in dataset else draw_load_plane)(load, dataset)
            draw_springs(springs, dataset)
            _draw_over_phase(over_phase, solved.s, phase)
            for axes in (load, springs):
                # Half of the ticks: their labels are most of the time that drawing takes.
                axes.locator_params(nbins=4)
        return solved.sel(phase=phase)

    def png(self) -> bytes:
        """The picture, in half of the time that `savefig` takes."""
        picture = BytesIO()
        with styled():
            self._canvas.print_png(picture, pil_kwargs={"compress_level": 1})
        return picture.getvalue()

    def save(self, path: str | PathLike[str]) -> None:
        """Write the figure as SVG or PDF, or as PNG with 300 dots per inch; by the ending of the name."""
        save_figure(self.figure, path, {"savefig.dpi": 300.0})


def phases(frequency_ratio: object) -> FloatArray:
    """Phases from 0 to 2π for the curve; phases with the same s by symmetry are solved once."""
    ratio = read_value(PARAMETERS["frequency_ratio"], frequency_ratio)
    assert isinstance(ratio, Fraction)
    periods = ratio.numerator * (2 if ratio.denominator % 2 else 1)
    return np.linspace(0.0, 2.0 * pi, periods * max(_LEAST, _PHASES // periods) + 1)


def _draw_over_phase(axes: Axes, s: xr.DataArray, phase: float) -> None:
    """s over the phase, with gaps where it is not finite, and one of its points."""
    finite = s.where(np.isfinite(s))
    (line,) = axes.plot(s.phase, finite)
    axes.plot(phase, finite.sel(phase=phase), marker="o", markersize=9, color="black", linestyle="")
    axes.axvline(phase, color=line.get_color(), linewidth=0.9, alpha=0.5)
    highest = float(finite.max())
    axes.set(xlim=(0.0, 2.0 * pi), ylim=(0.0, 1.15 * highest if highest > 0.0 else 1.0))
    if not np.isfinite(highest):
        axes.text(0.5, 0.5, "$s$ is not finite", transform=axes.transAxes, ha="center")
    tick_in_pi(axes.xaxis, 0.0, 2.0 * pi)
    axes.locator_params(axis="y", nbins=4)
    axes.set(xlabel=axis_words("phase"), ylabel="$s$")
    entitle(axes, "$s$ over the phase")


#: Lower and upper end of each slider, its step, and where it begins; ends within what is allowed. Shape
#: parameters that are not listed are lengths in a_H.
SLIDERS: dict[str, tuple[float, float, float, float]] = {
    "phase": (0.0, 2 * pi, pi / 72, 0.0),
    "normal_amplitude": (0.0, 1.25, 0.01, 0.75),
    "tangential_amplitude": (0.0, 3.0, 0.01, 0.83),
    "friction": (0.01, 1.0, 0.01, 0.3),
    "poisson_ratio": (0.0, 0.5, 0.01, 0.3),
    **{name: (0.01 * PARAMETERS[name].open_lower, 2.0, 0.01, 0.5) for name in SHAPE_COLUMNS},
    "waviness_amplitude": (0.0, 0.05, 0.001, 0.02),
    "wavelength": (4.5, 12.0, 0.1, 5.0),
    "exponent": (1.2, 8.0, 0.1, 4.0),
    "bulk_stress_amplitude": (0.0, 1.0, 0.01, 0.0),
    "bulk_stress_mean": (-1.0, 1.0, 0.01, 0.0),
    "bulk_stress_phase": (0.0, 2 * pi, pi / 72, 0.0),
    "bulk_strain_share": (-2.0, 2.0, 0.05, 1.0),
    "walker_exponent": (0.2, 0.8, 0.01, 0.5),
}
#: Ratios of the frequencies to choose from.
RATIOS = ("1/3", "1/2", "2/3", "3/4", "1", "4/3", "3/2", "2", "3")


class Explorer:
    """Sliders, and a figure that follows them; show its ``box`` in a notebook.

    Attributes
    ----------
    controls
        The widgets by the name of the parameter; "control" says what is prescribed.
    live
        The figure.
    picture, caption
        The widgets that show it, and its s or what is wrong with the parameters.
    box
        All of them: what a notebook shows.
    point
        The results that were drawn last, as from `swtstudy.solve`.

    Raises
    ------
    ImportError
        Without the extra "live".
    """

    def __init__(self) -> None:
        try:
            import ipywidgets as widgets
        except ImportError:
            words = 'sliders need the extra "live": pip install "swtstudy[live]"'
            raise ImportError(words) from None
        self.live = LiveFigure()
        self.picture, self.caption = widgets.Image(format="png"), widgets.HTML()
        self.controls: dict[str, Any] = {
            "profile": widgets.Dropdown(options=list(FAMILIES), value="paraboloid"),
            "control": widgets.Dropdown(options=list(CONTROLS.values()), value="displacements"),
            "frequency_ratio": widgets.Dropdown(options=RATIOS, value="1"),
        }
        for name, (low, high, step, begin) in SLIDERS.items():
            slider = widgets.FloatSlider(begin, min=low, max=high, step=step, readout_format=".3g")
            slider.tooltip, self.controls[name] = PARAMETERS[name].meaning, slider
        for name, each in self.controls.items():
            each.description = "prescribed" if name == "control" else _words(name)
            each.style, each.layout.width = {"description_width": "19em"}, "98%"
            each.observe(self._follow, names="value")
        controls, half = list(self.controls.values()), -(-len(self.controls) // 2)
        wide = widgets.Layout(width="50%")
        columns = [widgets.VBox(part, layout=wide) for part in (controls[:half], controls[half:])]
        self.box = widgets.VBox([widgets.HBox(columns), self.caption, self.picture])
        self._follow(None)

    @property
    def parameters(self) -> dict[str, object]:
        """The parameters that the widgets show, as `swtstudy.solve` takes them."""
        control = next(each for each, name in CONTROLS.items() if name == self.controls["control"].value)
        values = {name: each.value for name, each in self.controls.items() if name != "control"}
        others = {*SHAPE_COLUMNS} - {*FAMILIES[values["profile"]].shape}
        return {control.given_for(name): value for name, value in values.items() if name not in others}

    def _follow(self, _: object) -> None:
        """Draw what the widgets show; where that cannot be, say why, and leave the picture."""
        parameters = self.parameters
        for name in SHAPE_COLUMNS:
            self.controls[name].layout.display = "" if name in parameters else "none"
        for force, displacement in PAIRS.items():
            name = force if force in parameters else displacement
            self.controls[displacement].description = _words(name)
        try:
            self.point = self.live.redraw(**parameters)
        except ValueError as error:
            self.caption.value = f"<b>{error}</b>"
            return
        regime = REGIMES[int(self.point.regime)].replace("_", " ")
        self.caption.value = f"<b>s = {float(self.point.s):.4f}</b>, {regime}"
        self.picture.value = self.live.png()

    def save(self, path: str | PathLike[str]) -> None:
        """Write the figure: see `LiveFigure.save`."""
        self.live.save(path)


def _words(name: str) -> str:
    """The name of a parameter with its symbol."""
    return ", ".join(filter(None, (name.replace("_", " "), PARAMETERS[name].notation)))
