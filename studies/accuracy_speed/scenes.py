"""The scenes of the chart, and their reference values of s."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from textbook import textbook_s

from swtstudy.solver.points import Points, solve_points

#: Tolerance of the reference values.
REFERENCE_RTOL = 1e-9
#: Grids of the independent computation that confirms them, and of a quick one.
FINE = {"springs": 4000, "steps": 2400, "positions": 400, "planes": 720, "aligned": True}
COARSE = {"springs": 60, "steps": 30, "positions": 15, "planes": 36, "aligned": True}
#: Points solved in one call, as in a study, and the step of their phases, rad.
BATCH, PHASE_STEP = 64, 1e-3


@dataclass(frozen=True)
class Scene:
    """A named parameter point, as a batch of one."""

    title: str
    point: Points

    def batch(self) -> Points:
        """As many neighbours of the point as a study solves at a time, itself first."""
        neighbours = self.point[np.zeros(BATCH, dtype=int)]
        return replace(neighbours, phase=neighbours.phase + PHASE_STEP * np.arange(BATCH))

    def reference(self) -> float:
        """s at the tightest tolerance."""
        return float(solve_points(self.point, REFERENCE_RTOL).s[0])

    def independent(self, grid: dict[str, int]) -> float:
        """s by the textbook method on an aligned grid."""
        return textbook_s(self.point, **grid).s


def _scene(
    title: str,
    profile: str = "paraboloid",
    normal_amplitude: float = 0.75,
    tangential_amplitude: float = 5 / 6,
    phase: float = 0.0,
    ratio: tuple[int, int] = (1, 1),
    **shape: float,
) -> Scene:
    values = (np.array([v]) for v in (0.3, 0.3, normal_amplitude))
    p, q = (np.array([v]) for v in ratio)
    lengths = {name: np.array([value]) for name, value in shape.items()}
    pull = np.array([tangential_amplitude])
    return Scene(title, Points(profile, *values, p, q, pull, np.array([phase]), lengths))


SCENES = (
    _scene("Table 1"),
    _scene("cusp: δA/δ0 = 0.1", normal_amplitude=0.1),
    _scene("hard: δA/δ0 = 8/9, ψ = 2.6", normal_amplitude=8 / 9, phase=2.6),
    _scene(
        "rounded punch, b/a_H = 0.5, ω2/ω1 = 5/2", "rounded_punch", ratio=(5, 2), phase=1.0, flat_radius=0.5
    ),
    _scene("small: δA/δ0 = uA = 0.05, ψ = 1", normal_amplitude=0.05, tangential_amplitude=0.05, phase=1.0),
)
