"""The least value of an objective in the unit cube: a search of all, then a polish of the best points."""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import numpy as np

from swtstudy.mechanics.points import FloatArray
from swtstudy.results.optimum.objective import Objective
from swtstudy.results.optimum.polish import polish
from swtstudy.results.optimum.search import search
from swtstudy.vocabulary.mistakes import Mistake, StudyError

#: So many points of the search begin to be polished, this far apart in the unit cube: minima may be nearly
#: equal, and the search has stopped at differences of 1 %. With 3 one minimum of 20 random ones was missed.
_POLISHED, _APART = 8, 0.1
#: After so many batches the worse half of them is given up: four rounds show which one leads where.
_TRIAL = 8


@dataclass(frozen=True)
class Least:
    """The least value of an objective, and how it was found.

    Attributes
    ----------
    unit
        Shape (d,): where it is, in the unit cube.
    searched
        Value of the quantity there before the polish.
    progress
        Its value after each generation of the search; infinite before there was a finite one.
    converged
        Whether the population of the search has converged.
    evaluations
        Number of points evaluated.
    """

    unit: FloatArray
    searched: float
    progress: FloatArray
    converged: bool
    evaluations: int


def least(objective: Objective, dimensions: int, seed: int) -> Least:
    """The least value of an objective.

    Raises
    ------
    StudyError
        If it has no finite value anywhere.
    """
    found = search(objective, dimensions, seed)
    searched = float(objective.values.min())
    if not np.isfinite(searched):
        words = f"no finite value at any of {len(objective.values)} points"
        raise StudyError([Mistake("over", words, "ranges in which the quantity is finite somewhere")])
    _polish_together(objective, seed)
    unit = objective.points[objective.values.argmin()]
    sign = objective.sign
    return Least(unit, sign * searched, sign * found.progress, found.converged, len(objective.values))


def _polish_together(objective: Objective, seed: int) -> None:
    """Polish the best points; what all of them ask for next is one batch, in which a point costs less."""
    begin = _starts(objective)
    polishes = [polish(objective.points[row], float(objective.values[row]), seed) for row in begin]
    lowest = dict(zip(polishes, objective.values[begin].tolist(), strict=True))
    asked = {each: next(each) for each in polishes}
    for batch in itertools.count(1):
        values = objective(np.concatenate(list(asked.values())))
        ends = np.cumsum([len(points) for points in asked.values()])
        for each, part in zip(list(asked), np.split(values, ends[:-1]), strict=True):
            lowest[each] = min(lowest[each], *part)
            try:
                asked[each] = each.send(part)
            except StopIteration:
                del asked[each]
        if not asked:
            return
        if batch % _TRIAL == 0:
            leading = sorted(asked, key=lambda each: lowest[each])[: -(-len(asked) // 2)]
            asked = {each: asked[each] for each in leading}


def _starts(objective: Objective) -> list[int]:
    """Rows of the best points evaluated so far that are apart from better ones."""
    starts: list[int] = []
    for row in objective.values.argsort(kind="stable").tolist():
        away = [np.abs(objective.points[row] - objective.points[other]).max() for other in starts]
        if len(starts) < _POLISHED and np.isfinite(objective.values[row]) and min(away, default=1.0) > _APART:
            starts.append(row)
    return starts
