"""By how much may the first look be wrong? Where swt is largest, over the highest that was seen.

``python studies/checks/margins.py``, from the project folder, writes results/margins.md. The search climbs
from places within three shares of the highest that a first look sees, see `SHARE` of
`swtstudy.mechanics.line.first_look`. At random points of `overlooked.py`, of another seed: how low was what
was seen at the neighbours of the place that turned out to be the highest? What is far above the margin cannot
be lost by a first look.

And how many pieces that hold a maximum would the first three values leave, if they were trusted more? Of each
piece 33 values are looked at.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from unittest.mock import patch

import numpy as np
from overlooked import SCENES

from swtstudy.mechanics.line import first_look
from swtstudy.mechanics.line.first_look import SHARE, STEPS, joined_pieces, look_at, resolved
from swtstudy.mechanics.line.look import Accuracy
from swtstudy.mechanics.line.maximum import maximum
from swtstudy.mechanics.line.positions import Pieces
from swtstudy.mechanics.line.singular_edge import not_finite
from swtstudy.mechanics.points import FloatArray, Points
from swtstudy.mechanics.solver import scenes

SEED, RTOL = 5, 1e-4
#: Other values of OF_FIRST and IN_LONG of the first look.
TRUSTED = [(first, 0.0) for first in (1.0, 2.0, 4.0, 8.0)]
TRUSTED += [(first, 0.7) for first in (1.0, 2.0, 4.0, 8.0, 16.0)]
#: Values of a piece between two of its first ones.
BETWEEN = 16


def seen_there(points: Points) -> FloatArray:
    """What was seen beside the places of the maxima, over the highest seen, where there is tension."""
    found = []
    for _, scene in scenes(points):
        scene = scene.take(np.flatnonzero(~not_finite(scene)))
        if not len(scene):
            continue
        positions, seen = resolved(scene, joined_pieces(scene, Pieces.of(scene.split_at_breakpoints())))
        top = maximum(scene, Accuracy.for_tolerance(RTOL))
        for k in np.flatnonzero((top.swt > 0.0) & np.isfinite(top.position)):
            own = np.flatnonzero(positions.point == k)
            swt = seen.swt[own]
            side = 0 if top.position[k] > 0.0 or swt.shape[1] == 1 else 1
            at = np.searchsorted(positions.r[own], abs(top.position[k]))
            # What rounding alone makes was not seen.
            if swt.max() > 0.0:
                found.append(swt[max(at - 1, 0) : at + 2, side].max() / swt.max())
    return np.array(found)


def trusted(points: Points) -> FloatArray:
    """Pieces, those that are looked at further, and of the others those that hide a maximum: one row each.

    A maximum is hidden if it is higher than what the first values show, and among the highest.
    """
    counts = np.zeros((len(TRUSTED), 3))
    for _, scene in scenes(points):
        scene = scene.take(np.flatnonzero(~not_finite(scene)))
        if not len(scene):
            continue
        pieces = joined_pieces(scene, Pieces.of(scene.split_at_breakpoints()))
        number, steps = len(pieces.point), STEPS * BETWEEN
        piece, share = np.repeat(np.arange(number), steps + 1), np.tile(np.arange(steps + 1) / steps, number)
        values = look_at(scene, pieces, piece, share).swt.reshape(number, steps + 1, -1)
        top = np.zeros(len(scene))
        np.maximum.at(top, pieces.point, values.max(axis=(1, 2)))
        top = top[pieces.point]
        rest = np.full(number, np.inf), np.zeros(number)
        few, highest = values[:, ::BETWEEN], values.max(axis=(1, 2))
        hidden = (highest - few.max(axis=(1, 2)) > 0.005 * top) & (highest > (1.0 - SHARE) * top)
        for row, (first, in_long) in enumerate(TRUSTED):
            with patch.multiple(first_look, OF_FIRST=first, IN_LONG=in_long):
                open_ = first_look._open_gaps(few, top, *rest, pieces.are_long).any(axis=1)
            counts[row] += number, open_.sum(), (hidden & ~open_).sum()
    return counts


def main() -> None:
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--results", type=Path, default=Path("results"), help="folder for the report")
    arguments.add_argument("--quick", action="store_true", help="one scene, to see that it runs")
    given = arguments.parse_args()
    lines = [
        "# By how much may the first look be wrong?",
        "",
        "What the first look saw at the neighbours of the place of the largest swt, over the highest that it "
        f"saw. The search climbs from {1.0 - 3.0 * SHARE:.2f} on. `python studies/checks/margins.py`",
        "",
        "| scene | points | lowest | next | 1 in 100 below |",
        "|---|---|---|---|---|",
    ]
    counts = np.zeros((len(TRUSTED), 3))
    for number, (name, (drawn, _)) in enumerate(list(SCENES.items())[: 1 if given.quick else None]):
        chunks = range(1 if given.quick else 10)
        drawn_points = [drawn(np.random.default_rng([SEED, number, chunk])) for chunk in chunks]
        seen = np.sort(np.concatenate([seen_there(points) for points in drawn_points]))
        lines.append(
            f"| {name} | {seen.size} | {seen[0]:.3f} | {seen[1]:.3f} | {np.quantile(seen, 0.01):.3f} |"
        )
        print(lines[-1], flush=True)
        counts += sum(trusted(points) for points in drawn_points)
    lines += [
        "",
        "Pieces of which the first three values say enough, if all that they leave unseen is so many times "
        "their misfit from a line, and in a long piece a share of the largest swt at least:",
        "",
        "| OF_FIRST | IN_LONG | pieces | looked at further | that hide a maximum |",
        "|---|---|---|---|---|",
    ]
    for (first, in_long), (pieces, open_, hidden) in zip(TRUSTED, counts, strict=True):
        lines.append(f"| {first:g} | {in_long:g} | {pieces:.0f} | {open_ / pieces:.1%} | {hidden:.0f} |")
    (given.results / "margins.md").write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
