"""One parameter point in one figure: load, slip, springs, tractions, stress, swt."""

from __future__ import annotations

import math
from typing import Any

import xarray as xr
from matplotlib.figure import Figure

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
from swtstudy.figures.quantity_words import NO_LABELS, Labels, show_units
from swtstudy.figures.sheet import Sheet, Width, check_width, wrap_texts
from swtstudy.figures.style import Style, styled
from swtstudy.figures.ticks import plain_ticks
from swtstudy.points.validity import validity_lines
from swtstudy.vocabulary.choices import REGIMES, family_of
from swtstudy.vocabulary.parameters import PARAMETERS
from swtstudy.vocabulary.wording import place_words

#: The panels, and those of a plane contact, whose displacements are not known.
_OF_BOTH = (draw_slip, draw_springs, draw_tractions, draw_stress, draw_swt)
_PANELS = (draw_load, *_OF_BOTH, draw_load_plane, draw_forces, draw_force_loop)
_OF_STRIP = (draw_load_plane, *_OF_BOTH, draw_forces)
#: The variables along their axes, where these are of one.
_VARIABLES: dict[Any, tuple[str | None, str | None]] = {
    draw_load: ("displacement", "depth"),
    draw_slip: (None, "r"),
    draw_springs: ("r", None),
    draw_tractions: ("x", "traction"),
    draw_stress: (None, "normal_stress"),
    draw_swt: ("x", "s_local"),
    draw_load_plane: ("tangential_force", "normal_force"),
    draw_force_loop: ("displacement", "tangential_force"),
}
#: Panels that name units elsewhere, too.
_LABELLED: tuple[Any, ...] = (draw_stress, draw_forces, draw_force_loop)
#: Size of a panel on a screen, inches.
_PANEL = (4.4, 3.8)
#: Height of a panel in print, inches, at least: there is much in each.
_LEAST_HEIGHT = 2.4


def inspect(*, style: Style | None = None, width: Width | None = None, **parameters: object) -> Figure:
    """One figure of one parameter point: its load path, slip, tractions, stress cycle and swt.

    Parameters
    ----------
    style, width
        As for `swtstudy.accessor.SwtAccessor.figure`.
    **parameters
        Names of `swtstudy.vocabulary.parameters.PARAMETERS`, a single value each; the others are those of
        Table 1.

    Returns
    -------
    matplotlib.figure.Figure
        Nine panels; save it with its method ``savefig``. `swtstudy.inspect_point` returns the numbers shown.

    Raises
    ------
    StudyError
        A ValueError with every mistake in the parameters, or in the width.
    """
    check_width(width)
    return draw_inspection(inspect_point(**parameters), style, width)


def draw_inspection(
    dataset: xr.Dataset,
    style: Style | None = None,
    width: Width | None = None,
    labels: Labels = NO_LABELS,
    headlines: tuple[str, tuple[str, ...]] | None = None,
) -> Figure:
    """Draw a parameter point.

    Parameters
    ----------
    dataset
        The point, as from `swtstudy.inspect_point`.
    style, width
        As for `swtstudy.accessor.SwtAccessor.figure`.
    labels
        Of a real contact what its variables are in its units.
    headlines
        Of a real contact what is given of it, and the lines of its validity.

    Returns
    -------
    matplotlib.figure.Figure
        Nine panels: the load path; stick and slip over the cycle; the memory diagram, that is the springs'
        tangential force; tractions; the stress cycle on the critical plane; swt along the surface; the plane
        of the forces; these over the cycle; the force–displacement loop. Stick and slip are coloured along
        all three loops, and the same numbered instants are marked in all panels but that of swt. Plane
        contacts have no panels with displacements.
    """
    drawn = _PANELS if "displacement" in dataset else _OF_STRIP
    sheet = Sheet(1, len(drawn), width, _PANEL, least_height=_LEAST_HEIGHT, fold=False)
    with styled(style, width):
        figure = sheet.figure()
        panels = sheet.panels(figure, share_x="none", share_y="none")
        for axes, draw, letter in zip(panels[0], drawn, "ABCDEFGHI", strict=False):
            own: tuple[Any, ...] = (labels,) if draw in _LABELLED else ()
            draw(axes, dataset, *own)
            show_units(axes, _VARIABLES.get(draw, (None, None)), labels)
            axes.set_title(f"({letter})  {axes.get_title('left')}", loc="left")
        for axes in figure.axes:
            plain_ticks(axes)
        figure.suptitle(_headline(dataset, labels, headlines))
        wrap_texts(figure)
    return figure


def _headline(dataset: xr.Dataset, labels: Labels, headlines: tuple[str, tuple[str, ...]] | None) -> str:
    given, validity = headlines or (_given(dataset), validity_lines(dataset))
    regime = REGIMES[int(dataset.regime)].replace("_", " ")
    found = f"$s$ = {float(dataset.s):.4f},  {regime}"
    if "s_local" in labels:
        swt = labels["s_local"]
        found += f",  ${swt.symbol}$ = {swt.number(float(dataset.s))}"
    if not math.isfinite(float(dataset.s)):
        found = "$s$ is not finite: swt grows without bound towards the edge"
    return "\n".join([given, found, *validity])


def _given(dataset: xr.Dataset) -> str:
    """The parameters of the point."""
    profile = str(dataset.profile.item())
    names = [*family_of(profile).shape, *(n for n, p in PARAMETERS.items() if p.part != "shape")]
    if "load" in dataset.coords:
        names = [name for name in names if name not in ("frequency_ratio", "phase")]
    values = [place_words(name, dataset[name].item()) for name in names if name in dataset.coords]
    return f"{place_words('profile', profile)},  {',  '.join(values)}"
