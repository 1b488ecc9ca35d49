"""The table of data variables that results always have, or by what is given: their CF attributes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from swtstudy.vocabulary.choices import REGIMES
from swtstudy.vocabulary.files import read_table
from swtstudy.vocabulary.mistakes import refused

if TYPE_CHECKING:
    import xarray as xr

#: The attribute of results with units that says what their coordinates do not say of the contacts.
CONTACT = "contact"
#: States of a point, in the order of their flag values.
STATES = ("computed", "failed", "missing")
COMPUTED, FAILED, MISSING = range(3)
#: Variables that the solver finds at every point.
SOLVED = ("s", "s_error", "critical_x", "critical_angle", "regime", "s_surface")

#: Where the stick zone is in s, under a bulk stress that moves.
ZONES = ("in_place", "moved", "moved_approximately")


def flag_attributes(words: Sequence[str]) -> dict[str, Any]:
    """CF attributes of flags, from the words of their values 0, 1, …"""
    return {"flag_values": np.arange(len(words), dtype=np.int8), "flag_meanings": " ".join(words)}


#: Attributes of the data variables, following the CF conventions. The unit 1 is left out of a Dataset.
ATTRIBUTES: dict[str, dict[str, Any]] = read_table(__file__, "variables")
for _name, _words in {"stick_zone": ZONES, "regime": REGIMES, "status": STATES}.items():
    ATTRIBUTES[_name] |= flag_attributes(_words)


def has_units(dataset: xr.Dataset) -> bool:
    """Return whether results belong to real contacts."""
    return CONTACT in dataset.attrs


def require(dataset: xr.Dataset, *names: str) -> None:
    """Raise a StudyError if results have been left without some of their data variables."""
    if lacking := [name for name in names if name not in dataset]:
        raise refused("results", f"none of {', '.join(lacking)}", "results that still have them")
