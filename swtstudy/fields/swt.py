"""swt over the body: the field of which s is the maximum."""

from __future__ import annotations

import numpy as np
import xarray as xr

from swtstudy.fields.one_point import read_scene
from swtstudy.fields.places import as_given, read_places
from swtstudy.mechanics.body import Body, time_nodes

_CELLS = 60
#: Steps on each stretch of the cycle, and radii whose events are among the instants.
_STEPS, _RADII = 6, 8


def swt_field(x: object, y: object, z: object, **parameters: object) -> xr.Dataset:
    """swt at points of the half-space over all plane orientations (eq. 9).

    Parameters
    ----------
    x, y, z
        Position in a_H, as for `swtstudy.stress_field`.
    **parameters
        Names of `swtstudy.parameters.PARAMETERS`, a single value each.

    Returns
    -------
    xarray.Dataset
        swt over E* δ0/R, and the unit normals normal_x, normal_y, normal_z of the critical planes. Good for
        maps: where a contact edge or a slip front passes, swt is up to about 1 % low.
    """
    scene = read_scene(parameters)
    places = read_places(x, y, z)
    flat = [place.values.ravel() for place in places]
    radii = np.quantile(np.hypot(flat[0], flat[1]), np.linspace(0.0, 1.0, _RADII))
    body = Body.of(scene, time_nodes(scene, _STEPS, np.unique(radii)), _CELLS)
    found = body.swt(*flat)
    dims, shape = places[0].dims, places[0].shape
    meaning = {"long_name": "Smith-Watson-Topper parameter over E* delta0/R", "units": "1", "symbol": "swt"}
    variables = {"swt": (dims, found.swt.reshape(shape), meaning)}
    for axis, name in enumerate("xyz"):
        meaning = {"long_name": "unit normal of the critical plane", "units": "1", "symbol": f"n_{name}"}
        variables[f"normal_{name}"] = (dims, found.normal[..., axis].reshape(shape), meaning)
    return xr.Dataset(variables, as_given(places, x, y, z))
