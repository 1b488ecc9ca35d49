"""The audit of one parameter point."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from swtstudy.paper.audit.body_maximum import body_maximum
from swtstudy.paper.audit.dense import dense_maximum
from swtstudy.points.canonical import ROW, Definitions, points_from
from swtstudy.solver.solve import solve_points
from swtstudy.vocabulary.arrays import FloatArray
from swtstudy.vocabulary.choices import REGIMES

#: Which of the surface line's assumptions the body's maximum breaks, in the order of the flag values; the
#: last one is for points without a finite s, or with their maximum where the pressure is unbounded.
VERDICTS = ("none", "line_search", "plane_through_y", "symmetry_line", "surface", "not_finite")

#: Relative excess of the body's maximum that counts; s itself is computed to a tenth of this.
TOLERANCE = 1e-3
#: Distances and direction cosines that count as 0.
_ZERO = 1e-6


@dataclass(frozen=True)
class AuditedPoint:
    """One audited point.

    Attributes
    ----------
    s, s_error, s_surface, critical_x, regime
        From the solver: the maximum on the surface line and its error, the maximum on the circle through the
        critical point, the position of the former, and the name of the regime.
    s_dense
        What a dense look at the surface line finds; NaN without one.
    s_all_planes
        swt at that position over all plane orientations, from the field of the body.
    s_body
        Largest swt in the body.
    position, normal
        Shape (3,): where it is, and the normal of its plane.
    """

    s: float
    s_error: float
    s_surface: float
    critical_x: float
    regime: str
    s_dense: float
    s_all_planes: float
    s_body: float
    position: FloatArray
    normal: FloatArray

    @property
    def excess(self) -> float:
        """By how much the body's maximum exceeds s, relative."""
        return self.s_body / self.s - 1.0 if self.s != 0.0 else float(self.s_body > 0.0)

    @property
    def shortfall(self) -> float:
        """By how much s is below the dense look, relative; 0 within its error, NaN without a dense look."""
        if not np.isfinite(self.s_dense):
            return float("nan")
        return max(self.s_dense - self.s - self.s_error, 0.0) / self.s_dense if self.s_dense > 0.0 else 0.0

    @property
    def remainder(self) -> float:
        """By how much it exceeds s_surface, relative."""
        return self.s_body / self.s_surface - 1.0 if self.s_surface != 0.0 else float(self.s_body > 0.0)

    @property
    def verdict(self) -> str:
        """The first of the solver's assumptions that the body's maximum breaks."""
        if not np.isfinite(self.s_surface):
            return "not_finite"
        _, y, z = self.position
        if self.excess <= TOLERANCE:
            return "none"
        if z > _ZERO:
            return "surface"
        if abs(y) > _ZERO:
            return "symmetry_line"
        return "plane_through_y" if abs(self.normal[1]) > _ZERO else "line_search"


def audit_point(row: Sequence[float], definitions: Definitions, dense: bool = False) -> AuditedPoint:
    """Audit one canonical row (`swtstudy.points.canonical`), with what the user has defined by its code.

    With ``dense``, a dense grid over its surface line, too (`swtstudy.paper.audit.dense`).
    """
    points = points_from(np.array([tuple(row)], ROW), definitions)
    line = solve_points(points, TOLERANCE / 10.0)
    s, x = float(line.s[0]), float(line.critical_x[0])
    regime, s_dense = REGIMES[int(line.regime[0])], float("nan")
    if dense and np.isfinite(s):
        s_dense = dense_maximum(points)[0]
    solved = s, float(line.s_error[0]), float(line.s_surface[0]), x, regime, s_dense
    if not np.isfinite(line.s_surface[0]):
        return AuditedPoint(*solved, np.nan, np.nan, np.full(3, np.nan), np.full(3, np.nan))
    # The field handles gross slip and the 0/0 of a vanishing contact: NumPy's warnings would only alarm.
    with np.errstate(all="ignore"):
        body, at_line = body_maximum(points, x)
    return AuditedPoint(*solved, float(at_line.swt), body.swt, body.position, body.normal)
