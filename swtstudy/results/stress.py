"""Fields over position and time: the stress beneath the contact, swt, stick and slip.

swt, or another criterion, over the body is the field of which s is the maximum.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from swtstudy.kernel.field import contact_radii, criterion_at, instants_at, stress_at
from swtstudy.kernel.punch import COMPONENTS
from swtstudy.results.history import one_of_both
from swtstudy.results.one_point import (
    labelled_time,
    named,
    open_point,
    read_cycle,
    read_finite,
    read_instants,
    read_places,
    turns_of,
)
from swtstudy.vocabulary.choices import CRITERIA
from swtstudy.vocabulary.mistakes import refused
from swtstudy.vocabulary.quantities import flag_attributes

#: Relative accuracy of swt over the instants that are chosen for a position, and of the field of swt as its
#: series over time tell it: a thirtieth of what is said of it, since a maximum may be narrower than these.
_OF_INSTANTS, _OF_FIELD = 1e-5, 1e-3 / 30.0


def stress_field(
    x: object, y: object, z: object, *, time: object | None = None, **parameters: object
) -> xr.Dataset:
    """Stress in the half-space over one stationary cycle (eqs. 15–18).

    Parameters
    ----------
    x, y, z
        Position in a_H = √(R δ0), z ≥ 0 into the body: numbers; one-dimensional sequences, which span a
        grid; or DataArrays with their own dimensions.
    time
        ω1 t in rad: a number or a one-dimensional sequence, common to all positions. By default each position
        has its own instants, which resolve its extremes.
    **parameters
        Names of `swtstudy.vocabulary.parameters.PARAMETERS`, a single value each.

    Returns
    -------
    xarray.Dataset
        sigma_xx … sigma_xy in E* √(δ0/R), tension positive, over time and the dimensions of the positions;
        and contact_radius in a_H over time. Shear traction acts on the half-space in +x where sigma_xz < 0.
        If ``time`` is not given, the dimension is instant, in ascending order, and time and contact_radius
        vary over the positions, too; positions with fewer instants than others repeat their last one.

    Raises
    ------
    StudyError
        A ValueError with the mistakes in the positions, instants or parameters.

    Notes
    -----
    The stress at a point has square-root cusps in time, when the contact edge or a slip front passes, and a
    criterion over the cycle often has its extreme at one. By default the instants are aligned with these
    events, and dense around the extremes of stress and strain on the critical plane: `swt_of_history`
    of such a history is within 1e-5 of s at the critical point. That takes about 1 ms for each position; for
    a map at a few instants, give ``time``. At 64 even instants swt can be 23 % too low, at 512 still 10 %.
    Within 1e-6 a_H of the edge of a truncated paraboloid's face the stress, which is infinite there, is
    cut off. Nothing of a plane contact depends on y, and σ_yy follows from plane strain.

    Examples
    --------
    >>> field = stress_field(x=[-1.0, 0.0, 1.0], y=0.0, z=[0.0, 0.5], time=[0.0, 1.0])
    >>> field.sigma_xx.dims
    ('time', 'x', 'z')
    """
    points, opened = open_point(parameters)
    coordinates, own, places = read_places(x, y, z)
    taken = sorted({"time", "instant"}.intersection(map(str, own)))
    if taken:
        found = f"a dimension named {' and '.join(taken)}"
        raise refused("x, y, z", found, "other names: these belong to the instants")
    rounds, flat = turns_of(points), places.reshape(-1, 3)
    if time is None:
        every = [instants_at(opened, place, _OF_INSTANTS) for place in flat]
        count = max(angle.size for angle in every)
        angles, history = np.empty((len(flat), count)), np.empty((len(flat), count, 6))
        for k, angle in enumerate(every):
            index = np.minimum(np.arange(count), angle.size - 1)
            angles[k], history[k] = angle[index], stress_at(opened, flat[k : k + 1], angle)[0, index]
        times = np.moveaxis(rounds * angles, -1, 0).reshape(count, *places.shape[:-1])
        instants = labelled_time(points, times, ("instant", *own))
    else:
        instants = read_instants(points, time)
        history = stress_at(opened, flat, instants.values.ravel() / rounds)
    over = tuple(dim for dim in instants.dims if dim not in own)
    dims = (*over, *own)
    stress = np.moveaxis(history, -2, 0).reshape(*instants.shape[: len(over)], *places.shape[:-1], 6)
    variables = {}
    for i, name in enumerate(COMPONENTS):
        meaning = named(f"stress {name} over E* sqrt(delta0/R), tension positive", rf"\sigma_{{{name}}}")
        variables[f"sigma_{name}"] = dims, stress[..., i], meaning
    radius = contact_radii(opened, instants.values.ravel() / rounds).reshape(instants.shape)
    meaning = named("contact radius, in units of a_H = sqrt(R delta0)", "a/a_H")
    variables["contact_radius"] = (instants.dims, radius, meaning)
    return xr.Dataset(variables, {"time": instants, **coordinates})


def swt_field(x: object, y: object, z: object, **parameters: object) -> xr.Dataset:
    """swt at points of the half-space over all plane orientations (eq. 9).

    Parameters
    ----------
    x, y, z
        Position in a_H, as for `swtstudy.stress_field`.
    **parameters
        Names of `swtstudy.vocabulary.parameters.PARAMETERS`, a single value each.

    Returns
    -------
    xarray.Dataset
        s_local: swt over E* δ0/R; normal_x, normal_y, normal_z: unit normals of the critical planes.

    Notes
    -----
    Of 100 values 99 are within 1e-3 of the largest one over all instants and planes. The others are lower, by
    1 % at most where swt is above a thousandth of the largest stress squared; of smaller values, at places
    that hardly see tension, less is known. If nothing is in tension, it is 0. Nothing of a plane contact
    depends on y.
    """
    points, opened = open_point(parameters)
    coordinates, dims, places = read_places(x, y, z)
    swt, _, normal = criterion_at(opened, places.reshape(-1, 3), _OF_FIELD)
    criterion = CRITERIA[points.criterion]
    shape = places.shape[:-1]
    unit = "E* delta0/R" if criterion.degree == 2 else "E* delta0/a_H"
    words = f"{criterion.words} over {unit}"
    variables = {"s_local": (dims, swt.reshape(shape), named(words, criterion.symbol))}
    for name, values in zip("xyz", one_of_both(normal).T, strict=True):
        meaning = named("unit normal of the critical plane", f"n_{name}")
        variables[f"normal_{name}"] = (dims, values.reshape(shape), meaning)
    return xr.Dataset(variables, coordinates)


#: Instants of a cycle by default: slip fronts are seen to move, and the map is computed in milliseconds.
_INSTANTS_OF_SLIP = 64
#: States of the surface, in the order of the flag values.
STATES = ("open", "stick", "forward_slip", "backward_slip")


def slip_map(r: object, *, time: object | None = None, **parameters: object) -> xr.Dataset:
    """State of the contact at distances from its centre over one stationary cycle.

    Parameters
    ----------
    r
        Distance from the axis in a_H, a number or a one-dimensional sequence; negative at x < 0, which
        matters where a bulk stress moves the stick zone.
    time
        ω1 t in rad: a number or a one-dimensional sequence; by default 64 instants of one common period.
    **parameters
        Names of `swtstudy.vocabulary.parameters.PARAMETERS`, a single value each.

    Returns
    -------
    xarray.Dataset
        state (a flag) over time and r; slip_radius and contact_radius in a_H over time: the contact slips
        between the two. If a bulk stress moves the stick zone, the zone of this radius is about
        stick_centre, x/a_H over time, and the state is on the line y = 0. In forward slip the body under
        the indenter is dragged towards +x.

    Raises
    ------
    ValueError
        If a distance, an instant or a parameter is not allowed.
    """
    cycle = read_cycle(parameters)
    rounds = turns_of(cycle.points)
    if time is None:
        time = 2.0 * np.pi * rounds * np.arange(_INSTANTS_OF_SLIP) / _INSTANTS_OF_SLIP
    instants = read_instants(cycle.points, time)
    allowed = "a finite distance in a_H, negative at x < 0, or a sequence of them"
    radius = xr.DataArray(np.atleast_1d(read_finite("r", r, allowed)), dims="r")
    radius.attrs.update(long_name="distance from the axis, in units of a_H", units="1", symbol="r/a_H")
    states = cycle.states(instants.values.ravel() / rounds)
    # A ring under a flat face is the whole face.
    place = np.maximum(cycle.place(np.abs(radius.values)), 0.0)
    slips = np.where(states.push > 0, 2, 3)[:, None]
    touching, centre = place < states.edge_s[:, None], cycle.centre(states.front_s)
    off = np.abs(radius.values - centre[:, None]) if cycle.moved else place
    inside = off < states.front_s[:, None]
    state = np.where(inside, 1, np.where(touching, slips, 0)).astype(np.int8)
    flags = {"long_name": "state of the contact", **flag_attributes(STATES)}
    variables: dict[str, Any] = {
        "state": ((*instants.dims, "r"), state.reshape(*instants.shape, radius.size), flags)
    }
    for name, values in (("slip_radius", states.front_s), ("contact_radius", states.edge_s)):
        there = np.where(states.normal > 0.0, cycle.radius(values), 0.0).reshape(instants.shape)
        meaning = {"long_name": f"{name.replace('_', ' ')}, in units of a_H", "units": "1"}
        variables[name] = (instants.dims, there, meaning)
    if cycle.moved:
        meaning = {"long_name": "centre of the stick zone, in units of a_H", "units": "1"}
        variables["stick_centre"] = (instants.dims, centre.reshape(instants.shape), meaning)
    return xr.Dataset(variables, {"time": instants, "r": radius})
