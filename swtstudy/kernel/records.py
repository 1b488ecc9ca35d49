"""The records that one point is solved in, bundled: a function takes what it needs from the bundle.

A record is a NumPy structure of fixed size, which a thread makes once and each point writes anew. The module
that writes a record defines its fields.
"""

from typing import NamedTuple

import numpy as np


class Point(NamedTuple):
    """The records of one point, in the order in which they are written.

    Attributes
    ----------
    load
        `swtstudy.kernel.load.LOAD`: the load cycle.
    profile
        `swtstudy.kernel.profile.PROFILE`: the profile as series over the place s.
    ask
        `swtstudy.kernel.criterion.ASK`: Poisson's ratio, friction, criterion and tolerances.
    cycle
        `swtstudy.kernel.contact.CYCLE`: the stationary cycle in the memory diagram.
    growth
        `swtstudy.kernel.growth.GROWTH`: the pieces that grew, on the radius.
    table
        `swtstudy.kernel.surface.TABLE`: running integrals of profile and growth at a place of the line.
    history
        `swtstudy.kernel.history.HISTORY`: the stress cycle at a place.
    curves
        `swtstudy.kernel.planes.CURVES`: its curves over time on planes through y, and their maxima.
    """

    load: np.record
    profile: np.record
    ask: np.record
    cycle: np.record
    growth: np.record
    table: np.record
    history: np.record
    curves: np.record


class Body(NamedTuple):
    """The records for places of the body.

    Attributes
    ----------
    here
        `swtstudy.kernel.body.HERE`: the stress cycle at a place of the body.
    below
        `swtstudy.kernel.beneath.BELOW`: running integrals over the springs at this place.
    planes
        `swtstudy.kernel.all_planes.PLANES`: the search over planes of every orientation.
    point
        The records of the point.
    """

    here: np.record
    below: np.record
    planes: np.record
    point: Point
