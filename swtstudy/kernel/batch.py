"""Named arrays of points in, results out: one compiled call for each chunk of points."""

from fractions import Fraction
from functools import partial
from threading import local

import numpy as np

from swtstudy.kernel import profile
from swtstudy.kernel.compiled import new_records, once
from swtstudy.kernel.line import ASK, ask
from swtstudy.kernel.load import LOAD, bimodal, polygon
from swtstudy.kernel.point import RESULT, solve_points, workspace
from swtstudy.kernel.profile import PROFILE

#: Points of one compiled call: their loads and profiles take some 10 MB.
CHUNK = 64
#: No coordinate at which the profile is asked lies beyond its table by rounding.
MARGIN = 1e-9
#: The last coefficients of a profile's series are at most this share of rtol: what they leave out is less.
PROFILE_SHARE = 0.01
_of_thread = local()


def profile_record(name, shape, in_force, largest, rtol):
    """Profile as data.

    Parameters
    ----------
    name
        paraboloid, rounded_punch, truncated_paraboloid or wavy_paraboloid.
    shape
        flat_radius; or waviness_amplitude h/δ0 and wavelength λ/√(hR).
    in_force
        Whether the memory diagram lives in the normal force.
    largest
        Largest depth in δ0, or normal force in F_0.
    rtol
        Relative accuracy asked of s.
    """
    largest = largest * (1.0 + MARGIN)
    tolerance = PROFILE_SHARE * rtol
    tabulate = partial(profile.tabulate_profile, largest=largest, in_force=in_force, tolerance=tolerance)
    if name in ("rounded_punch", "truncated_paraboloid") and shape["flat_radius"] > 0.0:
        b = shape["flat_radius"]
        return tabulate(partial(getattr(profile, name), b=b), b)
    if name == "wavy_paraboloid" and shape["waviness_amplitude"] > 0.0:
        amplitude = shape["waviness_amplitude"]
        wavelength = shape["wavelength"] * np.sqrt(amplitude)
        density = partial(profile.wavy_paraboloid, amplitude=amplitude, wavelength=wavelength)
        longest = min(0.5, 0.5 * wavelength)
        return tabulate(density, 0.0, longest=longest)
    return tabulate(profile.paraboloid, 0.0, is_paraboloid=True)


def solve_batch(
    name,
    poisson_ratio,
    friction,
    normal_amplitude=None,
    tangential_amplitude=None,
    frequency_ratio=None,
    phase=None,
    loops=None,
    shape=None,
    in_force=False,
    rtol=1e-4,
):
    """Solve n points of one profile family and one kind of load.

    Parameters
    ----------
    name
        Name of the profile.
    poisson_ratio, friction
        Shape (n,).
    normal_amplitude, tangential_amplitude, phase
        Shape (n,): δ_A/δ0 and G*u_A/(μE*δ0), or F_A/F_0 and Q_A/(μF_0); rad. None under loops.
    frequency_ratio
        n fractions ω2/ω1.
    loops
        n pairs of arrays: normal and tangential load at the vertices.
    shape
        Arrays of shape (n,) by name.
    in_force
        Whether forces are prescribed; else displacements.
    rtol
        Relative accuracy asked of s.

    Returns
    -------
    numpy.ndarray
        Shape (n,) of `swtstudy.kernel.point.RESULT`.
    """
    warm_up()
    n = len(poisson_ratio)
    out = new_records(n, RESULT)
    for first in range(0, n, CHUNK):
        rows = range(first, min(first + CHUNK, n))
        loads, asks, which = (
            new_records(len(rows), LOAD),
            new_records(len(rows), ASK),
            np.zeros(len(rows), np.int64),
        )
        needed = {}
        for j, i in enumerate(rows):
            if loops is not None:
                loads[j], largest = polygon(*loops[i]), float(np.max(loops[i][0]))
            else:
                ratio = Fraction(frequency_ratio[i])
                loads[j] = bimodal(normal_amplitude[i], ratio, tangential_amplitude[i], phase[i])
                largest = 1.0 + normal_amplitude[i]
            asks[j] = ask(poisson_ratio[i], friction[i], rtol)
            key = tuple((key, float(values[i])) for key, values in (shape or {}).items())
            which[j], before = needed.get(key, (len(needed), 0.0))
            needed[key] = which[j], max(before, largest)
        profiles = new_records(len(needed), PROFILE)
        for key, (k, largest) in needed.items():
            profiles[k] = profile_record(name, dict(key), in_force, largest, rtol)
        solve_points(*_workspace(), profiles, which, loads, asks, out[first : first + len(rows)])
    return out


@once
def warm_up():
    """Compile what one point of each kind of load needs, or load it."""
    solve_batch("paraboloid", [0.3], [0.5], [0.25], [0.25], [1], [0.0], rtol=1e-2)
    vertices = np.array([0.8, 1.2, 1.0]), np.array([0.0, 0.1, -0.1])
    solve_batch("paraboloid", [0.3], [0.5], loops=[vertices], rtol=1e-2)


def _workspace():
    """The memory of this thread."""
    if not hasattr(_of_thread, "workspace"):
        _of_thread.workspace = workspace()
    return _of_thread.workspace
