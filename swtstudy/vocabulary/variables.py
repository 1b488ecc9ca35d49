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
#: Variables that the solver finds at every point.
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


def _attributes(
    long_name: str,
    comment: str,
    symbol: str = "",
    units: str = "1",
    flags: tuple[str, ...] = (),
    ancillary_variables: str = "",
) -> dict[str, Any]:
    """CF attributes of a data variable; with flags it has neither unit nor symbol."""
    found: dict[str, Any] = {"long_name": long_name, "comment": comment}
    if flags:
        return found | {"flag_values": np.arange(len(flags), dtype=np.int8), "flag_meanings": " ".join(flags)}
    more = {"units": units, "symbol": symbol, "ancillary_variables": ancillary_variables}
    return found | {name: value for name, value in more.items() if value}


#: Attributes of the data variables, following the CF conventions. Long names are short, since xarray's plots
#: use them as labels. The unit 1 is left out of a Dataset.
ATTRIBUTES: dict[str, dict[str, Any]] = {
    "s": _attributes(
        "SWT parameter SWT/SWT0",
        "maximum Smith-Watson-Topper parameter over SWT0 = E* delta0 / R; one elastic half-space with E*,"
        " G* against a rigid indenter",
        "s",
        ancillary_variables="s_error regime s_surface",
    ),
    "s_error": _attributes("absolute error of s", "estimated", r"\Delta s"),
    "s_surface": _attributes(
        "s on the surface circle",
        "s over the circle on the surface through the critical point and over all planes; in plane "
        "contacts s itself",
        r"s_\mathrm{surface}",
    ),
    "stick_zone": _attributes(
        "stick zone in s",
        "whether s and all beside it have the stick zone moved by the bulk stress: exactly, of a "
        "cylinder, or approximately, of a paraboloid, where the rise of the stress at the edge in tension"
        " is right within 4 %; it is in place where that is asked for, and where its motion is not known",
        flags=ZONES,
    ),
    "bulk_shift": _attributes(
        "shift of the stick zone",
        "by the strain of the bulk stress, in a_H: where stick_zone is in_place, s leaves it out and is "
        "too low at the edge in tension, see bulk_shift_ratio; NaN for other profiles than the paraboloid"
        " and the cylinder, without friction or stick, and where it exceeds the width of the slip zone",
        "e/a_H",
    ),
    "bulk_shift_ratio": _attributes(
        "shift over slip zone",
        "shift of the stick zone by the strain of the bulk stress over the width of the slip zone, "
        "however large: where stick_zone is in_place, s leaves it out and is too low at the edge in "
        "tension, it should be up to 6 % at 0.1, 24 % at 0.5 and 38 % at 1 higher for Q >= 0.2 mu P; NaN "
        "as the shift, without a permanent stick zone",
        "e/(a - c)",
    ),
    "prescribed_force_ratio": _attributes(
        "prescribed force ratio",
        "largest |F_x| over mu F_N that is prescribed in a cycle: above 1 there is no equilibrium",
        r"\max |F_x|/(\mu F_N)",
    ),
    "radius_ratio": _attributes(
        "contact radius over R",
        "largest contact radius of a cycle, half the width in plane contacts, over the radius R; of a "
        "table over that of the paraboloid with its contact radius and depth at rest",
        r"a_\mathrm{max}/R",
    ),
    "slide_ratio": _attributes(
        "slide over contact radius",
        "by how much the tangential displacement exceeds the limit of partial slip, over the largest "
        "contact radius of a cycle; 0 without gross slip, NaN where the bodies part",
        r"(u_\mathrm{A} - u_\mathrm{slip})/a_\mathrm{max}",
    ),
    "critical_x": _attributes(
        "critical point x/a_H",
        "position of the critical point on the surface, in units of a_H = sqrt(R delta0); NaN where s is "
        "0, not finite or that of the bulk stress alone: no point is critical there",
        "x/a_H",
    ),
    "critical_angle": _attributes(
        "critical plane angle",
        "angle of the normal of the critical plane against the x axis, in (-90, 90]; NaN where s is 0 or "
        "not finite: no plane is critical there",
        r"\varphi",
        units="degree",
    ),
    "regime": _attributes(
        "regime of the contact",
        "over the stationary cycle; in Python dataset.swt.words() gives its words",
        flags=REGIMES,
    ),
    "status": _attributes("state of the point", "whether the point has been computed", flags=STATES),
    "run": _attributes("run that made the value", "an index into the attribute runs; -1 if missing"),
    "message": _attributes("why the point failed", "there if points failed", units=""),
}


def has_units(dataset: xr.Dataset) -> bool:
    """Return whether results belong to real contacts."""
    return CONTACT in dataset.attrs


def require(dataset: xr.Dataset, *names: str) -> None:
    """Raise a StudyError if results have been left without some of their data variables."""
    if lacking := [name for name in names if name not in dataset]:
        allowed = "results that still have them"
        raise StudyError([Mistake("results", f"none of {', '.join(lacking)}", allowed)])
