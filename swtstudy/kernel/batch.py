"""Named arrays of points in, results out: one compiled call for each chunk of points."""

from fractions import Fraction
from functools import partial
from itertools import pairwise
from threading import local

import numpy as np

from swtstudy.kernel.body import OF_BODY
from swtstudy.kernel.circle import CIRCLE, search_circles
from swtstudy.kernel.compiled import new_record, new_records
from swtstudy.kernel.contact import CYCLE
from swtstudy.kernel.criterion import ASK, ask
from swtstudy.kernel.cycles import COUNTED, COUNTING, count_points
from swtstudy.kernel.growth import GROWTH
from swtstudy.kernel.line import SEARCH
from swtstudy.kernel.load import LOAD
from swtstudy.kernel.loads import leave_bulk_out, load_of, prescribe
from swtstudy.kernel.point import OF_POINT, RESULT, solve_points
from swtstudy.kernel.profile import PROFILE
from swtstudy.kernel.profiles import is_plane, profile_record
from swtstudy.kernel.work import CONJUGATE, MARGIN, OF_CYCLE, cycles_of, margins_of

#: Points of one compiled call: their loads and profiles take some 40 MB.
CHUNK = 64
#: Accuracy of profiles of which radii and forces are asked, as of s: they are a hundred times more accurate.
OF_PROFILE = 1e-8
_of_thread = local()


def chunks(
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
    pulled=None,
    rtol=1e-4,
    reach=0.0,
):
    """Records of n points of one profile family, one kind of load and one criterion, some at a time.

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
    pulled
        Shape (n,): strain of the body with the bulk stress over the mean of both, which shifts the stick
        zone; 0 where it is not to be shifted; 1 if None, for bodies of equal moduli. Negative in the other
        body, whose stress is without the bulk stress.
    rtol
        Relative accuracy asked of s.
    reach
        Depth or force up to which the profiles are known at least.

    Yields
    ------
    tuple
        Slice of the points, and their profiles, numbers of these, loads and asks.
    """
    if is_plane(profile):
        control = (True, True)  # depths have no meaning in the plane
    n = len(poisson_ratio)
    zero = np.zeros(n)
    angle = zero if phase is None else phase
    bulk = [zero if each is None else each for each in (bulk_amplitude, bulk_mean, bulk_phase)]
    exponent = zero + 0.5 if walker_exponent is None else walker_exponent
    sensitivity = zero if normal_sensitivity is None else normal_sensitivity
    strain = zero + 1.0 if pulled is None else pulled
    for first in range(0, n, CHUNK):
        rows = range(first, min(first + CHUNK, n))
        loads, asks = memory(LOAD)[0][: len(rows)], new_records(len(rows), ASK)
        keys = []
        for j, i in enumerate(rows):
            loop = None if loops is None else loops[i]
            ratio = Fraction(1 if frequency_ratio is None else frequency_ratio[i])
            own = normal_amplitude[i], tangential_amplitude[i], angle[i], ratio
            loads[j] = load_of(loop, *own, *(each[i] for each in bulk))
            if strain[i] < 0.0:
                leave_bulk_out(loads[j])
            own = criterion, exponent[i], sensitivity[i], strain[i]
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
        largest = dict.fromkeys(keys, reach)
        _raise_to(largest, keys, loads)
        profiles = new_records(len(largest), PROFILE)
        for k, key in enumerate(largest):
            profiles[k] = profile_record(profile, dict(key), control[1], largest[key], rtol)
        number = {key: k for k, key in enumerate(largest)}
        which = np.array([number[key] for key in keys])
        yield slice(first, first + len(rows)), profiles, which, loads, asks


def solve_batch(*points, **given):
    """Solve points.

    Parameters
    ----------
    points, given
        As of `chunks`.

    Returns
    -------
    numpy.ndarray
        Shape (n,) of `swtstudy.kernel.point.RESULT`.
    """
    return _each_chunk(_solve, RESULT, chunks(*points, **given))


def _solve(profiles, which, loads, asks, out):
    """Solve the points of a chunk: on the line, and on circles where the line may not be enough."""
    given, room = (profiles, which, loads, asks, out), memory(*OF_POINT)
    solve_points(*memory(SEARCH), room, *given)
    if out["circle"].any() and not out["overflow"].any():
        search_circles(*memory(CIRCLE), memory(*OF_BODY), room, *given)


def count_batch(x, double_angle, *points, **given):
    """Strain cycles of points.

    Parameters
    ----------
    x, double_angle
        Shape (n,): critical x, NaN where the bulk stress alone makes s, and 2θ of the critical planes in
        rad, NaN where there is none.
    points, given
        As of `chunks`.

    Returns
    -------
    list
        For each point and place the values of the criterion of its cycles over the largest one, descending.
    """
    found, (counting, search), room = [], memory(COUNTING, SEARCH), memory(*OF_POINT)
    for rows, profiles, which, loads, asks in chunks(*points, **given):
        out, first = new_records(len(which), COUNTED), np.int64(0)
        at = np.ascontiguousarray(x[rows]), np.ascontiguousarray(double_angle[rows])
        while first < len(which):
            given = profiles, which, loads, asks, *at, first, out
            done = np.int64(count_points(counting, search, room, *given))
            for row, load in zip(out[first:done], loads[first:done], strict=True):
                _refuse_overflow(row["overflow"])
                ends = row["begin"][: row["places"] + 1]
                shares = (counting["shares"][begin:end] for begin, end in pairwise(ends))
                found.append([np.repeat(-np.sort(-each), load["rounds"]) for each in shares])
            first = done
    return found


def cycle_batch(with_ratio, *points, **given):
    """Work, radii and, where asked, the largest force ratio of the cycles of points.

    Parameters
    ----------
    with_ratio
        Whether the force ratio is asked.
    points, given
        As of `chunks`.

    Returns
    -------
    numpy.ndarray
        Shape (n,) of `swtstudy.kernel.work.OF_CYCLE`.
    """
    solve = partial(cycles_of, *memory(CYCLE, GROWTH, CONJUGATE), np.bool_(with_ratio))
    return _each_chunk(solve, OF_CYCLE, chunks(*points, **given, rtol=OF_PROFILE, reach=1.0))


def margins_batch(*points, **given):
    """Margins of points: how far they are from where the model ends, as far as the load alone gives it.

    Parameters
    ----------
    points, given
        As of `chunks`.

    Returns
    -------
    numpy.ndarray
        Shape (n,) of `swtstudy.kernel.work.MARGIN`.
    """
    records = chunks(*points, **given, rtol=OF_PROFILE)
    return _each_chunk(partial(margins_of, *memory(CYCLE)), MARGIN, records)


def _each_chunk(solve, kind, records):
    """Results of all chunks: records of a kind. The function writes them into its last argument."""
    parts = [new_records(0, kind)]
    for _, profiles, which, loads, asks in records:
        parts.append(new_records(len(which), kind))
        solve(profiles, which, loads, asks, parts[-1])
        _refuse_overflow("overflow" in kind.names and parts[-1]["overflow"].any())
    return np.concatenate(parts).view(np.recarray)


def _refuse_overflow(overflow):
    """Raise if a load cycle has more pieces than there is room for."""
    if overflow:
        raise ArithmeticError("the load cycle has more pieces than the solver has room for")


def _raise_to(largest, keys, loads):
    """Raise the largest normal load of each profile to the largest of its loads."""
    for key, load in zip(keys, loads, strict=True):
        largest[key] = max(largest[key], float(load["normal_range"][1]))


def memory(*kinds):
    """Records of this thread, one of each kind, or the room for the loads of a chunk; made once."""
    own = _of_thread.__dict__
    for kind in kinds:
        if id(kind) not in own:
            own[id(kind)] = new_records(CHUNK, kind) if kind is LOAD else new_record(kind)
    return tuple(own[id(kind)] for kind in kinds)
