"""A scene holds all that the stress depends on: contact, indenter, Poisson ratio and friction."""

from __future__ import annotations

from dataclasses import dataclass, replace

from swtstudy.mechanics.contact.cycle import Cycle, solve_cycle
from swtstudy.mechanics.control.coordinate import Coordinate
from swtstudy.mechanics.control.diagram import diagram
from swtstudy.mechanics.events.stretches import split_at, split_at_breakpoints
from swtstudy.mechanics.indenter.base import Profile
from swtstudy.mechanics.load.bimodal import load_of
from swtstudy.mechanics.planes.criterion import SWT, Criterion, criterion_of
from swtstudy.mechanics.points import FloatArray, Points, Rows
from swtstudy.mechanics.stress.bulk import BulkStress, bulk_of


@dataclass(frozen=True)
class Scene(Rows):
    """n points: what the stress on the surface line depends on.

    Attributes
    ----------
    cycle
        n contact cycles.
    coordinate
        The coordinate of their memory diagrams, which knows the n profiles.
    poisson_ratio, friction
        Shape (n,).
    criterion
        Shape (n,): of which the largest value is looked for.
    bulk
        n bulk stresses, at whose turning instants the cycles are cut, see `carrying`; None without.
    """

    cycle: Cycle
    coordinate: Coordinate
    poisson_ratio: FloatArray
    friction: FloatArray
    criterion: Criterion = SWT
    bulk: BulkStress | None = None

    def __len__(self) -> int:
        return len(self.friction)

    @property
    def profile(self) -> Profile:
        """The n profiles."""
        return self.coordinate.profile

    def with_own(self, points: Points) -> Scene:
        """The same with the criterion and the bulk stresses of its n points."""
        return replace(self, criterion=criterion_of(points)).carrying(bulk_of(points))

    def carrying(self, bulk: BulkStress | None) -> Scene:
        """The same with bulk stresses."""
        if bulk is None or not bulk.moves.any():
            return replace(self, bulk=bulk)
        return replace(self, bulk=bulk, cycle=split_at(self.cycle, bulk.turning_instants()))

    def add_bulk(self, stress: FloatArray, instant: FloatArray) -> None:
        """Add the bulk stress of a batch of one point to stresses (…, 6) at instants (…), in place."""
        if self.bulk is None:
            return
        bulk = self.bulk.at(instant[None])[0]
        stress[..., 0] += bulk
        if self.profile.plane:
            stress[..., 1] += float(self.poisson_ratio[0]) * bulk

    def split_at_breakpoints(self) -> Scene:
        """The same with the intervals of its cycles cut where a slip front passes a breakpoint."""
        return replace(self, cycle=split_at_breakpoints(self.cycle))

    @property
    def largest_radius(self) -> FloatArray:
        """Largest contact radius of each point in a_H, shape (n,)."""
        return self.coordinate.radius(self.cycle.load.largest_normal[:, None])[:, 0]

    @property
    def mirrored_half(self) -> bool:
        """True if half a period later the stress is the same at −x."""
        return self.cycle.load.mirrored_half and (self.bulk is None or not bool(self.bulk.moves.any()))


def scene_of(points: Points) -> Scene:
    """The scenes of points whose loads are alike, each with a contact solution of its own."""
    in_diagram, coordinate = diagram(points.control, points.profile, points.shape, load_of(points))
    own = points.poisson_ratio, points.friction
    return Scene(solve_cycle(in_diagram), coordinate, *own).with_own(points)
