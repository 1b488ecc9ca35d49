"""The paper's words on the influence of each parameter, beside the measured share of the variance."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from swtstudy.vocabulary.axes import AXES
from swtstudy.vocabulary.wording import value_words

if TYPE_CHECKING:
    import xarray as xr

#: What the paper says, by parameter; of the others it says nothing.
SAYS = {
    "poisson_ratio": "weak but intricate (section 4.1)",
    "friction": "s rises with it (section 4.1)",
    "normal_amplitude": "amplifies the influence of the phase (figures 3 and 4)",
    "frequency_ratio": "the phase matters most at 1/4, 1/2 and 3/2 (figure 4)",
    "tangential_amplitude": "s rises with it (section 4.1)",
    "phase": "s is nearly constant over it for small δA, else up to almost a factor of two (figure 3)",
    "flat_radius": "s falls for the rounded punch, rises for the truncated paraboloid (figure 5)",
    "waviness_amplitude": "strong, with oscillations (figure 7)",
    "wavelength": "sets the period of the oscillations over h (figure 7)",
}


def table(indices: xr.Dataset, of_paper: bool = False) -> str:
    """Sobol indices as Markdown.

    Parameters
    ----------
    indices
        From `swtstudy.sensitivity`.
    of_paper
        Whether they are those of a study of the paper, with what that says.
    """
    return "\n".join(_lines(indices, of_paper)) + "\n"


def _lines(indices: xr.Dataset, of_paper: bool) -> Iterator[str]:
    axes = [str(dim) for dim in indices.first_order.dims if dim not in ("quantity", "parameter")]
    places = indices.stack(place=axes) if axes else indices.expand_dims("place")
    level = f"{100 * indices.attrs['confidence']:g} %"
    yield f"# {indices.attrs['title']}"
    for quantity in indices["quantity"].values:
        for number in range(places.sizes["place"]):
            one = places.sel(quantity=quantity).isel(place=number)
            where = [_place(name, one[name]) for name in axes]
            yield ""
            yield f"## {', '.join([str(quantity), *where])}"
            yield ""
            yield f"mean {float(one['mean']):.4g}, standard deviation {float(one['variance']) ** 0.5:.4g}"
            yield ""
            yield f"| parameter | alone | {level} | with others | {level} |{' the paper says |' * of_paper}"
            yield "|---|---|---|---|---|" + "---|" * of_paper
            for name in indices["parameter"].values:
                row = one.sel(parameter=name)
                cells = [_cells(row, key) for key in ("first_order", "total")]
                # Of other quantities than s the paper says nothing here.
                says = SAYS.get(name, "") if quantity == "s" else ""
                line = f"| {AXES[name].letter} {name} | {cells[0]} | {cells[1]} |"
                yield line + f" {says} |" * of_paper


def _place(name: str, at: xr.DataArray) -> str:
    """A value of an axis, with its unit."""
    units = at.attrs.get("units", "1")
    return f"{name} = {value_words(name, at.item())}{'' if units in ('1', 'rad', '') else f' {units}'}"


def _cells(row: xr.Dataset, key: str) -> str:
    """An index, and its confidence interval."""
    value, low, high = (float(row[f"{key}{end}"]) for end in ("", "_low", "_high"))
    return f"{value:.3f} | {low:.3f} to {high:.3f}"
