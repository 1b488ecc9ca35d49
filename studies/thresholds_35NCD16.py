"""Sixteen thresholds of fretting fatigue, steel cylinders on flats of 35NCD16: SWT and von Mises stress.

Run from the project's folder: python studies/thresholds_35NCD16.py > results/thresholds_35NCD16.txt
It also writes thresholds_35NCD16.png, into ``--results``.

Loads, thresholds of the amplitude Q of the tangential load at which cracks stop to start, and the von Mises
stresses that were published with them: ICF13, paper 952 (52100 cylinders, E = 205 GPa, ν = 0.3, constant P,
bulk stress in phase). PF are tests without a bulk stress, FF with one. The coefficient of friction is
0.8 in all of them. Stresses are at the trailing edge of the contact, at the surface and beneath it.
The column e/(a - c) is ``bulk_shift_ratio``: how far the bulk stress moves the stick zone. The last table is
the same with the stick zone in place.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import NamedTuple

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

import swtstudy
from swtstudy.faces.contacts import PhysicalContact
from swtstudy.figures.sheet import Sheet
from swtstudy.figures.style import COLOURS, MARKERS, save_figure, styled

YOUNG, POISSON, FRICTION = 205e3, 0.3, 0.8
#: Yield strength, and fatigue limits in reversed bending and torsion, MPa.
YIELD, BENDING, TORSION = 950.0, 575.0, 386.0
#: Depths in mm.
DEPTHS = (0.0, 0.005, 0.010, 0.015, 0.020)
#: Those that the figure shows.
SHOWN = (0.0, 0.005, 0.010, 0.020)

Array = NDArray[np.float64]


class Test(NamedTuple):
    """R in mm, P and threshold of Q in N/mm, largest bulk stress in MPa, its ratio, published von Mises."""

    name: str
    radius: float
    normal: float
    bulk: float
    ratio: float
    threshold: float
    mises: float


TESTS = (
    Test("PF1", 20, 353, 0, 0.1, 186, 0.97),
    Test("PF2", 20, 552, 0, 0.1, 218, 1.05),
    Test("PF3", 40, 398, 0, 0.1, 271, 0.83),
    Test("PF4", 40, 707, 0, 0.1, 287, 0.85),
    Test("PF5", 40, 1100, 0, 0.1, 310, 0.89),
    Test("PF6", 80, 795, 0, 0.1, 305, 0.62),
    Test("PF7", 80, 1414, 0, 0.1, 399, 0.71),
    Test("PF8", 80, 2209, 0, 0.1, 470, 0.77),
    Test("FF1", 80, 795, 100, 0.1, 273, 0.69),
    Test("FF2", 80, 795, 200, 0.1, 261, 0.78),
    Test("FF3", 80, 795, 400, 0.1, 137, 0.87),
    Test("FF4", 40, 398, 100, 0.1, 210, 0.83),
    Test("FF5", 40, 398, 200, 0.1, 192, 0.90),
    Test("FF6", 40, 398, 400, 0.1, 100, 0.93),
    Test("FF7", 80, 795, 200, 1.0, 300, 0.80),
    Test("FF8", 80, 795, 400, 1.0, 280, 0.97),
)


def contact_of(test: Test, shift: str = "moved") -> PhysicalContact:
    """The contact at the threshold, its stick zone moved by the bulk stress or not."""
    half = 0.5 * test.bulk * (1.0 - test.ratio)
    return swtstudy.physical(
        profile="cylinder",
        young_modulus=YOUNG,
        poisson_ratio=POISSON,
        radius=test.radius,
        normal_force=test.normal,
        friction=FRICTION,
        tangential_force_amplitude=test.threshold,
        bulk_stress_amplitude=half,
        bulk_stress_mean=test.bulk - half,
        stick_zone_shift=shift,
    )


def histories(contact: PhysicalContact) -> Array:
    """Stress over the cycle in MPa at the trailing edge, at the depths, shape (depths, instants, 6)."""
    field = swtstudy.stress_field(
        -contact.contact_radius / contact.length_scale,
        0.0,
        np.array(DEPTHS) / contact.length_scale,
        **contact.parameters(),
    )
    parts = [field[f"sigma_{name}"].values for name in ("xx", "yy", "zz", "yz", "xz", "xy")]
    return contact.stress_scale * np.moveaxis(np.stack(parts, axis=-1), 0, -2)


def shift_of(contact: PhysicalContact) -> str:
    """`bulk_shift_ratio` of the flat; a dash if no bulk stress moves the stick zone."""
    found = contact.solve(rtol=1e-2)
    if "stick_zone" not in found or float(found.stick_zone.sel(body=1)) == 0:
        return "-"
    return f"{float(found.bulk_shift_ratio.sel(body=1)):.3f}"


def von_mises(stress: Array) -> Array:
    """Of stresses (…, 6)."""
    xx, yy, zz, yz, xz, xy = np.moveaxis(stress, -1, 0)
    normal = (xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2
    return np.asarray(np.sqrt(0.5 * normal + 3.0 * (yz**2 + xz**2 + xy**2)))


def equivalent(stress: Array) -> Array:
    """√(SWT E) in MPa: the amplitude of the reversed stress that has the same SWT, of histories (…, 6)."""
    return np.sqrt(YOUNG * swtstudy.swt_of_history(stress, POISSON, YOUNG).swt)


def main() -> None:
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--results", type=Path, default=Path("results"), help="folder for the figure")
    arguments.add_argument("--quick", action="store_true", help="two tests, to see that it runs")
    given = arguments.parse_args()
    tests = (TESTS[0], TESTS[-1]) if given.quick else TESTS
    print("von Mises stress over 950 MPa at the edge, and √(SWT E) over 575 MPa at depths beneath it")
    print(f"test   a/mm  p0/MPa  published  found  ratio  e/(a-c)   {_heads()}")
    values, sizes, peaks = [], [], []
    for test in tests:
        contact = contact_of(test)
        stress = histories(contact)
        mises, amplitude = von_mises(stress).max(axis=-1) / YIELD, equivalent(stress) / BENDING
        values.append(amplitude)
        peaks.append(mises)
        sizes.append(contact.contact_radius)
        print(
            f"{test.name}  {sizes[-1]:6.3f}  {contact.peak_pressure:6.0f}  {test.mises:9.2f}  "
            f"{mises[0]:5.3f}  {mises[0] / test.mises:5.3f}  {shift_of(contact):>7}   {_row(amplitude)}"
        )
    table, published = np.array(values), np.array([test.mises for test in tests])
    (_, mean), (_, scatter) = _mean_and_scatter(table)
    found = np.array(peaks)[:, 0]
    ratio = (found / published).mean()
    print(f"{'mean':<21}{published.mean():9.2f}  {found.mean():5.3f}  {ratio:5.3f}  {'':7}   {_row(mean)}")
    print(f"{'scatter':<55}{_row(scatter)}")
    print(f"\nlargest von Mises stress over 950 MPa at these depths\n{'':46}{_heads()}")
    for test, row in zip(tests, peaks, strict=True):
        print(f"{test.name:<46}{_row(row)}")
    for words, row in _mean_and_scatter(np.array(peaks)):
        print(f"{words:<46}{_row(row)}")
    _print_in_place(tests, table)
    save_figure(draw(tests, np.array(sizes), table), given.results / "thresholds_35NCD16.png")


def _print_in_place(tests: tuple[Test, ...], moved: Array) -> None:
    """√(SWT E)/σ_−1 of the tests whose stick zone moves, with it in place."""
    print(f"\n√(SWT E) over 575 MPa with the stick zone in place\n{'':46}{_heads()}")
    table = moved.copy()
    for number, test in enumerate(tests):
        if test.bulk > 0.0 and test.ratio < 1.0:
            table[number] = equivalent(histories(contact_of(test, "none"))) / BENDING
            print(f"{test.name:<46}{_row(table[number])}")
    for words, row in _mean_and_scatter(table):
        print(f"{words + ', all tests':<46}{_row(row)}")


def _heads() -> str:
    return "  ".join(f"{1e3 * depth:3.0f} µm" for depth in DEPTHS)


def _row(values: Array) -> str:
    return "  ".join(f"{value:6.3f}" for value in values)


def _mean_and_scatter(table: Array) -> tuple[tuple[str, Array], ...]:
    """Over the tests, at each depth."""
    mean = table.mean(axis=0)
    return ("mean", mean), ("scatter", table.std(axis=0) / mean)


def draw(tests: tuple[Test, ...], sizes: Array, table: Array) -> Figure:
    """√(SWT E)/σ_−1 at the thresholds over the half-width: one marker a test."""
    pulled = np.array([test.bulk > 0.0 for test in tests])
    with styled(width="page"):
        sheet = Sheet(1, 1, "page", least_height=4.0)
        figure = sheet.figure()
        axes = sheet.panels(figure)[0, 0]
        for color, marker, depth in zip(COLOURS, MARKERS[1:], SHOWN, strict=False):
            column = table[:, DEPTHS.index(depth)]
            words = "surface" if depth == 0.0 else f"{1e3 * depth:.0f} µm"
            look = {"linestyle": "none", "marker": marker, "color": color, "markersize": 4.5}
            axes.plot(sizes[~pulled], column[~pulled], label=words, **look)
            axes.plot(sizes[pulled], column[pulled], mfc="white", **look)
        axes.axhline(1.0, color="0.4", linestyle="-", marker="", linewidth=0.8)
        axes.set(xlabel="half-width $a$ (mm)", xlim=(0, None), ylim=(0.6, None))
        axes.set_ylabel(r"$\sqrt{\mathrm{SWT}\,E}\,/\,\sigma_{-1}$")
        axes.set_title("at the threshold of crack initiation; open: with bulk stress")
        axes.legend(title="beneath the edge", ncols=2)
    return figure


if __name__ == "__main__":
    main()
