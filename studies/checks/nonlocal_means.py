"""What nonlocal means cost, how accurate they are, and what they cost before.

``python studies/checks/nonlocal_means.py`` writes results/nonlocal_means.md: for each scene the processor
time a point of one distance and of eleven, and the largest error claimed; and, for comparison, the time and
the error of a plain rule: Gauss's in spherical coordinates about the critical point, each place with the same
instants, those that decide swt at the critical point.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from swtstudy.fields.decisive import decisive_nodes
from swtstudy.mechanics import Points, solve_points
from swtstudy.mechanics.body.body import Body
from swtstudy.mechanics.body.nonlocal_swt import NonlocalSwt, nonlocal_swt
from swtstudy.mechanics.stress.scene import scene_of

PHASES = np.array([0.0, 0.7, 1.6, 2.5, 4.0])
DISTANCE, SEVERAL = np.array([0.1]), np.geomspace(0.01, 0.1, 11)
#: Places of the plain rule: over the radius, the polar angle and the azimuth.
PLAIN = 8, 8, 12
#: Profile, its shape, δA/δ0 and ω2/ω1 of each scene.
SCENES = [
    ("paraboloid", {}, 0.25, (1, 1)),
    ("paraboloid", {}, 0.75, (1, 1)),
    ("paraboloid", {}, 0.75, (1, 2)),
    ("rounded_punch", {"flat_radius": 0.5}, 0.75, (1, 1)),
    ("truncated_paraboloid", {"flat_radius": 0.5}, 0.75, (1, 1)),
    ("wavy_paraboloid", {"waviness_amplitude": 0.02, "wavelength": 5.0}, 0.75, (1, 1)),
]
HEADER = (
    "| scene | one distance | eleven | error claimed | plain rule | its error |\n|---|---|---|---|---|---|\n"
)


def points_of(
    profile: str, shape: dict[str, float], amplitude: float, ratio: tuple[int, int], count: int
) -> Points:
    """Table 1 at some phases, with another amplitude and frequency ratio."""
    one = np.ones(count)
    p, q = (np.full(count, each) for each in ratio)
    columns = {name: value * one for name, value in shape.items()}
    return Points(profile, 0.3 * one, 0.3 * one, amplitude * one, p, q, 5 / 6 * one, PHASES[:count], columns)


def timed(call: Callable[[], object], count: int) -> tuple[object, float]:
    """Result of a call, and its processor time a point, ms."""
    begin = time.process_time()
    result = call()
    return result, 1e3 * (time.process_time() - begin) / count


def plain_mean(body: Body, x: float, distance: float) -> float:
    """Mean over a half sphere by Gauss's rule in spherical coordinates."""
    rules = (np.polynomial.legendre.leggauss(count) for count in PLAIN)
    (ρ, of_ρ), (c, of_c), (φ, of_φ) = ((0.5 + 0.5 * node, 0.5 * weight) for node, weight in rules)
    ρ, c, φ = np.meshgrid(distance * ρ, c, np.pi * φ, indexing="ij")
    s = np.sqrt(1.0 - c * c)
    swt = body.swt(x + ρ * s * np.cos(φ), ρ * s * np.sin(φ), ρ * c).swt
    weight = 3.0 * (ρ / distance) ** 2 * of_ρ[:, None, None] * of_c[:, None] * of_φ
    return float((weight * swt).sum())


def plain_means(points: Points, critical_x: NDArray[np.float64]) -> NDArray[np.float64]:
    """Means over half spheres of `DISTANCE`, each point for itself."""
    found = []
    for k, x in enumerate(critical_x):
        scene = scene_of(points.take(np.array([k])))
        body = Body(scene, decisive_nodes(scene, (float(x), 0.0, 0.0)), 60)
        found.append(plain_mean(body, float(x), DISTANCE[0]))
    return np.array(found)


def row(scene: tuple[str, dict[str, float], float, tuple[int, int]], count: int) -> str:
    """Line of the table."""
    points = points_of(*scene, count)
    solution = solve_points(points, 1e-5)
    at = scene_of(points), solution.critical_x, solution.critical_angle
    one, of_one = timed(lambda: nonlocal_swt(*at, DISTANCE), count)
    _, of_several = timed(lambda: nonlocal_swt(*at, SEVERAL), count)
    plain, of_plain = timed(lambda: plain_means(points, solution.critical_x), count)
    assert isinstance(one, NonlocalSwt)
    assert isinstance(plain, np.ndarray)
    claimed = (one.volume_error / one.volume).max()
    off = np.abs(plain / one.volume[:, 0] - 1.0).max()
    name = f"{scene[0]}, δA/δ0 = {scene[2]:g}, ω2/ω1 = {scene[3][0]}/{scene[3][1]}"
    cells = f"{of_one:.0f} ms", f"{of_several:.0f} ms", f"{claimed:.1e}", f"{of_plain:.0f} ms", f"{off:.1e}"
    return f"| {name} | {' | '.join(cells)} |"


def main() -> None:
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--results", type=Path, default=Path("results"), help="folder for the table")
    arguments.add_argument("--quick", action="store_true", help="two scenes of one point each")
    given = arguments.parse_args()
    scenes, count = (SCENES[:2], 1) if given.quick else (SCENES, len(PHASES))
    lines = []
    for scene in scenes:
        lines.append(row(scene, count))
        print(lines[-1], flush=True)
    title = (
        "# Nonlocal means\n\nProcessor time a point with all three means, ℓ = 0.1 a_H or eleven distances "
    )
    title += (
        "up to that; largest relative error of the volume mean. The plain rule has the volume mean alone."
    )
    given.results.mkdir(exist_ok=True)
    table = given.results / "nonlocal_means.md"
    table.write_text(f"{title}\n\n{HEADER}" + "\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
