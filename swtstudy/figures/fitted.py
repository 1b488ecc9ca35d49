"""Predicted against observed lives."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from swtstudy.figures.sheet import Sheet, Width
from swtstudy.figures.style import Style, styled
from swtstudy.figures.wrap import wrap_texts, wrap_title

if TYPE_CHECKING:
    import xarray as xr

    from swtstudy.figures.figure import Figure

#: Size of the panel, inches.
_PANEL = (4.6, 4.4)
#: Factors with their lines.
_FACTORS = {1: "-", 2: "--", 5: ":"}


def draw_fit(fitted: xr.Dataset, style: Style | None = None, width: Width | None = None) -> Figure:
    """Predicted over observed lives, with the lines of equal lives and of factors of 2 and 5.

    Parameters
    ----------
    fitted
        From `swtstudy.fit`.
    style, width
        As for `swtstudy.accessor.SwtAccessor.figure`.
    """
    sheet = Sheet(1, 1, width, _PANEL)
    with styled(style, width):
        figure = sheet.figure()
        axes: Any = sheet.panels(figure, share_x="none", share_y="none")[0][0]
        both = np.concatenate([fitted.observed.values, fitted.predicted.values])
        ends = np.array([both.min() / 8.0, both.max() * 8.0])
        for factor, dashes in _FACTORS.items():
            look: dict[str, Any] = {"linestyle": dashes, "color": "0.4", "marker": "", "linewidth": 0.8}
            label = "equal" if factor == 1 else f"factor of {factor}"
            axes.plot(ends, ends * factor, label=label, **look)
            if factor > 1:
                axes.plot(ends, ends / factor, **look)
        axes.plot(fitted.observed, fitted.predicted, linestyle="none", marker="o", label="tests")
        axes.set(xscale="log", yscale="log", xlim=ends, ylim=ends)
        axes.set_xlabel("observed rounds")
        axes.set_ylabel("predicted rounds")
        axes.legend(loc="upper left")
        figure.suptitle("\n".join(fit_lines(fitted, math=True)))
        wrap_texts(figure)
        wrap_title(figure)
    return figure


def fit_lines(fitted: xr.Dataset, math: bool = False) -> list[str]:
    """Caption of a fit: its results with their intervals, and its scatter; ``math`` for math text."""
    lines = []
    level = f"{100 * fitted.attrs['confidence']:g} %"
    for name in ("critical_distance", "friction"):
        if name not in fitted:
            continue
        value, low, high = (float(fitted[f"{name}{end}"]) for end in ("", "_low", "_high"))
        unit = str(fitted[name].attrs["units"])
        shown = f"${fitted[name].attrs['symbol']}$" if math else name
        unit = "" if unit == "1" else f" {unit}"
        lines.append(f"{shown} = {value:.4g}{unit} ({level}: {low:.4g} to {high:.4g})")
    count = fitted.sizes["test"]
    scatter = 10.0 ** float(fitted.scatter)
    within = ", ".join(f"{int(fitted[f'within_{factor}'])} within a factor of {factor}" for factor in (2, 5))
    return [*lines, f"scatter: a factor of {scatter:.3g}", f"of {count} tests {within}"]
