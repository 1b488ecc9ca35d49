"""Named arrays of points in, results out: one compiled call for each chunk of points."""

from fractions import Fraction
from threading import local

import numpy as np

from swtstudy.kernel.compiled import new_records
from swtstudy.kernel.control import prescribe
from swtstudy.kernel.line import ASK, ask
from swtstudy.kernel.load import LOAD
from swtstudy.kernel.loads import load_of
from swtstudy.kernel.point import RESULT, solve_points, workspace
from swtstudy.kernel.profile import PROFILE
from swtstudy.kernel.profiles import is_plane, profile_record

#: Points of one compiled call: their loads and profiles take some 10 MB.
CHUNK = 64
_of_thread = local()


def solve_batch(
    profile,
    poisson_ratio,
    friction,
    normal_amplitude=None,
    tangential_amplitude=None,
    frequency_ratio=None,
    phase=None,
    loops=None,
    shape=None,
    control=(False, False),
    bulk_amplitude=None,
    bulk_mean=None,
    bulk_phase=None,
    criterion="swt",
    walker_exponent=None,
    normal_sensitivity=None,
    rtol=1e-4,
):
    """Solve n points of one profile family, one kind of load and one criterion.

    Parameters
    ----------
    profile
        Name of a profile, or a table of one.
    poisson_ratio, friction
        Shape (n,).
    normal_amplitude, tangential_amplitude, phase
        Shape (n,): δ_A/δ0 and G*u_A/(μE*δ0), or F_A/F_0 and Q_A/(μF_0); rad. Phases are 0 if None.
    frequency_ratio
        n fractions ω2/ω1; 1 if None.
    loops
        n loops of the package, or None for two sines.
    shape
        Arrays of shape (n,) by name.
    control
        Whether the normal and the tangential load are forces; else displacements.
    bulk_amplitude, bulk_mean, bulk_phase
        Shape (n,): bulk stress in E* δ0/a_H, and its phase against the tangential load in rad; 0 if None.
    criterion
        swt, fatemi_socie or findley.
    walker_exponent, normal_sensitivity
        Shape (n,); 1/2 and 0 if None.
    rtol
        Relative accuracy asked of s.

    Returns
    -------
    numpy.ndarray
        Shape (n,) of `swtstudy.kernel.point.RESULT`.
    """
    if is_plane(profile):
        control = (True, True)  # depths have no meaning in the plane
    n = len(poisson_ratio)
    out = new_records(n, RESULT)
    zero = np.zeros(n)
    angle = zero if phase is None else phase
    bulk = [zero if each is None else each for each in (bulk_amplitude, bulk_mean, bulk_phase)]
    exponent = zero + 0.5 if walker_exponent is None else walker_exponent
    sensitivity = zero if normal_sensitivity is None else normal_sensitivity
    for first in range(0, n, CHUNK):
        rows = range(first, min(first + CHUNK, n))
        loads, asks = _loads()[: len(rows)], new_records(len(rows), ASK)
        keys = []
        for j, i in enumerate(rows):
            loop = None if loops is None else loops[i]
            ratio = Fraction(1 if frequency_ratio is None else frequency_ratio[i])
            own = normal_amplitude[i], tangential_amplitude[i], angle[i], ratio
            loads[j] = load_of(loop, *own, *(each[i] for each in bulk))
            own = criterion, exponent[i], sensitivity[i]
            asks[j] = ask(poisson_ratio[i], friction[i], rtol, *own)
            keys.append(tuple((key, float(values[i])) for key, values in (shape or {}).items()))
        largest = dict.fromkeys(keys, 1.0)
        given = dict.fromkeys(keys)
        if control[0] != control[1]:
            _raise_to(largest, keys, loads)
            given = {
                key: profile_record(profile, dict(key), control[0], largest[key], rtol) for key in largest
            }
        for j, key in enumerate(keys):
            prescribe(loads[j], control, given[key])
        largest = dict.fromkeys(keys, 0.0)
        _raise_to(largest, keys, loads)
        profiles = new_records(len(largest), PROFILE)
        for k, key in enumerate(largest):
            profiles[k] = profile_record(profile, dict(key), control[1], largest[key], rtol)
        number = {key: k for k, key in enumerate(largest)}
        which = np.array([number[key] for key in keys])
        solve_points(*_workspace(), profiles, which, loads, asks, out[first : first + len(rows)])
    return out


def _raise_to(largest, keys, loads):
    """Raise the largest normal load of each profile to those of its loads."""
    for key, load in zip(keys, loads, strict=True):
        largest[key] = max(largest[key], float(load["normal_range"][1]))


def _loads():
    """Room of this thread for the loads of a chunk."""
    if not hasattr(_of_thread, "loads"):
        _of_thread.loads = new_records(CHUNK, LOAD)
    return _of_thread.loads


def _workspace():
    """The memory of this thread."""
    if not hasattr(_of_thread, "workspace"):
        _of_thread.workspace = workspace()
    return _of_thread.workspace
