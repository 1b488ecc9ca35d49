"""swt, or another criterion, over the body: the field of which s is the maximum."""

from __future__ import annotations

import numpy as np
import xarray as xr

from swtstudy.fields.one_point import read_scene
from swtstudy.fields.places import as_given, read_places
from swtstudy.mechanics.body.body import Body, time_nodes
from swtstudy.mechanics.stress.field.kernels import kernels_of

#: Cells of the field.
_CELLS = 60
#: Steps on each stretch between two events.
_STEPS = 4
#: Distances from the axis whose points are computed together, at the instants of all of them.
_RADII = 12


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
    At each point the instants are aligned with the events at its distance from the axis: otherwise swt on the
    surface would be up to 20 % low, in rings. Between the events there are few instants: where an extreme
    over the cycle is smooth, mostly beneath the surface, swt can still be 10 % low. `swt_of_history` of the
    default history of `stress_field` is exact, but slower. Few distinct distances (a grid in polar
    coordinates) are computed faster. Nothing of a plane contact depends on y.
    """
    scene = read_scene(parameters)
    places = read_places(x, y, z)
    flat = np.stack([place.values.ravel() for place in places])
    away = kernels_of(scene.profile).distance(flat[0], flat[1])
    distance, group = np.unique(np.round(away, 12), return_inverse=True)
    swt, normal = np.empty(flat.shape[1]), np.empty((flat.shape[1], 3))
    for first in range(0, distance.size, _RADII):
        some = (group >= first) & (group < first + _RADII)
        nodes = time_nodes(scene, _STEPS, distance[first : first + _RADII])
        swt[some], normal[some] = Body(scene, nodes, _CELLS).swt(*flat[:, some])
    dims, shape = places[0].dims, places[0].shape
    unit = "E* delta0/R" if scene.criterion.degree == 2 else "E* delta0/a_H"
    words = f"{scene.criterion.words.replace('–', '-')} over {unit}"
    meaning = {"long_name": words, "units": "1", "symbol": scene.criterion.symbol}
    variables = {"s_local": (dims, swt.reshape(shape), meaning)}
    for axis, name in enumerate("xyz"):
        meaning = {"long_name": "unit normal of the critical plane", "units": "1", "symbol": f"n_{name}"}
        variables[f"normal_{name}"] = (dims, normal[:, axis].reshape(shape), meaning)
    return xr.Dataset(variables, as_given(places, x, y, z))
