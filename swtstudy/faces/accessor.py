"""``ds.swt`` on every Dataset of results: short names for functions defined elsewhere."""

from __future__ import annotations

from typing import TYPE_CHECKING

import xarray as xr

from swtstudy.points.values import AXIS_TOLERANCE

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure

    from swtstudy.faces.contacts import PhysicalContact
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

    def __repr__(self) -> str:
        """Describe the results, as ``swtstudy info`` describes an archive."""
        from swtstudy.archive.describe import describe

        needed = {"s", "s_error", "regime", *(("run",) if "runs" in self._dataset.attrs else ())}
        whole = needed <= {*self._dataset.data_vars}
        return "\n".join(describe(self._dataset)) if whole else "<no results of swtstudy, or a part of them>"

    def words(self, name: str = "regime") -> xr.DataArray:
        """Flags as words: of every point what a number in ``regime`` or ``status`` stands for.

        Parameters
        ----------
        name
            A data variable of flags.

        Returns
        -------
        xarray.DataArray
            Texts of the same dimensions; empty where there is no value.

        Raises
        ------
        StudyError
            A ValueError, if it is no variable of flags.

        Examples
        --------
        >>> import swtstudy
        >>> swtstudy.solve(normal_amplitude=[0.25, 1.5], rtol=1e-2).swt.words().values.tolist()
        ['partial_slip', 'lift_off']
        """
        from swtstudy.results.evaluate import words_of

        return words_of(self._dataset, name)

    def _repr_html_(self) -> str:
        """The same for a notebook."""
        from html import escape

        return f"<pre>{escape(repr(self))}</pre>"

    def validity(self, inside: bool = False) -> tuple[str, ...]:
        """Report where the results are outside of the model's limits: none if all is well.

        Parameters
        ----------
        inside
            Whether to say, too, how far they are from the limits that they are inside of.

        Returns
        -------
        tuple of str
            One line for each limit: how many of how many points are outside of it, and the worst one.

        Raises
        ------
        StudyError
            A ValueError, if the results have been left without s or regime.
        """
        from swtstudy.points.validity import validity_lines

        return validity_lines(self._dataset, inside)

    def figure(self, style: Style | None = None, width: Width | None = None) -> Figure:
        """The figure that the study asks for; a dimension that has been sliced away is left out of it.

        Parameters
        ----------
        style
            A matplotlib style: a name, a file or rcParams. By default the look is the package's own, except
            for rcParams that you have changed.
        width
            "column" for the 8.5 cm of a column in print, "page" for 17.5 cm, with letters of 8 pt; by default
            the figure is for a screen, and grows with its panels.

        Returns
        -------
        matplotlib.figure.Figure
            One row of panels for every quantity, one column for every value of the panels' dimension, in
            several lines where the width ends. It is independent of pyplot; save it with its method
            ``savefig``.

        Raises
        ------
        ValueError
            With every mistake in layout and width; or if there is no layout, or the results are empty.
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
        validity: bool = False,
        style: Style | None = None,
        width: Width | None = None,
    ) -> Figure:
        """A figure with a layout of your own, by the keys of a study's ``[figure]``.

        Parameters
        ----------
        x
            The dimension along the axis.
        hue, panels
            Dimensions whose values have a line each, a panel each.
        y
            Any data variable, or "s/s(name=value)"; several have a row of panels each.
        title
            Title of the figure.
        kind
            Kind of figure, such as "lines" or "contour"; the page on figures lists all kinds.
        vertical
            The other dimension of contours and heat maps.
        regimes
            Whether to mark where a regime begins.
        validity
            Whether to mark the points that are outside of what the model holds for.
        style, width
            As of `figure`.

        Returns
        -------
        matplotlib.figure.Figure
            As of `figure`.

        Raises
        ------
        ValueError
            With every mistake in the layout; or if the results are empty.
        """
        from swtstudy.figures.draw import draw
        from swtstudy.study.figure import FigureLayout

        rows = (y,) if isinstance(y, str) else tuple(y)
        layout = FigureLayout(x, hue, panels, rows, title, kind, vertical, regimes, validity)
        return draw(self._dataset, layout, style, width)

    def slice(self, *, tolerance: float = AXIS_TOLERANCE, **places: object) -> xr.Dataset:
        """The part of results at given values of their parameters.

        Parameters
        ----------
        tolerance
            Largest distance from the nearest value of the axis, relative to the larger of the two.
        **places
            By name: a single value, whose dimension becomes a scalar coordinate, or a sequence of values,
            whose dimension is kept; a sample keeps the points that have one of the values. Values are
            written as in a study file: "pi/2", "3/2", 0.75, "rounded_punch".

        Returns
        -------
        xarray.Dataset
            All data variables at these values.

        Raises
        ------
        StudyError
            A ValueError with every name and value that the results lack, and all that they have.
        """
        from swtstudy.results.evaluate import slice_at

        return slice_at(self._dataset, places, tolerance)

    def normalised(self, place: str) -> xr.DataArray:
        """The ratio of s to its value at one place.

        Parameters
        ----------
        place
            The name or the symbol of a parameter, and its value there, such as "b=0" or "phase=pi/2".

        Returns
        -------
        xarray.DataArray
            With the dimensions of s.

        Raises
        ------
        ValueError
            If it is no such place, or not in the results.
        """
        from swtstudy.results.evaluate import quantity

        return quantity(self._dataset, f"s/s({place})")

    def contact(self) -> PhysicalContact:
        """The contacts of results with units: of one point its stress, its SWT, what happens at it.

        Raises
        ------
        StudyError
            A ValueError, if the results have no units.
        """
        from swtstudy.faces.contacts import contact_of

        return contact_of(self._dataset)

    def extrema(self, dim: str, y: str | None = None) -> xr.Dataset:
        """Least and greatest values along a dimension, and where they are.

        Parameters
        ----------
        dim
            A dimension of the quantity.
        y
            The quantity: a data variable, such as "SWT" or "cycles_volume", or "s/s(name=value)". By
            default SWT, or the value of another criterion, where results have units, and else s, which is
            over a stress that changes with the mean load.

        Returns
        -------
        xarray.Dataset
            minimum, maximum and ratio (greatest over least), and their places at_minimum and at_maximum,
            over the other dimensions. NaN values are ignored; where all values are NaN, so is the result.

        Raises
        ------
        ValueError
            If the quantity has no such dimension, or the results are empty.
        """
        from swtstudy.results.evaluate import extrema

        return extrema(self._dataset, dim, y)

    def to_table(self) -> pd.DataFrame:
        """A tidy table: one row per point, one column per parameter or result, flags as words.

        Returns
        -------
        pandas.DataFrame
            Columns: the dimensions in their order, the other parameters, and the results but for the strain
            cycles counted, of which a point has several; what has a value for each direction has a column
            for each, such as "s_point[depth]". The index has the name "point", so that
            ``to_table().to_csv(file)`` writes a CSV file whose columns all have names.
        """
        from swtstudy.results.evaluate import to_table

        return to_table(self._dataset)
