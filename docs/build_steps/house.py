"""The rooms of the package as a picture: boxes from the ground up, and an arrow for what each imports.

An import that a longer way of arrows says already is left out; so are those of the ground floor, on which all
rooms stand. A room is one floor above the highest one that it imports.
"""

from __future__ import annotations

from collections import defaultdict
from itertools import combinations, pairwise
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import FancyBboxPatch

from build_steps.rooms import House

Graph = dict[str, set[str]]
#: A room; or where an arrow passes a floor: the two rooms that it joins, and the floor.
Place = str | tuple[str, str, int]

_WALL, _FLOOR, _GROUND, _ARROW = "#1f4e79", "#dbe7f3", "#efd9a8", "#555555"
#: Width of a place and height of a floor in inches, and the share of either that a box takes.
_WIDTH, _HEIGHT, _BOX, _LINE = 1.5, 0.72, (0.8, 0.56), 0.3
_LETTERS = 12
_ROUNDS = 60
#: How much a step of an arrow pulls its ends together that joins no, one or two places between floors.
_PULLS = 1, 2, 8


def draw_house(house: House, path: Path) -> None:
    """Draw the house into a file, in the format of its ending."""
    floors, lines = plan(drawn_imports(house))
    places = _abscissae(floors, lines)
    low, high = min(places.values()) - 0.5, max(places.values()) + 0.5
    figure = Figure(figsize=(_WIDTH * (high - low), _HEIGHT * (len(floors) + 1)))
    axes = figure.add_axes((0, 0, 1, 1), xlim=(low, high), ylim=(-1.5, len(floors) - 0.5))
    axes.set_axis_off()
    _box(axes, 0.5 * (low + high), -1.0, ", ".join(house.ground), _GROUND, high - low - 0.2)
    for level, floor in enumerate(floors):
        for place in floor:
            if isinstance(place, str):
                name = house.name.rpartition(".")[2] if place == "__init__" else place
                _box(axes, places[place], level, name, _FLOOR, _BOX[0])
    level_of = {place: level for level, floor in enumerate(floors) for place in floor}
    for line in lines:
        _arrow(axes, [(places[place], level_of[place]) for place in line])
    figure.savefig(path)


def drawn_imports(house: House) -> Graph:
    """The rooms above the ground, and of what each imports that which no longer way leads to."""
    graph: Graph = {room: set() for room in house.above}
    for own, other in house.imports():
        mine, its = house.room_of(own), house.room_of(other)
        if mine != its and mine in graph and its in graph:
            graph[mine].add(its)
    below: Graph = {}
    for room in house.above:  # what is imported comes first
        below[room] = graph[room].union(*(below[other] for other in graph[room]))
    return {
        room: {other for other in others if not any(other in below[near] for near in others)}
        for room, others in graph.items()
    }


def plan(graph: Graph) -> tuple[list[list[Place]], list[list[Place]]]:
    """The places of each floor from left to right, and those that each arrow goes through from above."""
    level: dict[str, int] = {}
    for room, others in graph.items():
        level[room] = 1 + max((level[other] for other in others), default=-1)
    floors: list[list[Place]] = [[] for _ in range(max(level.values()) + 1)]
    for room in graph:
        floors[level[room]].append(room)
    lines: list[list[Place]] = []
    for room, others in graph.items():
        for other in sorted(others):
            passed: list[Place] = [(room, other, at) for at in range(level[room] - 1, level[other], -1)]
            for place, at in zip(passed, range(level[room] - 1, level[other], -1), strict=True):
                floors[at].append(place)
            lines.append([room, *passed, other])
    return _ordered(floors, lines), lines


def _ordered(floors: list[list[Place]], lines: list[list[Place]]) -> list[list[Place]]:
    """The floors with their places in an order in which few arrows cross."""
    above, below = _neighbours(lines)
    best = floors
    for turn in range(_ROUNDS):
        neighbours = below if turn % 2 == 0 else above
        at = {place: index / max(len(floor) - 1, 1) for floor in floors for index, place in enumerate(floor)}
        for floor in floors if neighbours is below else floors[::-1]:
            mean = {place: _mean([at[other] for other in neighbours[place]], at[place]) for place in floor}
            floor_now = sorted(floor, key=mean.__getitem__)
            at |= {place: index / max(len(floor) - 1, 1) for index, place in enumerate(floor_now)}
        floors = [sorted(floor, key=at.__getitem__) for floor in floors]
        if _crossings(floors, lines) < _crossings(best, lines):
            best = floors
    return best


def _abscissae(floors: list[list[Place]], lines: list[list[Place]]) -> dict[Place, float]:
    """Where the places are, in widths of a box: near to what they are joined with, side by side."""
    joined: dict[Place, list[Place]] = defaultdict(list)
    for upper, lower in (step for line in lines for step in pairwise(line)):
        # What is counted several times pulls more: a line past several floors is to be straight.
        pull = _PULLS[sum(not isinstance(place, str) for place in (upper, lower))]
        joined[upper] += [lower] * pull
        joined[lower] += [upper] * pull
    at = {place: index - 0.5 * (len(floor) - 1) for floor in floors for index, place in enumerate(floor)}
    for _ in range(_ROUNDS):
        for floor in floors:
            wish = [_mean([at[other] for other in joined[place]], at[place]) for place in floor]
            gaps = [0.5 * (_width(left) + _width(right)) for left, right in pairwise(floor)]
            pushed_right, pushed_left = list(wish), list(wish)
            for i, gap in enumerate(gaps):
                pushed_right[i + 1] = max(wish[i + 1], pushed_right[i] + gap)
            for i, gap in reversed(list(enumerate(gaps))):
                pushed_left[i] = min(wish[i], pushed_left[i + 1] - gap)
            for place, right, left in zip(floor, pushed_right, pushed_left, strict=True):
                at[place] = 0.5 * (right + left)
    return at


def _neighbours(lines: list[list[Place]]) -> tuple[dict[Place, list[Place]], dict[Place, list[Place]]]:
    """What is joined with each place on the floor above, and on the floor below."""
    above: dict[Place, list[Place]] = defaultdict(list)
    below: dict[Place, list[Place]] = defaultdict(list)
    for line in lines:
        for upper, lower in pairwise(line):
            above[lower].append(upper)
            below[upper].append(lower)
    return above, below


def _crossings(floors: list[list[Place]], lines: list[list[Place]]) -> int:
    """How many pairs of arrows cross between two floors."""
    at = {place: (level, index) for level, floor in enumerate(floors) for index, place in enumerate(floor)}
    steps = [(at[upper], at[lower]) for line in lines for upper, lower in pairwise(line)]
    return sum(
        one[0][0] == other[0][0] and (one[0][1] - other[0][1]) * (one[1][1] - other[1][1]) < 0
        for one, other in combinations(steps, 2)
    )


def _mean(values: list[float], otherwise: float) -> float:
    return sum(values) / len(values) if values else otherwise


def _width(place: Place) -> float:
    return 1.0 if isinstance(place, str) else _LINE


def _box(axes: Axes, x: float, y: float, words: str, colour: str, width: float) -> None:
    corner = x - 0.5 * width, y - 0.5 * _BOX[1]
    style = "round,pad=0,rounding_size=0.06"
    axes.add_patch(FancyBboxPatch(corner, width, _BOX[1], style, facecolor=colour, edgecolor=_WALL, zorder=2))
    axes.text(x, y, words, ha="center", va="center_baseline", fontsize=_LETTERS, zorder=3)


def _arrow(axes: Axes, line: list[tuple[float, float]]) -> None:
    """From below the first box to above the last one, straight down past the floors between."""
    half = 0.5 * _BOX[1]
    (first, top), *passed, (last, bottom) = line
    corners = [(x, y + side) for x, y in passed for side in (half, -half)]
    corners = [(first, top - half), *corners, (last, bottom + half)]
    axes.plot(*zip(*corners, strict=True), color=_ARROW, linewidth=1.2, zorder=1)
    axes.annotate(
        "",
        corners[-1],
        corners[-2],
        arrowprops={"arrowstyle": "-|>", "color": _ARROW, "shrinkA": 0, "shrinkB": 0, "mutation_scale": 12},
        zorder=1,
    )
