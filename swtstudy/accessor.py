"""``ds.swt`` on every Dataset of results: short names for functions defined elsewhere."""

from __future__ import annotations

from typing import TYPE_CHECKING

import xarray as xr

from swtstudy.grid.nearest import TOLERANCE

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure

    from swtstudy.figures.sheet import Width
    from swtstudy.figures.style import Style


@xr.register_dataset_accessor("swt")
class SwtAccessor:
    """Evaluation of results of `solve`, `run` and `open_results`, also after xarray's own operations.

    Registered as ``Dataset.swt`` once `swtstudy` and xarray are both imported, in any order.

    Examples
    --------
    >>> import swtstudy
    >>> dataset = swtstudy.solve(phase=[0, "pi/2"], normal_amplitude=[0.25, 0.75], rtol=1e-2)
    >>> dataset.swt.slice(phase="pi/2").s.dims
    ('normal_amplitude',)
    >>> list(dataset.swt.extrema("phase").data_vars)
    ['minimum', 'at_minimum', 'maximum', 'at_maximum', 'ratio']
    """

    def __init__(self, dataset: xr.Dataset) -> None:
        self._dataset = dataset

    def figure(self, style: Style | None = None, width: Width | None = None) -> Figure:
        """The figure that the study asks for; see `swtstudy.figures.draw.draw`.

        A dimension that has been sliced away is removed from the layout. ``width`` is "column", 8.5 cm, or
        "page", 17.5 cm, for print; without it the figure is for a screen.
        """
        from swtstudy.figures.draw import draw

        return draw(self._dataset, style=style, width=width)

    def panels(
        self,
        x: str,
        hue: str | None = None,
        panels: str | None = None,
        y: str | list[str] = "s",
        title: str | None = None,
        kind: str = "lines",
        vertical: str | None = None,
        regimes: bool = False,
        style: Style | None = None,
        width: Width | None = None,
    ) -> Figure:
        """A figure with a layout of your own, by the keys of a study's ``[figure]``.

        ``y`` may name any data variable of the Dataset; ``width`` is that of `figure`.
        """
        from swtstudy.figures.draw import draw
        from swtstudy.study.figure import FigureLayout

        rows = (y,) if isinstance(y, str) else tuple(y)
        layout = FigureLayout(x, hue, panels, rows, title, kind, vertical, regimes)
        return draw(self._dataset, layout, style, width)

    def slice(self, *, tolerance: float = TOLERANCE, **places: object) -> xr.Dataset:
        """The part at given values; see `swtstudy.results.select.slice_at`."""
        from swtstudy.results.select import slice_at

        return slice_at(self._dataset, places, tolerance)

    def normalised(self, place: str) -> xr.DataArray:
        """s over s at one place, such as "b=0"; see `swtstudy.results.quantity.quantity`."""
        from swtstudy.results.quantity import quantity

        return quantity(self._dataset, f"s/s({place})")

    def extrema(self, dim: str) -> xr.Dataset:
        """Least and greatest s along a dimension; see `swtstudy.results.extrema.extrema`."""
        from swtstudy.results.extrema import extrema

        return extrema(self._dataset, dim)

    def to_table(self) -> pd.DataFrame:
        """A table with one row per point; see `swtstudy.results.table.to_table`."""
        from swtstudy.results.table import to_table

        return to_table(self._dataset)
