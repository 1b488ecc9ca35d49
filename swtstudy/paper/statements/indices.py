"""Sobol indices as a table; for studies of the paper, beside its words on each parameter.

The template, which holds these words, is ``indices.md``.
"""

from __future__ import annotations

import xarray as xr

from swtstudy.paper.rendered import rendered
from swtstudy.vocabulary.parameters import AXES
from swtstudy.vocabulary.wording import unit_words, value_words


def table(indices: xr.Dataset, of_paper: bool = False) -> str:
    """Sobol indices as Markdown.

    Parameters
    ----------
    indices
        From `swtstudy.sensitivity`.
    of_paper
        Whether they belong to a study of the paper, with the paper's words.
    """
    axes = [str(dim) for dim in indices.first_order.dims if dim not in ("quantity", "parameter")]
    units = {name: unit_words(indices[name].attrs.get("units", "1")) for name in axes}
    places, parts = indices.stack(place=["quantity", *axes]), []
    for number in range(places.sizes["place"]):
        one = places.isel(place=number)
        where = [f"{name} = {value_words(name, one[name].item())}{unit}" for name, unit in units.items()]
        parts.append((", ".join([one.quantity.item(), *where]), one))
    letters = {name: AXES[name].letter for name in indices["parameter"].values}
    return rendered("statements/indices.md", indices=indices, parts=parts, letters=letters, of_paper=of_paper)
