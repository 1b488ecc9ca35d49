"""Named arrays of points in, results out: one compiled call for each chunk of points."""

from fractions import Fraction
from threading import local

import numpy as np

from swtstudy.kernel.compiled import new_records
from swtstudy.kernel.line import ASK, ask
from swtstudy.kernel.load import LOAD
from swtstudy.kernel.loads import bimodal, polygon
from swtstudy.kernel.point import RESULT, solve_points, workspace
from swtstudy.kernel.profile import PROFILE
from swtstudy.kernel.profiles import profile_record

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
    in_force=False,
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
        Shape (n,): δ_A/δ0 and G*u_A/(μE*δ0), or F_A/F_0 and Q_A/(μF_0); rad. None under loops.
    frequency_ratio
        n fractions ω2/ω1.
    loops
        n pairs of arrays: normal and tangential load at the vertices; or three, with the bulk stress.
    shape
        Arrays of shape (n,) by name.
    in_force
        Whether forces are prescribed; else displacements.
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
    n = len(poisson_ratio)
    out = new_records(n, RESULT)
    zero = np.zeros(n)
    bulk = [zero if each is None else each for each in (bulk_amplitude, bulk_mean, bulk_phase)]
    exponent = zero + 0.5 if walker_exponent is None else walker_exponent
    sensitivity = zero if normal_sensitivity is None else normal_sensitivity
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
                own = normal_amplitude[i], ratio, tangential_amplitude[i], phase[i]
                loads[j] = bimodal(*own, *(each[i] for each in bulk))
                largest = 1.0 + normal_amplitude[i]
            own = criterion, exponent[i], sensitivity[i]
            asks[j] = ask(poisson_ratio[i], friction[i], rtol, *own)
            key = tuple((key, float(values[i])) for key, values in (shape or {}).items())
            which[j], before = needed.get(key, (len(needed), 0.0))
            needed[key] = which[j], max(before, largest)
        profiles = new_records(len(needed), PROFILE)
        for key, (k, largest) in needed.items():
            profiles[k] = profile_record(profile, dict(key), in_force, largest, rtol)
        solve_points(*_workspace(), profiles, which, loads, asks, out[first : first + len(rows)])
    return out


def _workspace():
    """The memory of this thread."""
    if not hasattr(_of_thread, "workspace"):
        _of_thread.workspace = workspace()
    return _of_thread.workspace
