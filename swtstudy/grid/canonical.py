"""Canonical points: one row of numbers for everything that is physically one point.

Two points of a grid are one if their rounded values agree, if the symmetry of the load protocol maps one
onto the other, or if they differ only in parameters that do not matter (the shape of another profile, a
punch face of radius 0, the phase of an oscillation of amplitude 0).
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from swtstudy.parameters import PARAMETERS, PROFILE_SHAPES

if TYPE_CHECKING:
    from swtstudy.mechanics.points import FloatArray, IntArray, Points

PROFILES = tuple(PROFILE_SHAPES)
SHAPE_COLUMNS = tuple(dict.fromkeys(name for shape in PROFILE_SHAPES.values() for name in shape))


def _numbers(part: str) -> tuple[str, ...]:
    return tuple(name for name, row in PARAMETERS.items() if row.part == part and row.kind == "number")


#: Columns that make the load, ω2/ω1 = p/q.
LOAD_COLUMNS = ("p", "q", *_numbers("load"))
#: Parameters that are a number of every point, whatever its profile; friction is before the Poisson ratio,
#: which the tractions do not depend on.
NUMBERS = (*_numbers("load"), *reversed(_numbers("body")))
#: Columns of a table of canonical points, in the order in which they are sorted; the profile is an index into
#: `PROFILES`.
COLUMNS = ("profile", *LOAD_COLUMNS, *SHAPE_COLUMNS, *reversed(_numbers("body")))
_COLUMN = {name: index for index, name in enumerate(COLUMNS)}

#: Digits to which values are told apart: 0.2 and 0.1 + 0.1 are one point.
DIGITS = 12

#: The parameter of a shape whose value 0 makes the profile a paraboloid.
_VANISHING = {
    "rounded_punch": "flat_radius",
    "truncated_paraboloid": "flat_radius",
    "wavy_paraboloid": "waviness_amplitude",
}


def canonical_number(value: float) -> float:
    """A number rounded to `DIGITS` significant digits, without the sign of zero."""
    return float(f"{value:.{DIGITS}g}") + 0.0


def canonical_points(columns: Mapping[str, NDArray]) -> tuple[FloatArray, NDArray[np.bool_]]:
    """Canonical rows of points.

    Parameters
    ----------
    columns
        A number for every name in `COLUMNS`, each broadcastable to shape (n,).

    Returns
    -------
    table
        Shape (n, len(COLUMNS)); columns that do not matter for a point are 0.
    mirrored
        Shape (n,): True where x is mirrored with respect to the canonical point.
    """
    from swtstudy.mechanics.load.symmetry import fold_phase

    table = np.stack(np.broadcast_arrays(*(np.asarray(columns[name], float) for name in COLUMNS)), axis=-1)
    for code, profile in enumerate(PROFILES):
        vanishing = _VANISHING.get(profile)
        if vanishing is not None:
            flat = (table[:, 0] == code) & (table[:, _COLUMN[vanishing]] == 0)
            table[flat, 0] = PROFILES.index("paraboloid")
    for code, profile in enumerate(PROFILES):
        unused = [_COLUMN[name] for name in SHAPE_COLUMNS if name not in PROFILE_SHAPES[profile]]
        table[np.ix_(table[:, 0] == code, unused)] = 0
    # A load that does not oscillate in the normal direction has neither a phase nor a frequency ratio.
    table[np.ix_(table[:, _COLUMN["normal_amplitude"]] == 0, [_COLUMN["phase"]])] = 0
    constant = table[:, _COLUMN["normal_amplitude"]] == 0
    table[np.ix_(constant, [_COLUMN["p"], _COLUMN["q"]])] = 1
    p, q = (table[:, _COLUMN[name]].astype(np.int64) for name in "pq")
    # In units of π and nudged: multiples of the period fall on one side whatever their rounding error.
    nudge = 2 * 10.0**-DIGITS
    folded, mirrored = fold_phase(table[:, _COLUMN["phase"]] + nudge, p, q)
    table[:, _COLUMN["phase"]] = np.maximum(np.round((folded - nudge) / np.pi, DIGITS), 0.0) * np.pi
    return table, mirrored


def group_rows(table: FloatArray) -> tuple[IntArray, IntArray]:
    """The distinct rows of a table, in lexicographic order.

    Parameters
    ----------
    table
        Shape (n, k), without NaN.

    Returns
    -------
    first
        Shape (m,): the index of one occurrence of every distinct row.
    group
        Shape (n,): the index into `first` of the row equal to each row.
    """
    group = np.zeros(len(table), np.int64)
    first = np.zeros(min(len(table), 1), np.int64)
    for column in table.T:
        values, code = np.unique(column, return_inverse=True)
        # Column by column on integers: sorting whole rows takes ten times as long.
        _, first, group = np.unique(group * len(values) + code, return_index=True, return_inverse=True)
    return first, group


def points_from(table: FloatArray) -> Points:
    """A batch for the solver from canonical rows that share one profile."""
    from swtstudy.mechanics.points import Points

    profile = PROFILES[int(table[0, 0])]
    return Points(
        profile=profile,
        p=table[:, _COLUMN["p"]].astype(np.int64),
        q=table[:, _COLUMN["q"]].astype(np.int64),
        shape={name: table[:, _COLUMN[name]].copy() for name in PROFILE_SHAPES[profile]},
        **{name: table[:, _COLUMN[name]].copy() for name in NUMBERS},
    )


def describe_point(row: FloatArray) -> str:
    """A canonical row in words, for messages: only what matters for its profile."""
    profile = PROFILES[int(row[0])]
    parts = [f"profile={profile}"]
    parts += [f"{name}={row[_COLUMN[name]]:.6g}" for name in PROFILE_SHAPES[profile]]
    parts.append(f"frequency_ratio={row[_COLUMN['p']]:.0f}/{row[_COLUMN['q']]:.0f}")
    return ", ".join([*parts, *(f"{name}={row[_COLUMN[name]]:.6g}" for name in NUMBERS)])
