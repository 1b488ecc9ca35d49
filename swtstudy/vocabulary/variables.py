"""The table of data variables that results always have, or by what is given: their CF attributes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from swtstudy.vocabulary.choices import REGIMES
from swtstudy.vocabulary.mistakes import Mistake, StudyError

if TYPE_CHECKING:
    import xarray as xr

#: The attribute of results with units that says what their coordinates do not say of the contacts.
CONTACT = "contact"
#: States of a point, in the order of their flag values.
STATES = ("computed", "failed", "missing")
COMPUTED, FAILED, MISSING = range(3)
#: What the solver finds of every point.
SOLVED = ("s", "s_error", "critical_x", "critical_angle", "regime", "s_surface")

#: Where the stick zone is in s, under a bulk stress that moves.
ZONES = ("in_place", "moved", "moved_approximately")
#: Data variables that results have where something is given that they are about.
MARGINS = (
    "stick_zone",
    "bulk_shift",
    "bulk_shift_ratio",
    "prescribed_force_ratio",
    "radius_ratio",
    "slide_ratio",
)
#: Attributes of the data variables, following the CF conventions. Long names are short, since xarray's plots
#: use them as labels. The unit 1 is left out of a Dataset.
ATTRIBUTES: dict[str, dict[str, Any]] = {
    "s": {
        "long_name": "SWT parameter SWT/SWT0",
        "units": "1",
        "symbol": r"s",
        "ancillary_variables": "s_error regime s_surface",
        "comment": (
            "maximum Smith-Watson-Topper parameter over SWT0 = E* delta0 / R; "
            "one elastic half-space with E*, G* against a rigid indenter"
        ),
    },
    "s_error": {
        "long_name": "absolute error of s",
        "comment": "estimated",
        "units": "1",
        "symbol": r"\Delta s",
    },
    "s_surface": {
        "long_name": "s on the surface circle",
        "comment": "s over the circle on the surface through the critical point and over all planes; "
        "in plane contacts s itself",
        "units": "1",
        "symbol": r"s_\mathrm{surface}",
    },
    "stick_zone": {
        "long_name": "stick zone in s",
        "comment": "whether s and all beside it have the stick zone moved by the bulk stress: exactly, of a "
        "cylinder, or approximately, of a paraboloid, where the rise of the stress at the edge in tension is "
        "right within 4 %; it is in place where that is asked for, and where its motion is not known",
        "flag_values": np.arange(len(ZONES), dtype=np.int8),
        "flag_meanings": " ".join(ZONES),
    },
    "bulk_shift": {
        "long_name": "shift of the stick zone",
        "comment": "by the strain of the bulk stress, in a_H: where stick_zone is in_place, s leaves it out "
        "and is too low at the edge in tension, see bulk_shift_ratio; NaN for other profiles than the "
        "paraboloid and the cylinder, without friction or stick, and where it exceeds the width of the slip "
        "zone",
        "units": "1",
        "symbol": r"e/a_H",
    },
    "bulk_shift_ratio": {
        "long_name": "shift over slip zone",
        "comment": "shift of the stick zone by the strain of the bulk stress over the width of the slip "
        "zone, however large: where stick_zone is in_place, s leaves it out and is too low at the edge in "
        "tension, it should be up to 6 % at 0.1, 24 % at 0.5 and 38 % at 1 higher for Q >= 0.2 mu P; NaN as "
        "the shift, without a permanent stick zone",
        "units": "1",
        "symbol": r"e/(a - c)",
    },
    "prescribed_force_ratio": {
        "long_name": "prescribed force ratio",
        "comment": "largest |F_x| over mu F_N that is prescribed in a cycle: above 1 there is no equilibrium",
        "units": "1",
        "symbol": r"\max |F_x|/(\mu F_N)",
    },
    "radius_ratio": {
        "long_name": "contact radius over R",
        "comment": "largest contact radius of a cycle, half the width in plane contacts, over the radius R; "
        "of a table over that of the paraboloid with its contact radius and depth at rest",
        "units": "1",
        "symbol": r"a_\mathrm{max}/R",
    },
    "slide_ratio": {
        "long_name": "slide over contact radius",
        "comment": "by how much the tangential displacement exceeds the limit of partial slip, over the "
        "largest contact radius of a cycle; 0 without gross slip, NaN where the bodies part",
        "units": "1",
        "symbol": r"(u_\mathrm{A} - u_\mathrm{slip})/a_\mathrm{max}",
    },
    "critical_x": {
        "long_name": "critical point x/a_H",
        "comment": "position of the critical point on the surface, in units of a_H = sqrt(R delta0); NaN "
        "where s is 0, not finite or that of the bulk stress alone: no point is critical there",
        "units": "1",
        "symbol": r"x/a_H",
    },
    "critical_angle": {
        "long_name": "critical plane angle",
        "comment": "angle of the normal of the critical plane against the x axis, in (-90, 90]; NaN where "
        "s is 0 or not finite: no plane is critical there",
        "units": "degree",
        "symbol": r"\varphi",
    },
    "regime": {
        "long_name": "regime of the contact",
        "comment": "over the stationary cycle; in Python dataset.swt.words() gives its words",
        "flag_values": np.arange(len(REGIMES), dtype=np.int8),
        "flag_meanings": " ".join(REGIMES),
    },
    "status": {
        "long_name": "state of the point",
        "comment": "whether the point has been computed",
        "flag_values": np.arange(len(STATES), dtype=np.int8),
        "flag_meanings": " ".join(STATES),
    },
    "run": {
        "long_name": "run that made the value",
        "comment": "an index into the attribute runs; -1 if missing",
        "units": "1",
    },
    "message": {"long_name": "why the point failed", "comment": "there if points failed"},
}


def has_units(dataset: xr.Dataset) -> bool:
    """Return whether results are those of real contacts."""
    return CONTACT in dataset.attrs


def require(dataset: xr.Dataset, *names: str) -> None:
    """Raise a StudyError if results have been left without some of their data variables."""
    if lacking := [name for name in names if name not in dataset]:
        allowed = "results that still have them"
        raise StudyError([Mistake("results", f"none of {', '.join(lacking)}", allowed)])
