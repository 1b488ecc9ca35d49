"""The legend beside or below all panels; the figure grows to hold it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from matplotlib.legend import Legend
    from numpy.typing import NDArray

#: Points in an inch.
_POINTS = 72.0


def add_legend(figure: Figure, axes: NDArray[Any], below: bool) -> None:
    """Add one legend for all panels, lines before markers; no entry is cut off.

    Parameters
    ----------
    figure
        The figure, which grows by the size of the legend.
    axes
        Its panels.
    below
        Whether the legend is below the panels instead of to their right.
    """
    handles: dict[str, Any] = {}
    for one in axes.flat:
        for handle, label in zip(*one.get_legend_handles_labels(), strict=True):
            handles.setdefault(label, handle)
    labels = sorted(handles, key=lambda label: handles[label].get_linestyle() == "None")
    if not labels:
        return
    place: Any = "outside lower center" if below else "outside right upper"
    columns = range(len(labels), 0, -1) if below else range(1, len(labels) + 1)
    for count in columns:
        legend = figure.legend([handles[label] for label in labels], labels, loc=place, ncols=count)
        width, height = _inches(legend, figure.dpi)
        if count == columns[-1] or (
            width <= figure.get_figwidth() if below else height <= figure.get_figheight()
        ):
            break
        legend.remove()
    if below:
        figure.set_size_inches(max(figure.get_figwidth(), width), figure.get_figheight() + height)
    else:
        figure.set_size_inches(figure.get_figwidth() + width, max(figure.get_figheight(), height))


def _inches(legend: Legend, dpi: float) -> tuple[float, float]:
    """Width and height of a legend with its padding, inches."""
    around = 2.0 * legend.borderaxespad * float(legend.get_texts()[0].get_fontsize()) / _POINTS
    box = legend.get_window_extent()
    return box.width / dpi + around, box.height / dpi + around
