"""Everything that a dimension of results may be: parameters, and what only some results range over."""

from __future__ import annotations

from collections import ChainMap
from collections.abc import Mapping
from math import inf

from swtstudy.vocabulary.parameter import Parameter, spelled
from swtstudy.vocabulary.parameters import PARAMETERS

#: Into the body from the critical point: straight down, or along the critical plane.
DIRECTIONS = ("depth", "critical_plane")

#: What quantities beside s range over, while the points do not.
QUANTITY_AXES: dict[str, Parameter] = {
    p.name: p
    for p in (
        Parameter(
            "critical_distance",
            r"\ell/a_H",
            "ℓ",
            "critical distance of the nonlocal values",
            None,
            0.0,
            10.0,
            open_lower=True,
            part="quantity",
            scale="a_H",
        ),
        Parameter(
            "direction",
            "",
            "",
            "direction from the critical point",
            kind="name",
            names=DIRECTIONS,
            part="quantity",
        ),
    )
}

#: What a real contact has besides; in which units the study says, see `swtstudy.units.rows`.
CONTACT_AXES: dict[str, Parameter] = {
    p.name: p
    for p in (
        Parameter(name, symbol, letter, meaning, upper=inf, open_lower=True, part="contact")
        for name, symbol, letter, meaning in (
            ("young_modulus", "E", "E", "Young modulus"),
            ("radius", "R", "R", "radius of the relative curvature, 1/R = 1/R1 + 1/R2"),
            ("depth", r"\delta_0", "δ0", "mean indentation depth"),
            ("normal_force", "F_0", "F0", "normal force at the mean depth"),
            ("contact_length", "L", "L", "length of a plane contact, across its section"),
            ("bulk_stress_ratio", r"R_\sigma", "Rσ", "least over largest bulk stress"),
            ("body", r"\mathrm{body}", "body", "body, 1 or 2"),
        )
    )
}

AXES: Mapping[str, Parameter] = ChainMap(PARAMETERS, QUANTITY_AXES, CONTACT_AXES)

#: Name and letter of a parameter by what may be typed for it: its letter, its symbol, the numerator of that.
SYMBOLS: dict[str, tuple[str, str]] = {
    spelled(symbol): (row.name, row.letter)
    for row in (*CONTACT_AXES.values(), *reversed(PARAMETERS.values()))
    for symbol in (row.letter, row.symbol, row.symbol.split("/")[0])
}
