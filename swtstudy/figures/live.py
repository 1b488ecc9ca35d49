"""A figure of one parameter point that is drawn again while its parameters change."""

from __future__ import annotations

from fractions import Fraction
from io import BytesIO
from os import PathLike
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg

from swtstudy.fields.inspection import no_equilibrium
from swtstudy.fields.load_and_springs import load_and_springs
from swtstudy.fields.one_point import read_point
from swtstudy.figures.figure import Figure
from swtstudy.figures.force_panels import draw_load_plane
from swtstudy.figures.inspection_panels import draw_load, draw_springs
from swtstudy.figures.save import save_figure
from swtstudy.figures.style import styled
from swtstudy.figures.ticks import tick_in_pi
from swtstudy.mechanics.points import REGIMES, FloatArray
from swtstudy.solving import solve
from swtstudy.vocabulary.mistakes import StudyError
from swtstudy.vocabulary.parameters import PARAMETERS
from swtstudy.vocabulary.wording import axis_words

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes

#: Phases from 0 to 2π, no fewer in a period of s(ψ), and the accuracy asked of s: what a picture shows.
_PHASES, _LEAST, _RTOL = 24, 12, 1e-3
#: Times as many phases for the curve when nothing moves: few of them miss its least value by some per cent.
_FINER = 8
#: Dots per inch of a picture that is saved.
_SAVED = 300.0
#: Phases nearer than this, rad, are the same.
_ROUNDING = 1e-6
#: Size in inches, and dots per inch.
_SIZE, _DOTS = (13.5, 4.2), 80


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
            self.figure = Figure(_SIZE, dpi=_DOTS)
            self.figure.subplots(1, 3)
            self.figure.subplots_adjust(left=0.055, right=0.99, bottom=0.13, top=0.93, wspace=0.25)
        self._canvas = FigureCanvasAgg(self.figure)

    def redraw(self, fine: bool = False, **parameters: object) -> xr.Dataset:
        """Draw the point of some parameters; what is not given has the values of Table 1.

        Parameters
        ----------
        fine
            Whether the curve of s has all phases that it needs, which takes longer than a slider moves.
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
        phase = float(parameters.get("phase", PARAMETERS["phase"].default))  # type: ignore[arg-type]
        curve = phases(parameters.get("frequency_ratio", 1), _FINER if fine else 1)
        # A phase that is one of these but for rounding takes its place.
        over = {"phase": np.union1d(curve[np.abs(curve - phase) > _ROUNDING], phase)}
        solved = solve(rtol=_RTOL, **{**parameters, **over})  # type: ignore[arg-type]
        if REGIMES[int(solved.regime.sel(phase=phase))] == "no_equilibrium":
            raise StudyError([no_equilibrium(read_point(parameters), parameters)])
        dataset = load_and_springs(**parameters)
        load, springs, over_phase = self.figure.axes
        with styled():
            for axes in self.figure.axes:
                axes.clear()
            (draw_load if "displacement" in dataset else draw_load_plane)(load, dataset)
            draw_springs(springs, dataset)
            draw_over_phase(over_phase, solved.s, phase)
            for axes in (load, springs):
                # Half of the ticks: their labels are most of the time that drawing takes.
                axes.locator_params(nbins=4)
        return solved.sel(phase=phase)

    def png(self) -> bytes:
        """The picture."""
        picture = BytesIO()
        with styled():
            self._canvas.print_png(picture, pil_kwargs={"compress_level": 1})
        return picture.getvalue()

    def save(self, path: str | PathLike[str]) -> None:
        """Write the figure as SVG or PDF, or as PNG with 300 dots per inch; by the ending of the name."""
        save_figure(self.figure, path, {"savefig.dpi": _SAVED})


def phases(frequency_ratio: object, finer: int = 1) -> FloatArray:
    """Phases from 0 to 2π for the curve: those that have the same s by symmetry are solved once."""
    ratio = Fraction(str(frequency_ratio))
    periods = ratio.numerator * (2 if ratio.denominator % 2 else 1)
    return np.linspace(0.0, 2.0 * np.pi, periods * max(_LEAST, _PHASES // periods) * finer + 1)


def draw_over_phase(axes: Axes, s: xr.DataArray, phase: float) -> None:
    """s over the phase, with gaps where it is not finite, and one of its points."""
    finite = s.where(np.isfinite(s))
    (line,) = axes.plot(s.phase, finite)
    axes.plot(phase, finite.sel(phase=phase), marker="o", markersize=9, color="black", linestyle="")
    axes.axvline(phase, color=line.get_color(), linewidth=0.9, alpha=0.5)
    highest = float(finite.max())
    axes.set_xlim(0.0, 2.0 * np.pi)
    axes.set_ylim(0.0, 1.15 * highest if highest > 0.0 else 1.0)
    if not np.isfinite(highest):
        axes.text(0.5, 0.5, "$s$ is not finite", transform=axes.transAxes, ha="center")
    tick_in_pi(axes.xaxis, 0.0, 2.0 * np.pi)
    axes.locator_params(axis="y", nbins=4)
    axes.set_xlabel(axis_words("phase"))
    axes.set_ylabel("$s$")
    axes.set_title("$s$ over the phase", loc="left")
