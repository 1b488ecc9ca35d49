"""Constants of the material among what a study samples: draws for lives, which need no further points."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from swtstudy.points.reading import LONGEST_AXIS
from swtstudy.study.design import DESIGNS, Design, read_distribution
from swtstudy.units.life import SCATTERED, Scatter
from swtstudy.vocabulary.mistakes import Report, is_seed, is_whole, literal, plain_number
from swtstudy.vocabulary.parameter import Parameter

if TYPE_CHECKING:
    from swtstudy.units.grid import ContactDetails
    from swtstudy.vocabulary.arrays import FloatArray

#: Largest strength and ductility, and most negative exponent, that a range may have.
_LARGEST, _STEEPEST = 1e12, -10.0
#: What of `[sample]` is of constants alone.
_OWN = ("covariance", "target_life")
_MATRIX = "a table of variances and covariances, such as strength = { strength = 900, ductility = -0.5 }"


def without_scatter(raw: Mapping[str, Any]) -> dict[str, Any]:
    """The tables of a study whose sample has no constants; without a sample where nothing else is sampled."""
    sample = raw.get("sample")
    if not isinstance(sample, dict) or not _is_scatter(sample):
        return dict(raw)
    kept = {name: value for name, value in sample.items() if name not in _OWN}
    for form in ("ranges", "points"):
        if isinstance(kept.get(form), dict):
            kept[form] = {name: value for name, value in kept[form].items() if name not in SCATTERED}
            if not kept[form]:
                kept.pop(form)
    if "ranges" not in kept:
        kept = {name: value for name, value in kept.items() if name not in ("design", "size", "seed")}
    others = {name: value for name, value in raw.items() if name != "sample"}
    return {**others, "sample": kept} if kept else others


def _is_scatter(sample: Mapping[str, Any]) -> bool:
    """Return whether a sample has constants."""
    given = [sample.get(form) for form in ("ranges", "points")]
    names = {name for each in given if isinstance(each, dict) for name in each}
    return bool({*_OWN} & sample.keys() or {*SCATTERED} & names)


def read_scatter(raw: Mapping[str, Any], contacts: ContactDetails | None, report: Report) -> Scatter | None:
    """Draws of the constants in a study's sample; None if it has none, or mistakes, which are reported.

    Parameters
    ----------
    raw
        The tables of the study.
    contacts
        Its contacts, with the constants.
    report
        Called with key, found and allowed of each mistake.
    """
    sample = raw.get("sample")
    if not isinstance(sample, dict) or not _is_scatter(sample):
        return None
    if contacts is None or not contacts.materials:
        if not any(mistake.key.startswith("material") for mistake in report):
            report("sample", "constants that scatter", "with the constants of lives in [material]")
        return None
    before = len(report)
    target = sample.get("target_life", 0.0)
    if not 0.0 <= plain_number(target) < np.inf:
        report("sample.target_life", literal(target), "a number of load cycles, greater than 0")
    points = sample.get("points")
    drawn = {name: points[name] for name in SCATTERED if name in points} if isinstance(points, dict) else {}
    found = _given(drawn, report) if drawn else _designed(sample, contacts, report)
    for name, column in found.items():
        one, other = (getattr(constants, name) for constants in contacts.materials)
        if one != other:
            report(f"sample.{name}", f"{name} of {one:g} and {other:g}", "one value for both bodies")
        wrong = int((column * (-1.0 if name.endswith("exponent") else 1.0) <= 0.0).sum())
        if wrong:
            allowed = "less scatter, or a distribution that is cut off"
            report(f"sample.{name}", f"{wrong} of {len(column)} draws with the wrong sign", allowed)
    if len(report) > before or not found:
        return None
    names = tuple(name for name in SCATTERED if name in found)
    draws = tuple(tuple(float(f"{value:.6g}") for value in found[name]) for name in names)
    return Scatter(names, draws, plain_number(target))


def _given(drawn: Mapping[str, Any], report: Report) -> dict[str, FloatArray]:
    """Draws that a user gives."""
    columns = {name: np.array([plain_number(value) for value in each]) for name, each in drawn.items()}
    if len({len(column) for column in columns.values()}) > 1 or not all(map(np.size, columns.values())):
        report("sample.points", "draws of different length", "as many values of each constant")
        return {}
    wrong = [name for name, column in columns.items() if not np.isfinite(column).all()]
    for name in wrong:
        report(f"sample.points.{name}", "a value that is no number", "numbers")
    return {} if wrong else columns


def _designed(sample: Mapping[str, Any], contacts: ContactDetails, report: Report) -> dict[str, FloatArray]:
    """Draws from ranges, and from a covariance about the constants."""
    ranges, covariance = (sample.get(key, {}) for key in ("ranges", "covariance"))
    ranges = {n: each for n, each in ranges.items() if n in SCATTERED} if isinstance(ranges, dict) else {}
    correlated, factor = _factor(covariance, ranges, report)
    names = [*ranges, *correlated]
    name, size, seed = (sample.get(key) for key in ("design", "size", "seed"))
    seed = 0 if seed is None else seed
    if name not in DESIGNS or name == "saltelli" or not is_whole(size, 1, LONGEST_AXIS) or not is_seed(seed):
        words = f"design {literal(name)}, size {literal(size)} and seed {literal(seed)}"
        report("sample", words, "a design other than saltelli, a size and a seed, for draws of constants")
        return {}
    if not names:
        return {}
    unit = Design(name, size, seed).points(len(names))
    found: dict[str, FloatArray] = {}
    for name, column in zip(ranges, unit.T, strict=False):
        exponent = name.endswith("exponent")
        low, high = (_STEEPEST, 0.0) if exponent else (0.0, _LARGEST)
        row = Parameter(name, name, "", name, lower=low, upper=high, open_lower=not exponent)
        distribution = read_distribution(row, ranges[name], f"sample.ranges.{name}", report)
        if distribution is not None:
            found[name] = distribution.values(column)
    if correlated:
        from scipy.special import ndtri

        about = np.array([getattr(contacts.materials[0], name) for name in correlated])
        normal = ndtri(np.clip(unit[:, len(ranges) :], 1e-12, 1.0 - 1e-12))
        found |= dict(zip(correlated, (about + normal @ factor.T).T, strict=True))
    return found


def _factor(covariance: Any, ranges: Mapping[str, Any], report: Report) -> tuple[list[str], FloatArray]:
    """Names of the constants of a covariance, and its root, shape (k, k)."""
    nothing: tuple[list[str], FloatArray] = ([], np.empty((0, 0)))
    rows = covariance if isinstance(covariance, dict) else {}
    sound = isinstance(covariance, dict) and all(isinstance(row, dict) for row in rows.values())
    names = list(dict.fromkeys([*rows, *(name for row in rows.values() if sound for name in row)]))
    if not sound or not {*names} <= {*SCATTERED}:
        report("sample.covariance", literal(covariance), f"{_MATRIX}, of {', '.join(SCATTERED)}")
        return nothing
    for name in (each for each in names if each in ranges):
        report(f"sample.covariance.{name}", f"{name}, which has a range", "one of the two")
    matrix = np.array([[rows.get(one, {}).get(two, np.nan) for two in names] for one in names], float)
    matrix = np.where(np.isnan(matrix), matrix.T, matrix)  # either half is enough
    matrix = np.where(np.isnan(matrix), 0.0, matrix).reshape(len(names), len(names))
    values, vectors = np.linalg.eigh(matrix)
    scale = np.abs(matrix).max(initial=0.0)
    if not np.allclose(matrix, matrix.T) or (values < -1e-9 * scale).any() or (np.diag(matrix) <= 0.0).any():
        report("sample.covariance", literal(covariance), f"{_MATRIX}, symmetric and positive")
        return nothing
    return names, vectors * np.sqrt(np.clip(values, 0.0, None))
