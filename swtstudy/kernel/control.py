"""Mixed control: the normal load in the coordinate of the tangential one.

The memory diagram lives in the kind of the tangential load. A depth prescribed with a tangential force
becomes the normal force N(δ), a normal force prescribed with a tangential displacement the depth G(N):
increasing functions of the profile, through the place s of the edge.
"""

import numpy as np

from swtstudy.kernel.chebyshev import gauss_legendre, panel_of
from swtstudy.kernel.compiled import jit
from swtstudy.kernel.load import BY_POWER, BY_SERIES, MAP_ORDER, MAX_MAP, UNMAPPED, mapped
from swtstudy.kernel.profile import density_at, force_at, place_of

#: Panels of the map are halved, so many times at most, until its last coefficients are this share of the
#: largest one, or this much: rounding of the place at small loads.
TOLERANCE, ROUNDING, HALVINGS = 1e-12, 1e-13, 6
#: The map is a power law below this share of the first panel of the profile.
POWER_LAW = 1e-6
NODE, WEIGHT = gauss_legendre(12)
_NODES = -np.cos(np.pi * np.arange(MAP_ORDER) / (MAP_ORDER - 1))
_SERIES = np.linalg.inv(np.polynomial.chebyshev.chebvander(_NODES, MAP_ORDER - 1))


def prescribe(load, control, profile):
    """Note what of a load is prescribed, and map its normal load where both kinds are mixed.

    Parameters
    ----------
    load
        Record whose normal load is the prescribed one.
    control
        Whether the normal and the tangential load are forces; else displacements.
    profile
        Record in the kind of the normal load, up to its largest value; used where the kinds are mixed.
    """
    normal_force, tangential_force = control
    load["normal_force"], load["tangential_force"], load["map"] = normal_force, tangential_force, UNMAPPED
    if normal_force == tangential_force:
        return
    low, high = load["normal_range"]
    if load["sides"] and low < high:
        raise ValueError(
            "a loop whose normal load is not constant needs two displacements or two forces: "
            "with one of each its straight sides are curved in the memory diagram"
        )
    n = profile["exponent"]
    if n > 0.0:  # G = ξⁿ
        load["map"], load["map_power"] = BY_POWER, (n + 1.0) / n if tangential_force else n / (n + 1.0)
        load["waves"] = 0.0
    else:
        _tabulate(load, profile)
    load["normal_range"] = [mapped(load, float(each))[0] for each in (low, high)]
    if load["sides"]:
        load["vertex"][0, : load["sides"] + 1] = load["normal_range"][0]
        load["map"] = UNMAPPED


def _tabulate(load, profile):
    """Write the map as series on the panels of the profile, halved towards 0 and where it needs them."""
    largest = float(load["normal_range"][1])
    edges = profile["coordinate_begin"][: profile["panels"] + 1].copy()
    edges = np.append(edges[edges < largest], largest * (1.0 + 1e-9))
    first = POWER_LAW * edges[1]
    towards = first * 2.0 ** np.arange(0, np.log2(1.0 / POWER_LAW))
    edges = np.concatenate([towards, edges[1:]])
    lower, upper, done = edges[:-1], edges[1:], []
    for halved in range(HALVINGS + 1):
        x = lower[:, None] + 0.5 * (upper - lower)[:, None] * (_NODES + 1.0)
        series = _other_coordinate(profile, x) @ _SERIES.T
        size = np.abs(series)
        rough = size[:, -2:].max(axis=1) > TOLERANCE * size.max(axis=1) + ROUNDING
        rough &= halved < HALVINGS
        done.append((lower[~rough], upper[~rough], series[~rough]))
        middle = (0.5 * (lower + upper))[rough]
        lower, upper = np.concatenate([lower[rough], middle]), np.concatenate([middle, upper[rough]])
    begin, end, series = (np.concatenate(part) for part in zip(*done, strict=True))
    order = np.argsort(begin)
    count = len(order)
    if count + 1 >= MAX_MAP:
        raise ValueError(f"the map of the normal load needs {count} panels, more than {MAX_MAP - 2}")
    load["map"], load["map_panels"] = BY_SERIES, count + 1
    load["map_begin"][1 : count + 1], load["map_begin"][count + 1] = begin[order], end[order[-1]]
    load["map_series"][1 : count + 1] = series[order]
    x = first * np.array([[1.0, 1.001]])
    y = _other_coordinate(profile, x)[0]
    load["map_series"][0, 0] = y[0]
    load["map_power"] = np.log(y[1] / y[0]) / np.log(1.001)
    reach = float(profile["end"][profile["panels"] - 1])
    load["waves"] = max(reach / profile["longest"] - reach / 0.5, 0.0)


@jit
def _write_other(profile, places, out):
    """Write force at depths, or depth at forces, of a profile; ∫ dG/ds ds by Gauss's rule on each panel."""
    before, unit = np.zeros(profile.panels + 1), force_at(profile, place_of(profile, 1.0))
    for p in range(profile.panels if profile.in_force else 0):
        before[p + 1] = before[p] + rise(profile, profile.begin[p], profile.end[p])
    for i in range(places.shape[0]):
        s = place_of(profile, places[i])
        p = panel_of(profile.begin, 0, profile.panels, s)
        if profile.in_force:
            out[i] = before[p] + rise(profile, profile.begin[p], s)
        else:
            out[i] = force_at(profile, s) / unit


def _other_coordinate(profile, x):
    """Force at depths, or depth at forces, as the profile's coordinate is; array of any shape."""
    found = np.empty(x.size)
    _write_other(profile, x.ravel(), found)
    return found.reshape(x.shape)


@jit
def rise(profile, a, b):
    """∫ dG/ds ds from a to b within a panel."""
    total = 0.0
    for i in range(NODE.shape[0]):
        total += WEIGHT[i] * density_at(profile, a + 0.5 * (b - a) * (NODE[i] + 1.0))
    return 0.5 * (b - a) * total
