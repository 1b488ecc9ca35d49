"""Chunks of points: how points are cut into them, and the values of one as plain arrays."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from swtstudy.points.canonical import COST, SHARED_COLUMNS, Distinct, alike, points_from
from swtstudy.solver import points as mechanics
from swtstudy.solver.points import Points, Solution
from swtstudy.vocabulary.arrays import BoolArray, IndexArray
from swtstudy.vocabulary.choices import REGIMES, WITHOUT_S
from swtstudy.vocabulary.quantities import DISTANCE, NOTHING, YIELD, Request
from swtstudy.vocabulary.variables import COMPUTED, FAILED, MISSING, SOLVED
from swtstudy.vocabulary.version import SOLVER_VERSION

#: Arrays of shape (n, …) by name.
Arrays = dict[str, NDArray[Any]]
#: Solves points to a relative accuracy; None for `swtstudy.solver.points.solve_points`.
Solver = Callable[[Points, float], Solution] | None

#: Pieces of the load cycles of a chunk, all together, and what a point counts at least where means over the
#: body are asked: some 0.1 s of work, short enough to lose.
PIECES, PIECES_OF_BODY = 128, 16


@dataclass(frozen=True)
class Chunk:
    """Points that are solved in one call: of one profile family, criterion, control and loop.

    Attributes
    ----------
    places
        Shape (n,): where the points are in the table of the run.
    points
        The points' parameters.
    asked
        The quantities beside s; distances in a_H.
    """

    places: IndexArray
    points: Points
    asked: Request

    def singly(self) -> Iterator[Chunk]:
        """Each of its points alone."""
        for k in range(len(self.places)):
            yield Chunk(self.places[[k]], self.points[[k]], self.asked)


def cut(points: Distinct, wanted: BoolArray, asked: Request = NOTHING) -> list[IndexArray]:
    """Places of the wanted points of a table, cut into chunks, long cycles first.

    So no worker waits for another's.

    Parameters
    ----------
    points
        The points of the study.
    wanted
        Shape (len(points.rows),): the points to be solved.
    asked
        The quantities beside s.
    """
    places = np.flatnonzero(wanted)
    pieces = points.rows["p"] + points.rows["q"] + points.rows[COST]
    if {YIELD, DISTANCE} & {*asked.items}:
        pieces = np.maximum(pieces, PIECES_OF_BODY)
    found: list[IndexArray] = []
    shared = points.rows[[*SHARED_COLUMNS]]  # a view, whose rows are copied in full
    for own in alike(shared if wanted.all() else shared[places], *points.distances[places].T):
        own = places[own]
        own = own[np.argsort(-pieces[own], kind="stable")]
        number = (np.cumsum(pieces[own]) - 1) // PIECES
        found += np.split(own, np.flatnonzero(np.diff(number)) + 1)
    return sorted(found, key=lambda each: -int(pieces[each[0]]))


def chunk_of(points: Distinct, places: IndexArray, asked: Request = NOTHING) -> Chunk:
    """The chunk of some points of a table, which have the same critical distances."""
    own = replace(asked, distances=tuple(points.distances[places[0]].tolist()))
    return Chunk(places, points_from(points.rows[places], points.definitions), own)


def chunks(points: Distinct, wanted: BoolArray, asked: Request = NOTHING) -> Iterator[Chunk]:
    """Chunks of the wanted points of a table; see `cut`."""
    return (chunk_of(points, places, asked) for places in cut(points, wanted, asked))


def solve_chunk(chunk: Chunk, rtol: float, solver: Solver = None) -> tuple[str, Arrays]:
    """Solve a chunk, in a worker.

    Returns
    -------
    str
        Version of the solver.
    dict
        Values of the points, in order. A point that fails does so alone, with its message and what it has.
    """
    begin, arrays = time.perf_counter(), blank(len(chunk.places), FAILED)
    try:
        fill(arrays, chunk, rtol, solver)
    except Exception as error:
        if len(chunk.places) > 1:
            return SOLVER_VERSION, stacked([solve_chunk(one, rtol, solver)[1] for one in chunk.singly()])
        arrays["message"][:] = f"{type(error).__name__}: {error}"
    arrays["seconds"][:] = (time.perf_counter() - begin) / len(chunk.places)
    return SOLVER_VERSION, arrays


def fill(arrays: Arrays, chunk: Chunk, rtol: float, solver: Solver = None) -> None:
    """Solve the points of a chunk, and find what else is asked of them; raises if one has no value."""
    points, asked = chunk.points, chunk.asked
    # The caller's np.seterr is not meant for the solver, in which NaN and inf are values.
    with np.errstate(all="ignore"):
        solution = (solver or mechanics.solve_points)(points, rtol)
        arrays.update(solution._asdict())
        lost = ~np.isin(solution.regime, [REGIMES.index(name) for name in WITHOUT_S]) & np.isnan(solution.s)
        if lost.any():
            raise ArithmeticError("the solver found no value")
        if asked.items:
            from swtstudy.solver.quantities import quantities_of

            arrays.update(quantities_of(points, asked, solution))
        if asked.distances:
            arrays["distance"] = np.tile(asked.distances, (len(chunk.places), 1))
    arrays["status"][:] = COMPUTED


def blank(n: int, status: int = MISSING, message: str = "") -> Arrays:
    """Arrays of n points without values, all in one state."""
    return {name: np.full(n, np.nan) for name in SOLVED} | {
        "regime": np.full(n, REGIMES.index("not_finite"), np.int8),
        "status": np.full(n, status, np.int8),
        "run": np.full(n, -1, np.int32),
        "message": np.full(n, message, object),
        "seconds": np.zeros(n),
    }


def stacked(parts: Sequence[Arrays]) -> Arrays:
    """Arrays one after another; NaN where one lacks a name, or is narrower than the widest."""

    def padded(part: Arrays, name: str, tail: Any) -> NDArray[Any]:
        values = part.get(name, np.full((len(part["status"]), *tail), np.nan))
        more = [(0, most - size) for most, size in zip(tail, values.shape[1:], strict=True)]
        return np.pad(values, [(0, 0), *more], constant_values=np.nan) if any(map(max, more)) else values

    found = {}
    for name in dict.fromkeys(name for part in parts for name in part):
        tail = np.max([part[name].shape[1:] for part in parts if name in part], axis=0).astype(int)
        found[name] = np.concatenate([padded(part, name, tail) for part in parts])
    return found


def put(arrays: Arrays, index: IndexArray, some: Arrays) -> None:
    """Write values of some points in their places."""
    for name, values in some.items():
        if name not in arrays:
            arrays[name] = np.full((len(arrays["status"]), *values.shape[1:]), np.nan)
        arrays[name][index] = values
