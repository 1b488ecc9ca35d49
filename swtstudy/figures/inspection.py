"""One parameter point in one figure: load, slip, springs, tractions, stress, swt."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from swtstudy.fields.inspection import inspect_point
from swtstudy.figures.force_panels import draw_force_loop, draw_forces, draw_load_plane
from swtstudy.figures.inspection_panels import (
    draw_load,
    draw_slip,
    draw_springs,
    draw_stress,
    draw_swt,
    draw_tractions,
)
from swtstudy.figures.style import Style, styled
from swtstudy.mechanics.points import REGIMES
from swtstudy.parameters import PARAMETERS, family_of
from swtstudy.wording import place_words, value_words

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

#: Size of the figure, inches.
_WIDTH, _HEIGHT = 13.2, 11.4


def inspect(*, style: Style | None = None, **parameters: object) -> Figure:
    """One figure of one parameter point: its load path, slip, tractions, stress cycle and swt.

    Parameters
    ----------
    style
        A matplotlib style: a name, a file or rcParams.
    **parameters
        Names of `swtstudy.parameters.PARAMETERS`, a single value each; the others are those of Table 1.

    Returns
    -------
    matplotlib.figure.Figure
        Nine panels; save it with its method ``savefig``. `swtstudy.inspect_point` returns the numbers shown.

    Raises
    ------
    StudyError
        A ValueError with every mistake in the parameters.
    """
    return draw_inspection(inspect_point(**parameters), style)


def draw_inspection(dataset: xr.Dataset, style: Style | None = None) -> Figure:
    """Draw a parameter point.

    Parameters
    ----------
    dataset
        The point, as from `swtstudy.inspect_point`.
    style
        A matplotlib style: a name, a file or rcParams.

    Returns
    -------
    matplotlib.figure.Figure
        Nine panels: the load path; stick and slip over the cycle; the memory diagram, that is the springs'
        tangential force; tractions; the stress cycle on the critical plane; swt along the surface; the plane
        of the forces; these over the cycle; the force–displacement loop. Stick and slip are coloured along
        all three loops, and the same numbered instants are marked in all panels but that of swt.
    """
    from matplotlib.layout_engine import ConstrainedLayoutEngine

    from swtstudy.figures.figure import Figure

    with styled(style):
        figure = Figure((_WIDTH, _HEIGHT), layout=ConstrainedLayoutEngine(w_pad=0.08, h_pad=0.08))
        panels = figure.subplots(3, 3)
        (load, slip, springs), (tractions, stress, swt), (plane, forces, loop) = panels
        draw_load(load, dataset)
        draw_slip(slip, dataset)
        draw_springs(springs, dataset)
        draw_tractions(tractions, dataset)
        draw_stress(stress, dataset)
        draw_swt(swt, dataset)
        draw_load_plane(plane, dataset)
        draw_forces(forces, dataset)
        draw_force_loop(loop, dataset)
        for axes, letter in zip(panels.flat, "ABCDEFGHI", strict=True):
            axes.set_title(f"({letter})  {axes.get_title('left')}", loc="left")
        figure.suptitle(_headline(dataset))
    return figure


def _headline(dataset: xr.Dataset) -> str:
    profile = str(dataset.profile.item())
    names = [*family_of(profile).shape, *(n for n, p in PARAMETERS.items() if p.part != "shape")]
    if "load" in dataset.coords:
        names = [name for name in names if name not in ("frequency_ratio", "phase")]
    values = [place_words(name, dataset[name].item()) for name in names if name in dataset.coords]
    regime = REGIMES[int(dataset.regime)].replace("_", " ")
    found = f"$s$ = {float(dataset.s):.4f},  {regime}"
    if not math.isfinite(float(dataset.s)):
        found = "$s$ is not finite: swt grows without bound towards the edge"
    return f"{value_words('profile', profile)},  {',  '.join(values)}\n{found}"
