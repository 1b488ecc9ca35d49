"""Which of two bodies a value of s belongs to, and what it is worth there."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike

from swtstudy.units.at_rest import Moduli
from swtstudy.units.labels import wrong_size
from swtstudy.units.life import ROUNDS, UNCOUNTED, FatigueConstants, ShearConstants, not_negative
from swtstudy.vocabulary.arrays import FloatArray, IndexArray
from swtstudy.vocabulary.mistakes import Mistake, Report, StudyError, literal, plain_number
from swtstudy.vocabulary.quantities import COUNTED

if TYPE_CHECKING:
    import xarray as xr

    #: Values with names for their dimensions keep them.
    Values = FloatArray | xr.DataArray

#: Constants of one kind.
_Kind = TypeVar("_Kind", FatigueConstants, ShearConstants)

#: Labels of the bodies along the dimension ``body``.
LABELS = (1, 2)

#: Attributes of SWT.
SWT_ATTRIBUTES = {
    "long_name": "Smith-Watson-Topper parameter of the body",
    "units": "unit of stress of the moduli",
    "symbol": r"\mathrm{SWT}",
}
_CYCLES = {"long_name": "rounds to the initiation of a crack", "units": "1", "symbol": "N"}


def checked_body(body: object, key: str = "body", names: Sequence[str] = ()) -> int:
    """The label of a body, from that or from one of the names that the bodies may have.

    Raises
    ------
    StudyError
        If it is neither.
    """
    number = names.index(body) + 1 if isinstance(body, str) and body in names else plain_number(body)
    if number not in LABELS:
        raise StudyError([Mistake(key, literal(body), labels_or(names))])
    return int(number)


def labels_or(names: Sequence[str]) -> str:
    """The labels and names that a body may be called by, in words."""
    return " or ".join((*map(str, LABELS), *map(literal, names)))


def swt_from(s: ArrayLike | xr.DataArray, scale: Any, moduli: Moduli, bodies: IndexArray) -> Values:
    """SWT of the bodies from s, with the SWT scale of the half-space with E*: a number, or a DataArray."""
    import xarray as xr

    shares = np.array([moduli.swt_share(0), moduli.swt_share(1)])[bodies]
    with np.errstate(over="ignore"):  # inf is an SWT that nothing lives with
        swt = _labelled("SWT", not_negative("s", s) * shares, s, SWT_ATTRIBUTES) * scale
    if isinstance(s, xr.DataArray) and np.ndim(scale):
        return swt.transpose(*s.dims, ...).rename("SWT").assign_attrs(SWT_ATTRIBUTES)
    return swt


def bodies_of(s: ArrayLike | xr.DataArray, alike: bool, body: object) -> IndexArray:
    """The index of the body of each value, 0 or 1, broadcastable to the shape of the values.

    Raises
    ------
    StudyError
        If `body` and the coordinate ``body`` name it both, or neither and the bodies are not `alike`.
    """
    import xarray as xr

    if isinstance(s, xr.DataArray) and "body" in s.coords:
        if body is not None:
            raise StudyError([Mistake("body", literal(body), "nothing, since s has the coordinate body")])
        if not np.isin(s.body, LABELS).all():
            found = f"the coordinate {literal(s.body.values.tolist())}"
            raise StudyError([Mistake("body", found, "1 and 2")])
        return (s.body == LABELS[1]).broadcast_like(s).transpose(*s.dims).values.astype(np.intp)
    if body is not None:
        return np.array(checked_body(body) - 1)
    if alike:
        return np.array(0)
    allowed = "1 or 2, since the bodies differ; or s over the dimension body, as solve() gives it"
    raise StudyError([Mistake("body", "nothing", allowed)])


def cycles_from(
    both: tuple[FatigueConstants, FatigueConstants],
    swt: Values,
    bodies: IndexArray,
    counted: xr.Dataset | None,
) -> Values:
    """Rounds to a crack of each value with the constants of its body, see `FatigueConstants.rounds`."""
    if counted is None:
        one, two = (each.cycles(np.asarray(swt)) for each in both)
    else:
        one, two = (np.asarray(each.rounds(swt, *(counted[name] for name in COUNTED))) for each in both)
    cycles = np.where(bodies == 1, two, one)
    words = _CYCLES | {"comment": UNCOUNTED if counted is None else ROUNDS}
    return _labelled("cycles", cycles, swt, words)


def constants_of_both(constants: object) -> tuple[FatigueConstants, FatigueConstants]:
    """The constants of each body.

    Raises
    ------
    StudyError
        If they are neither those of both bodies nor a pair.
    """
    report = Report()
    both = _of_both("constants", constants, FatigueConstants, report)
    report.refuse()
    return both[0], both[1]


def shear_constants_of_both(constants: object, report: Report) -> tuple[ShearConstants, ...]:
    """The constants of each body in torsion, none if none are given; what is wrong with them is added."""
    return () if constants is None else _of_both("shear_constants", constants, ShearConstants, report)


def _of_both(name: str, constants: object, kind: type[_Kind], report: Report) -> tuple[_Kind, ...]:
    """Constants of each body of those of both, or of a pair."""
    pair: Any = (constants, constants) if isinstance(constants, kind) else constants
    if isinstance(pair, list | tuple) and len(pair) == 2 and all(isinstance(one, kind) for one in pair):
        return pair[0], pair[1]
    allowed = f"a {kind.__name__}, or a pair of them for bodies of different materials"
    report(name, literal(constants), allowed)
    return ()


def _labelled(
    name: str, values: FloatArray, like: ArrayLike | xr.DataArray, attributes: dict[str, str]
) -> Values:
    """The values with the dimensions and coordinates of others, if those have any."""
    import xarray as xr

    if not isinstance(like, xr.DataArray):
        return values
    return xr.DataArray(values, like.coords, like.dims, name, attributes)


def stresses_of_both(name: str, stress: object, report: Report) -> tuple[float, ...]:
    """A property of both bodies that is a stress, none if not given; what is wrong with it is added."""
    if stress is None:
        return ()
    pair: Any = (stress, stress) if np.ndim(stress) == 0 else tuple(stress)  # type: ignore[arg-type]
    wrong = [each for value in pair for each in wrong_size(name, value, "a positive stress")]
    if len(pair) != 2:
        wrong = [Mistake(name, literal(stress), "one, or a pair, one for each body")]
    report += dict.fromkeys(wrong)
    return () if wrong else (plain_number(pair[0]), plain_number(pair[1]))
