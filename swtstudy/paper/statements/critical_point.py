"""Section 4.1: where the critical point lies, how the critical plane is turned, and how contacts slip.

That the point lies on the surface and at y = 0 is tested on an audit, since the archives hold maxima over
that line only.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import xarray as xr

from swtstudy.archive.recall import grid_of
from swtstudy.paper.audit.dataset import VERDICTS
from swtstudy.paper.statements.statement import Finding, statement
from swtstudy.points.canonical import alike, points_from
from swtstudy.solver.margins import margins_of
from swtstudy.vocabulary.arrays import FloatArray
from swtstudy.vocabulary.choices import REGIMES


def stick_radius(dataset: xr.Dataset) -> xr.DataArray:
    """Radius in a_H inside which the contact sticks throughout the cycle.

    Returns
    -------
    xarray.DataArray
        With the dimensions of ``dataset.s``; 0 where the whole contact slides, or is lost, once a cycle.
        Where a flat face only just sticks, the radius of the face.
    """
    rows, _ = grid_of(dataset).canonical(np.arange(dataset.s.size))
    radius = np.empty(len(rows))
    for members in alike(rows, rows["p"], rows["q"]):
        radius[members] = np.nan_to_num(margins_of(points_from(rows[members], {}))["stick_radius"])
    return dataset.s.copy(data=radius.reshape(dataset.s.shape)).rename("stick_radius")


#: What "for basically all simulations" is taken to mean.
_BASICALLY_ALL = 0.95


def joined(archives: tuple[xr.Dataset, ...], values: Callable[[xr.Dataset], xr.DataArray]) -> FloatArray:
    """Values of every archive, one after another."""
    return np.concatenate([values(archive).values.ravel() for archive in archives])


#: Every archive of the suite, in its order.
EVERY_ARCHIVE = (
    *(f"figure{number}" for number in range(3, 9)),
    "other_frequencies",
    "friction",
    "tangential_amplitude",
    "poisson_ratio",
)


@statement("Title", EVERY_ARCHIVE)
def slips_partially(*archives: xr.Dataset) -> Finding:
    """The contacts oscillate in partial slip.

    Holds if: at 95% of all points the regime is partial slip: part of the contact slips, no gross slip (max(u
    − δ) > min(u + δ)) recurs in the cycle, and the contact never lifts off
    """
    regime = joined(archives, lambda archive: archive.regime)
    shares = {name: float((regime == REGIMES.index(name)).mean()) for name in REGIMES}
    words = ", ".join(f"{name.replace('_', ' ')} {share:.1%}" for name, share in shares.items() if share)
    return Finding(f"of {len(regime)} points: {words}", shares["partial_slip"] >= _BASICALLY_ALL)


@statement("Section 4.1")
def on_the_line(audit_parameter_box: xr.Dataset) -> Finding:
    """The critical point lies on the surface, on the line y = 0.

    Holds if: at 95% of the audited points no point of the body and no plane exceeds s by more than 0.1%
    """
    audit = audit_parameter_box.isel(sample=np.isfinite(audit_parameter_box.excess.values))
    verdict = audit.verdict.values
    codes = {name: verdict == code for code, name in enumerate(audit.verdict.attrs["flag_meanings"].split())}
    off, beneath, oblique = codes["symmetry_line"], codes["surface"], codes["plane_through_y"]
    left = off | beneath | oblique
    share = 1.0 - float(left.mean())
    measured = (
        f"at {share:.1%} of {len(verdict)} random points of all parameters the worst of all points and "
        f"planes is on the line; beneath the surface {beneath.sum()}, on an oblique plane {oblique.sum()}, "
        f"on the surface off the line {off.sum()}"
    )
    if left.any():
        measured += (
            f", with swt up to {float(audit.excess.values[left].max()):.1%} higher, for "
            f"ν ≥ {float(audit.poisson_ratio.values[left].min()):.2f}"
        )
    return Finding(measured, share >= _BASICALLY_ALL)


@statement("Figures 3 and 4")
def inside_contact(
    figure3: xr.Dataset, figure4: xr.Dataset, audit_figure3: xr.Dataset, audit_figure4: xr.Dataset
) -> Finding:
    """The critical point lies on the surface, within the largest contact.

    Holds if: |x| ≤ a_max at all points, and the maximum of the body beneath the surface at none of those
    audited
    """
    # The largest contact radius of a paraboloid: g(a) = a².
    share = joined((figure3, figure4), lambda one: abs(one.critical_x) / np.sqrt(1.0 + one.normal_amplitude))
    audits = audit_figure3, audit_figure4
    verdicts = joined(audits, lambda audit: audit.verdict[np.isfinite(audit.excess.values)])
    beneath = int((verdicts == VERDICTS.index("surface")).sum())
    inside = share <= 1.0 + 1e-9
    measured = (
        f"|x| ≤ a_max at {inside.sum()} of {share.size} points, |x|/a_max from {share.min():.3f} to "
        f"{share.max():.3f}; beneath the surface at {beneath} of {verdicts.size} randomly audited points"
    )
    return Finding(measured, bool(inside.all()) and beneath == 0)


@statement("Section 4.1", EVERY_ARCHIVE)
def outside_of_stick(*archives: xr.Dataset) -> Finding:
    """For basically all simulations the critical point lies well outside the zone of permanent stick.

    Holds if: |x| at least 1.1 times the radius of permanent stick at 95% of the points that have such a zone
    """
    stick, position = joined(archives, stick_radius), joined(archives, lambda one: abs(one.critical_x))
    sticking = (stick > 0) & np.isfinite(position)
    if not sticking.any():
        return Finding(f"none of {len(stick)} points has a zone of permanent stick", True)
    relation = position[sticking] / stick[sticking]
    share = float((relation >= 1.1).mean())
    measured = (
        f"{sticking.sum()} of {len(stick)} points have a zone of permanent stick; |x| ≥ 1.1 times its radius "
        f"at {share:.1%}, outside at {(relation > 1).mean():.1%}; smallest {relation.min():.3f}, "
        f"median {np.median(relation):.2f}"
    )
    return Finding(measured, share >= _BASICALLY_ALL)


@statement("Section 4.1", EVERY_ARCHIVE)
def normal_along_x(*archives: xr.Dataset) -> Finding:
    """For basically all simulations the critical plane's normal lies close to the x axis.

    Holds if: within 10° at 95% of all points
    """
    angle = joined(archives, lambda archive: abs(archive.critical_angle))
    # Where s is 0 there is no critical plane.
    angle = angle[np.isfinite(angle)]
    share = float((angle <= 10.0).mean())
    worst = max(archives, key=lambda archive: float(abs(archive.critical_angle).max()))
    measured = (
        f"within 10° at {share:.1%} of {len(angle)} points, median {np.median(angle):.1f}°, "
        f"largest {angle.max():.1f}° ({worst.attrs.get('title', 'untitled')})"
    )
    return Finding(measured, share >= _BASICALLY_ALL)
