"""Section 4.1: where the critical point lies, how the critical plane is turned, and how contacts slip.

That the point lies on the surface and at y = 0 is tested on an audit, since the archives hold maxima over
that line only.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import xarray as xr

from swtstudy.archive.recall import grid_of
from swtstudy.paper.audit import VERDICTS
from swtstudy.paper.statements import Measured
from swtstudy.points.grid import alike, canonical_points, points_from
from swtstudy.solver.margins import margins_of
from swtstudy.vocabulary.arrays import FloatArray
from swtstudy.vocabulary.choices import REGIMES


def joined(archives: tuple[xr.Dataset, ...], values: Callable[[xr.Dataset], xr.DataArray]) -> FloatArray:
    """Values of every archive, one after another."""
    return np.concatenate([values(archive).values.ravel() for archive in archives])


def partial_slip(*archives: xr.Dataset, at_least: float) -> Measured:
    """Shares of the regimes."""
    regime = joined(archives, lambda archive: archive.regime)
    shares = {name: (regime == code).mean() for code, name in enumerate(REGIMES)}
    words = ", ".join(f"{name.replace('_', ' ')} {share:.1%}" for name, share in shares.items() if share)
    return shares["partial_slip"] >= at_least, {"points": len(regime), "shares": words}


def on_the_line(audit: xr.Dataset, at_least: float) -> Measured:
    """Share of the points whose maximum over the body and all planes is on the surface line."""
    audit = audit.isel(sample=np.isfinite(audit.excess.values))
    verdicts = np.array(VERDICTS)[audit.verdict.values]
    off_line = {"beneath": "surface", "oblique": "plane_through_y", "off": "symmetry_line"}
    left = np.isin(verdicts, [*off_line.values()])
    share, worst = 1.0 - left.mean(), ""
    if left.any():
        excess, ν = audit.excess.values[left].max(), audit.poisson_ratio.values[left].min()
        worst = f", with swt up to {excess:.1%} higher, for ν ≥ {ν:.2f}"
    counts = {words: (verdicts == name).sum() for words, name in off_line.items()}
    return share >= at_least, {"share": share, "points": left.size, "worst": worst, **counts}


def inside_contact(
    figure3: xr.Dataset, figure4: xr.Dataset, audit3: xr.Dataset, audit4: xr.Dataset
) -> Measured:
    """Distance of the critical point from the axis over the largest contact radius."""
    # The largest contact radius of a paraboloid: g(a) = a².
    share = joined((figure3, figure4), lambda one: abs(one.critical_x) / np.sqrt(1.0 + one.normal_amplitude))
    verdicts = joined((audit3, audit4), lambda audit: audit.verdict[np.isfinite(audit.excess.values)])
    inside, beneath = share <= 1.0 + 1e-9, (verdicts == VERDICTS.index("surface")).sum()
    values = {"inside": inside.sum(), "points": share.size, "beneath": beneath, "audited": verdicts.size}
    return inside.all() and beneath == 0, {"least": share.min(), "most": share.max(), **values}


def outside_of_stick(*archives: xr.Dataset, times: float, at_least: float) -> Measured:
    """Distance of the critical point from the axis over the radius of permanent stick."""
    stick, position = joined(archives, stick_radius), joined(archives, lambda one: abs(one.critical_x))
    sticking = (stick > 0) & np.isfinite(position)
    relation = position[sticking] / stick[sticking] if sticking.any() else np.array([np.inf])
    share = (relation >= times).mean()
    shares = {"share": share, "outside": (relation > 1).mean(), "points": len(stick)}
    extent = {"least": relation.min(), "median": np.median(relation), "sticking": sticking.sum()}
    return share >= at_least, {**shares, **extent}


def stick_radius(dataset: xr.Dataset) -> xr.DataArray:
    """Radius in a_H inside which the contact sticks throughout the cycle.

    Returns
    -------
    xarray.DataArray
        With the dimensions of ``dataset.s``; 0 where the whole contact slides, or is lost, once a cycle.
        Where a flat face only just sticks, the radius of the face.
    """
    rows, _ = canonical_points(grid_of(dataset), np.arange(dataset.s.size))
    radius = np.empty(len(rows))
    for members in alike(rows):
        radius[members] = np.nan_to_num(margins_of(points_from(rows[members], {}))["stick_radius"])
    return dataset.s.copy(data=radius.reshape(dataset.s.shape)).rename("stick_radius")


def normal_along_x(*archives: xr.Dataset, degrees: float, at_least: float) -> Measured:
    """Angle between the critical plane's normal and the x axis; none where s is 0."""
    angle = joined(archives, lambda archive: abs(archive.critical_angle))
    angle = angle[np.isfinite(angle)]
    share = (angle <= degrees).mean()
    worst = max(archives, key=lambda archive: float(abs(archive.critical_angle).max()))
    values = {"share": share, "points": len(angle), "median": np.median(angle), "largest": angle.max()}
    return share >= at_least, {"where": worst.attrs.get("title", "untitled"), **values}
