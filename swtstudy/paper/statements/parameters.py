"""Section 4.1: friction, amplitude of the tangential oscillation, Poisson ratio; the influence of each.

The paper's words on the latter stand beside the measured share of the variance.
"""

from __future__ import annotations

import itertools

import numpy as np
import xarray as xr

from swtstudy.paper.rendered import rendered
from swtstudy.paper.statements.statement import Finding, largest_change, listed, statement, with_dims
from swtstudy.vocabulary.choices import REGIMES
from swtstudy.vocabulary.parameters import AXES
from swtstudy.vocabulary.wording import unit_words, value_words

#: Poisson ratios of most metals.
_METALS = slice(0.25, 0.35)
_AMPLITUDE = "tangential_amplitude"
#: "Few" curves, and a fall that is "little".
_FEW, _LITTLE = 0.05, 0.05


def _rises(archive: xr.Dataset, dim: str, symbol: str) -> Finding:
    """Largest fall of s over a parameter."""
    fall = largest_change(with_dims(archive, dim), dim, -1)
    low, high = float(archive[dim].min()), float(archive[dim].max())
    curves = archive.s.size // archive.sizes[dim]
    words = f"falls by up to {fall:.1e} from one value to the next" if fall else "falls nowhere"
    return Finding(f"s {words}, {symbol} from {low:g} to {high:g} on {curves} curves", fall == 0)


@statement("Section 4.1")
def rises_with_friction(friction: xr.Dataset) -> Finding:
    """s rises with the coefficient of friction.

    Holds if: s never falls beyond its error, on any curve
    """
    return _rises(friction, "friction", "μ")


@statement("Section 4.1")
def rises_with_tangential_amplitude(tangential_amplitude_sample: xr.Dataset) -> Finding:
    """s rises with the amplitude of the tangential oscillation.

    Holds if: s never falls beyond its error, on any curve of a random sample
    """
    falls = _falls(tangential_amplitude_sample)
    return Finding(_falls_in_words("s", falls), not (falls > 0.0).any())


@statement("Section 4.1")
def rises_in_partial_slip(tangential_amplitude_sample: xr.Dataset) -> Finding:
    """The same up to gross slip, for basically all loads; in gross slip s hardly falls.

    Holds if: up to gross slip s falls on at most 5% of the curves; in gross slip nowhere by more than 5% of
    an earlier value
    """
    falls = _falls(tangential_amplitude_sample)
    slides = tangential_amplitude_sample.regime == REGIMES.index("gross_slip")
    before, within = falls.where(~slides, 0.0), falls.where(slides, 0.0)
    measured = (
        f"{_falls_in_words('up to gross slip s', before)}; {_falls_in_words('in gross slip s', within)}"
    )
    few = float((before > 0.0).any(_AMPLITUDE).mean()) <= _FEW
    return Finding(measured, few and float(within.max()) <= _LITTLE)


def _falls(sample: xr.Dataset) -> xr.DataArray:
    """Relative distance of s, with its error, below its largest value at any smaller amplitude; else 0."""
    ordered = with_dims(sample, _AMPLITUDE).sortby(_AMPLITUDE)
    largest = (ordered.s - ordered.s_error).cumulative(_AMPLITUDE).max()
    return ((largest - ordered.s - ordered.s_error) / abs(largest)).clip(min=0.0)


def _falls_in_words(subject: str, falls: xr.DataArray) -> str:
    """On how many curves s falls, and by how much."""
    curves = (falls > 0.0).any(_AMPLITUDE)
    if not curves.any():
        return f"{subject} falls on none of {curves.size} random curves"
    count, most = int(curves.sum()), float(falls.max())
    return f"{subject} falls on {count} of {curves.size} random curves, by up to {most:.1%}"


@statement("Section 4.1")
def poisson_ratio_is_weak(poisson_ratio: xr.Dataset) -> Finding:
    """The dependence on the Poisson ratio is very weak.

    Holds if: s changes by at most 5% over ν = 0.25…0.35, for every μ
    """
    s = with_dims(poisson_ratio, "poisson_ratio", "friction").s.sortby("poisson_ratio")
    metals = s.sel(poisson_ratio=_METALS)
    change = (metals.max("poisson_ratio") - metals.min("poisson_ratio")) / metals.mean("poisson_ratio")
    whole = s.isel(poisson_ratio=-1) / s.isel(poisson_ratio=0)
    measured = (
        f"change over ν = 0.25…0.35, μ = {listed(change, '.0%')}; s(ν = {float(s.poisson_ratio[-1]):g})/"
        f"s({float(s.poisson_ratio[0]):g}), μ = {listed(whole)}"
    )
    return Finding(measured, bool((change <= 0.05).all()))


@statement("Section 4.1")
def poisson_ratio_is_intricate(poisson_ratio: xr.Dataset) -> Finding:
    """The dependence on the Poisson ratio is intricate.

    Holds if: s(ν) is not simply monotone in the same sense for every μ
    """
    s = with_dims(poisson_ratio, "poisson_ratio", "friction").s.sortby("poisson_ratio")
    rising = (s.diff("poisson_ratio") > 0).mean("poisson_ratio")
    return Finding(
        f"share of the steps of ν over which s rises, μ = {listed(rising)}",
        bool(((rising > 0) & (rising < 1)).any() or np.ptp(rising.values) > 0),
    )


#: The paper's words, by parameter; it says nothing of the others.
SAYS = {
    "poisson_ratio": "weak but intricate (section 4.1)",
    "friction": "s rises with it (section 4.1)",
    "normal_amplitude": "amplifies the influence of the phase (figures 3 and 4)",
    "frequency_ratio": "the phase matters most at 1/4, 1/2 and 3/2 (figure 4)",
    "tangential_amplitude": "s rises with it (section 4.1)",
    "phase": "s is nearly constant over it for small δA, else up to almost a factor of two (figure 3)",
    "flat_radius": "s falls for the rounded punch, rises for the truncated paraboloid (figure 5)",
    "waviness_amplitude": "strong, with oscillations (figure 7)",
    "wavelength": "sets the period of the oscillations over h (figure 7)",
}


def table(indices: xr.Dataset, of_paper: bool = False) -> str:
    """Sobol indices as Markdown.

    Parameters
    ----------
    indices
        From `swtstudy.sensitivity`.
    of_paper
        Whether they belong to a study of the paper, with the paper's words.
    """
    axes = [str(dim) for dim in indices.first_order.dims if dim not in ("quantity", "parameter")]
    places = indices.stack(place=axes) if axes else indices.expand_dims("place")
    level, parts = f"{100 * indices.attrs['confidence']:g} %", []
    for quantity, number in itertools.product(indices["quantity"].values, range(places.sizes["place"])):
        one = places.sel(quantity=quantity).isel(place=number)
        units = {name: unit_words(one[name].attrs.get("units", "1")) for name in axes}
        where = [f"{name} = {value_words(name, one[name].item())}{unit}" for name, unit in units.items()]
        rows = []
        for name in indices["parameter"].values:
            cells = [f"{AXES[name].letter} {name}"]
            for key in ("first_order", "total"):
                ends = (float(one[f"{key}{end}"].sel(parameter=name)) for end in ("", "_low", "_high"))
                cells += "{:.3f}|{:.3f} to {:.3f}".format(*ends).split("|")
            # The paper says nothing here of quantities other than s.
            rows.append(cells + [SAYS.get(name, "") if quantity == "s" else ""] * of_paper)
        moments = float(one["mean"]), float(one["variance"]) ** 0.5
        parts.append(
            (
                ", ".join([str(quantity), *where]),
                "mean {:.4g}, standard deviation {:.4g}".format(*moments),
                rows,
            )
        )
    title = indices.attrs["title"]
    return rendered("statements/indices.md", title=title, parts=parts, level=level, of_paper=of_paper)
