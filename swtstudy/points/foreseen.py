"""Limits of the model that points exceed, as far as their loads alone tell: known before they are solved."""

from __future__ import annotations

import numpy as np

from swtstudy.points.canonical import Distinct
from swtstudy.points.grid import Grid
from swtstudy.points.labelled import label, margins
from swtstudy.vocabulary.choices import REGIMES

#: Larger grids are not looked at: a point takes some 30 µs.
MOST_POINTS = 100_000
#: Ratio of a tangential force to μ F_N that is 1 to rounding.
_ROUNDING = 1e-9


def foreseen(grid: Grid) -> tuple[str, ...]:
    """The lines on validity that results of a grid will have whatever their s; none of a very large grid.

    They tell tangential forces above μ F_N, contacts too large for half-spaces, and bulk strains that shift
    the stick zone.
    """
    if grid.size > MOST_POINTS or not grid.margins:
        return ()
    found = margins(Distinct.of(grid), grid, without_compiler=True)
    unknown = dict.fromkeys(("s", "s_error", "critical_x", "critical_angle", "s_surface"))
    arrays = {name: np.full(grid.size, np.nan) for name in unknown}
    lost = found.get("prescribed_force_ratio", np.zeros(grid.size)) > 1.0 + _ROUNDING
    states = [REGIMES.index(name) for name in ("no_equilibrium", "stick")]
    arrays["regime"] = np.where(lost, *states).astype(np.int8)
    dataset = label(grid, arrays | found)
    return tuple(str(dataset.attrs.get("validity", "")).splitlines())
