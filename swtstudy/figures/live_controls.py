"""Sliders over the parameters of one point, and its figure, for a notebook (extra "live")."""

from __future__ import annotations

import asyncio
from contextlib import suppress
from math import pi
from os import PathLike
from types import ModuleType
from typing import Any

from swtstudy.figures.live import LiveFigure
from swtstudy.mechanics.points import REGIMES
from swtstudy.vocabulary.families import FAMILIES
from swtstudy.vocabulary.parameters import PARAMETERS
from swtstudy.vocabulary.prescribed import CONTROLS, PAIRS

#: Lower and upper end of each slider, its step, and where it begins; ends within what is allowed.
SLIDERS: dict[str, tuple[float, float, float, float]] = {
    "phase": (0.0, 2 * pi, pi / 72, 0.0),
    "normal_amplitude": (0.0, 1.25, 0.01, 0.75),
    "tangential_amplitude": (0.0, 3.0, 0.01, 0.83),
    "friction": (0.01, 1.0, 0.01, 0.3),
    "poisson_ratio": (0.0, 0.5, 0.01, 0.3),
    "flat_radius": (0.0, 2.0, 0.01, 0.5),
    "flat_half_width": (0.0, 2.0, 0.01, 0.5),
    "waviness_amplitude": (0.0, 0.05, 0.001, 0.02),
    "wavelength": (4.5, 12.0, 0.1, 5.0),
    "exponent": (1.2, 8.0, 0.1, 4.0),
    "bulk_stress_amplitude": (0.0, 1.0, 0.01, 0.0),
    "bulk_stress_mean": (-1.0, 1.0, 0.01, 0.0),
    "bulk_stress_phase": (0.0, 2 * pi, pi / 72, 0.0),
    "walker_exponent": (0.2, 0.8, 0.01, 0.5),
}
#: Ratios of the frequencies to choose from.
RATIOS = ("1/3", "1/2", "2/3", "3/4", "1", "4/3", "3/2", "2", "3")
_WIDE = {"description_width": "19em"}
#: Seconds without a movement after which the curve is drawn with all phases that it needs.
_IDLE = 0.4


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
        What was drawn last, as from `swtstudy.solve`.

    Raises
    ------
    ImportError
        Without the extra "live".
    """

    def __init__(self) -> None:
        widgets = _widgets()
        self.live = LiveFigure()
        self.controls = _controls(widgets)
        self.picture = widgets.Image(format="png")
        self.caption = widgets.HTML()
        for each in self.controls.values():
            each.observe(self._follow, names="value")
        controls, half = list(self.controls.values()), -(-len(self.controls) // 2)
        wide = widgets.Layout(width="50%")
        columns = [widgets.VBox(part, layout=wide) for part in (controls[:half], controls[half:])]
        self._idle: asyncio.TimerHandle | None = None
        self.box = widgets.VBox([widgets.HBox(columns), self.caption, self.picture])
        self._follow(None)

    @property
    def parameters(self) -> dict[str, object]:
        """The parameters that the widgets show, as `swtstudy.solve` takes them."""
        control = next(each for each, name in CONTROLS.items() if name == self.controls["control"].value)
        values = {name: each.value for name, each in self.controls.items() if name != "control"}
        own = FAMILIES[values["profile"]].shape
        others = {name for family in FAMILIES.values() for name in family.shape if name not in own}
        return {control.given_for(name): value for name, value in values.items() if name not in others}

    def _follow(self, _: object) -> None:
        """Draw what the widgets show; where that cannot be, say why, and leave the picture."""
        parameters = self.parameters
        for family in FAMILIES.values():
            for name in family.shape:
                self.controls[name].layout.display = "" if name in parameters else "none"
        for force, displacement in PAIRS.items():
            name = force if force in parameters else displacement
            self.controls[displacement].description = _words(name)
        self._draw(False)
        if self._idle is not None:
            self._idle.cancel()
        with suppress(RuntimeError):  # without an event loop, outside of notebooks, nothing is ever idle
            self._idle = asyncio.get_running_loop().call_later(_IDLE, self.refine)

    def refine(self) -> None:
        """Draw the curve with all phases that it needs, as is done when no slider moves."""
        self._draw(True)

    def save(self, path: str | PathLike[str]) -> None:
        """Write the figure, its curve fine: see `swtstudy.figures.live.LiveFigure.save`."""
        self.refine()
        self.live.save(path)

    def _draw(self, fine: bool) -> None:
        try:
            self.point = self.live.redraw(fine, **self.parameters)
        except ValueError as error:
            self.caption.value = f"<b>{error}</b>"
            return
        regime = REGIMES[int(self.point.regime)].replace("_", " ")
        self.caption.value = f"<b>s = {float(self.point.s):.4f}</b>, {regime}"
        self.picture.value = self.live.png()


def _words(name: str) -> str:
    """The name of a parameter with its symbol."""
    return ", ".join(filter(None, (name.replace("_", " "), PARAMETERS[name].notation)))


def _widgets() -> ModuleType:
    try:
        import ipywidgets
    except ImportError:
        words = 'sliders need the extra "live": pip install "swtstudy[live]"'
        raise ImportError(words) from None
    return ipywidgets


def _controls(widgets: ModuleType) -> dict[str, Any]:
    """A widget for each parameter."""
    chosen: dict[str, Any] = {
        "profile": widgets.Dropdown(options=list(FAMILIES), value="paraboloid"),
        "control": widgets.Dropdown(options=list(CONTROLS.values()), value="displacements"),
        "frequency_ratio": widgets.Dropdown(options=RATIOS, value="1"),
    }
    for name, (low, high, step, begin) in SLIDERS.items():
        chosen[name] = widgets.FloatSlider(begin, min=low, max=high, step=step, readout_format=".3g")
        chosen[name].tooltip = PARAMETERS[name].meaning
    for name, each in chosen.items():
        words = "prescribed" if name == "control" else _words(name)
        each.description, each.style, each.layout.width = words, _WIDE, "98%"
    return chosen
