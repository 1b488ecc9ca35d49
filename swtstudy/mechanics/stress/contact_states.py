"""The states of one contact cycle on cells of radii: the memory diagram as input of the superposition."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from swtstudy.mechanics.contact.cycle import Cycle
from swtstudy.mechanics.contact.memory import GROWTH, Memory
from swtstudy.mechanics.contact.slip_front import SlipStates
from swtstudy.mechanics.control.coordinate import Coordinate
from swtstudy.mechanics.indenter.base import Profile
from swtstudy.mechanics.numerics.arrays import between
from swtstudy.mechanics.points import BoolArray, FloatArray, IndexArray, IntArray
from swtstudy.mechanics.stress.superposition import (
    Kernels,
    SlopeCells,
    graded_radii,
    kernels_of,
    slope_cells,
    stress_history,
)

#: Breakpoints nearer than this, relative to the contact radius, are one: about two roundings. A hundredth:
#: 4e-15 in 16 values of bodies; a hundred times: 5e-16.
SAME_RADIUS = 4e-16
#: Cells for edges anywhere shrink towards a flat face like this power. 2: 2e-3 of a mean of swt beside a face
#: with 16 cells; 6: 5e-5.
FACE_POWER = 6
#: How often cells are halved towards a circle: to some 1e-7 of the radius, where a jump within a cell is as
#: little. None: 3e-3 of swt at cusps that nearly meet.
HALVINGS = 24


@dataclass(frozen=True)
class ContactStates:
    """Contact states at T instants, see `superposition.stress_history`.

    Attributes
    ----------
    cells
        The slope functions on m cells whose ends hold every contact edge, slip front and end of a piece.
    touching
        Shape (T, m).
    tangential_slope
        Shape (T, k, m).
    kernels
        What is superposed.
    """

    cells: SlopeCells
    touching: FloatArray
    tangential_slope: FloatArray
    kernels: Kernels

    def stress(
        self, x: ArrayLike, y: ArrayLike, z: ArrayLike, friction: float, poisson_ratio: float
    ) -> FloatArray:
        """Stress at points of shape S, shape S + (T, 6); see `superposition.stress_history`."""
        own = self.cells, self.touching, self.tangential_slope
        return stress_history(x, y, z, *own, friction, poisson_ratio, self.kernels)


def contact_states(
    cycle: Cycle, coordinate: Coordinate, interval: IndexArray, instant: FloatArray, cells: int
) -> ContactStates:
    """Contact states of one point at instants of its stationary cycle.

    Parameters
    ----------
    cycle, coordinate
        A batch of one cycle and the coordinate of its memory diagram.
    interval, instant
        Shape (T,): numbers of intervals of the cycle and instants φ within them.
    cells
        Number of cells for a profile that is not a paraboloid, and for each growth, besides those that
        the breakpoints make. With 200 the stress in the interior is accurate to 1e-8 p0.
    """
    memory = cycle.memory.take((np.zeros_like(interval), interval))
    states = cycle.states(interval[None], instant[None])
    radius = _cell_ends(coordinate, _breakpoints(cycle, memory, states, cells), cells)
    at = coordinate.of(0.5 * (radius[1:] + radius[:-1])[None])[0]
    touching = at < states.edge[0, :, None]
    branches = np.unique(memory.branch[_grown(memory)])
    shares = _shares(memory, states, at, branches) * touching[:, None]
    cells_of = _slopes(cycle, coordinate, radius, branches)
    return ContactStates(cells_of, touching.astype(float), shares, kernels_of(coordinate.profile))


def resolving_cells(
    cycle: Cycle, coordinate: Coordinate, cells: int, circle: float | None = None
) -> tuple[SlopeCells, IntArray]:
    """Cells whose ends hold every end of a piece of one cycle's memory, but no edges and fronts.

    Parameters
    ----------
    cycle, coordinate, cells
        As for `contact_states`.
    circle
        Radius near which the stress is wanted, in a_H: cells are halved towards it.

    Returns
    -------
    cells, branches
        The profile's slope function, and one for each of the load's branches on which ground was gained.
    """
    memory = cycle.memory.take((0,))
    starts = np.unique(np.where(np.isfinite(memory.start), memory.start, 0.0))
    places = [starts, np.maximum(cycle.load.largest_normal, 0.0), *_growth_ends(memory, cells)]
    radius = _cell_ends(coordinate, np.concatenate(places), cells)
    # An edge may lie in the first cell behind a flat face, where a root is no straight line.
    b = float(coordinate.profile.flat_radius[0])
    if b > 0.0:
        closer = b + (radius[-1] - b) * np.linspace(0.0, 1.0, cells, endpoint=False)[1:] ** FACE_POWER
        radius = np.unique(np.concatenate([radius, closer]))
    if circle is not None and radius[0] < circle < radius[-1]:
        # An edge or a front that passes there jumps within a cell: its stress counts the more, the nearer.
        share = 0.5 ** np.arange(1, HALVINGS)[:, None]
        radius = np.union1d(radius, np.append(circle + (radius[[0, -1]] - circle) * share, circle))
    branches = np.unique(memory.branch[_grown(memory)])
    return _slopes(cycle, coordinate, radius, branches), branches


def _slopes(cycle: Cycle, coordinate: Coordinate, radius: FloatArray, branches: IntArray) -> SlopeCells:
    """The profile's slope on cells with such ends, and those of growth on the branches."""

    def weighted_slopes(ξ: FloatArray) -> FloatArray:
        at, m = coordinate.with_weighted_slope(ξ[None])
        slopes = [cycle.load.growth_slope(at, np.asarray(b)) for b in branches]
        return np.stack([m[0], *(m[0] * slope[0] for slope in slopes)])

    return slope_cells(weighted_slopes, radius, start=float(coordinate.profile.flat_radius[0]))


def _grown(memory: Memory) -> BoolArray:
    return (memory.slope == GROWTH) & np.isfinite(memory.start)


def _breakpoints(cycle: Cycle, memory: Memory, states: SlipStates, cells: int) -> FloatArray:
    """Coordinates at which a slope dτ/dG jumps at some instant, and those that resolve growths."""
    starts = np.where(memory.start < states.front[0, :, None], memory.start, 0.0)
    # The deepest contact of the cycle is there for instants without any contact.
    places = [states.edge.ravel(), states.front.ravel(), np.unique(starts), cycle.load.largest_normal]
    for finer in _growth_ends(memory, cells):
        places.append(finer[finer < max(float(values.max()) for values in places)])
    return np.concatenate(places)


def _growth_ends(memory: Memory, cells: int) -> list[FloatArray]:
    """Coordinates that resolve the growths, if there are any."""
    grown = _grown(memory)
    if not np.any(grown):
        return []
    begin, end = np.unique(np.stack([memory.start[grown], memory.stop[grown]]), axis=1)
    angle = np.pi * np.arange(cells + 1) / cells
    return [between(begin[:, None], end[:, None], angle).ravel()]


def _shares(memory: Memory, states: SlipStates, at: FloatArray, branches: IntArray) -> FloatArray:
    """Share of each slope function in dτ/dG at the coordinates ``at``, (m,): shape (T, 1 + branches, m)."""
    slips = at > states.front[0, :, None]
    piece = np.maximum((memory.start[:, None, :] <= at[:, None]).sum(axis=-1) - 1, 0)
    slope, branch = (np.take_along_axis(values, piece, axis=1) for values in (memory.slope, memory.branch))
    grows = ~slips & (slope == GROWTH)
    # τ′ = −o′: the slopes of the memory diagram change their sign.
    line = np.where(slips, -states.sign[0, :, None], np.where(slope == GROWTH, 0.0, -slope))
    return np.stack([line, *(grows & (branch == b) for b in branches)], axis=1).astype(float)


def _cell_ends(coordinate: Coordinate, breaks: FloatArray, cells: int) -> FloatArray:
    """Radii of the breakpoints, and those that resolve the profile's slope."""
    profile = coordinate.profile
    radius = np.maximum(coordinate.radius(breaks[None])[0], profile.flat_radius[0])
    ends = np.sort(np.concatenate([radius, _resolving_radii(profile, float(radius.max()), cells)]))
    return ends[np.diff(ends, prepend=-1.0) > SAME_RADIUS * ends[-1]]


def _resolving_radii(profile: Profile, end: float, cells: int) -> FloatArray:
    """Cells for the slope alone: one where it is straight, graded ones behind a flat face."""
    b = float(profile.flat_radius[0])
    if b > 0.0:
        return graded_radii(b, end, cells)
    if not profile.evenly_smooth:
        return _adapted_radii(profile, end, cells)
    count = 1
    while True:
        radius = np.linspace(0.0, end, count + 1)
        middle = 0.5 * (radius[1:] + radius[:-1])
        chord = np.diff(profile.slope_integral(radius[None])[0]) * count / end
        bend = np.abs(profile.weighted_slope(middle[None])[0] / middle - chord).max()
        if bend < chord.max() / cells**2 or count > 8 * cells:
            return radius
        count *= 2


def _adapted_radii(profile: Profile, end: float, cells: int) -> FloatArray:
    """Cells that are halved where the slope is bent; of narrow ones less is asked."""
    radius = np.linspace(0.0, end, 5)
    while True:
        width, middle = np.diff(radius), 0.5 * (radius[1:] + radius[:-1])
        chord = np.diff(profile.slope_integral(radius[None])[0]) / width
        bend = np.abs(profile.weighted_slope(middle[None])[0] / middle - chord)
        bend *= np.sqrt(np.minimum(width * (cells / end), 1.0))
        bent = bend > chord.max() / (2 * cells) ** 2
        if not bent.any() or len(radius) > 8 * cells:
            return radius
        radius = np.sort(np.append(radius, middle[bent]))
