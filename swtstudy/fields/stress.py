"""The stress beneath the contact over position and time."""

from __future__ import annotations

import numpy as np
import xarray as xr

from swtstudy.fields.one_point import read_scene
from swtstudy.fields.places import as_given, read_places, read_time
from swtstudy.mechanics.body.body import Body
from swtstudy.mechanics.stress.field.punch import COMPONENTS

#: Cells that give the stress to 1e-8 p0 at depths, in a_H, of more than so much: more towards the surface.
_CELLS = ((0.03, 200), (0.001, 800), (-np.inf, 2400))


def stress_field(
    x: object, y: object, z: object, *, time: object | None = None, **parameters: object
) -> xr.Dataset:
    """Stress in the half-space over one stationary cycle (eqs. 15–18).

    Parameters
    ----------
    x, y, z
        Position in a_H = √(R δ0), z ≥ 0 into the body: numbers; one-dimensional sequences, which span a
        grid; or DataArrays with dimensions of their own.
    time
        ω1 t in rad: a number or a one-dimensional sequence; by default 64 instants of one common period.
    **parameters
        Names of `swtstudy.parameters.PARAMETERS`, a single value each.

    Returns
    -------
    xarray.Dataset
        sigma_xx … sigma_xy in E* √(δ0/R), tension positive, over time and the dimensions of the positions;
        and contact_radius in a_H over time. Shear traction acts on the half-space in +x where sigma_xz < 0.

    Examples
    --------
    >>> field = stress_field(x=[-1.0, 0.0, 1.0], y=0.0, z=[0.0, 0.5], time=[0.0, 1.0])
    >>> field.sigma_xx.dims
    ('time', 'x', 'z')
    """
    scene = read_scene(parameters)
    places = read_places(x, y, z)
    instants, nodes = read_time(scene, time)
    least_depth = float(places[2].min())
    cells = next(count for depth, count in _CELLS if least_depth > depth)
    history = Body.of(scene, nodes, cells).stress(*(place.values for place in places))
    dims = (*instants.dims, *places[0].dims)
    stress = np.moveaxis(history, -2, 0).reshape(*instants.shape, *places[0].shape, 6)
    variables = {
        f"sigma_{name}": (dims, stress[..., i], _attributes(name)) for i, name in enumerate(COMPONENTS)
    }
    depth = np.maximum(scene.cycle.load.normal(nodes.instant[None]), 0.0)
    radius = np.where(depth > 0.0, scene.coordinate.radius(depth), 0.0).reshape(instants.shape)
    meaning = {
        "long_name": "contact radius, in units of a_H = sqrt(R delta0)",
        "units": "1",
        "symbol": "a/a_H",
    }
    variables["contact_radius"] = (instants.dims, radius, meaning)
    return xr.Dataset(variables, {"time": instants, **as_given(places, x, y, z)})


def _attributes(name: str) -> dict[str, str]:
    return {
        "long_name": f"stress {name} over E* sqrt(delta0/R), tension positive",
        "units": "1",
        "symbol": rf"\sigma_{{{name}}}",
    }
