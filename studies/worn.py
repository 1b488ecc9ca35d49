"""How SWT changes as a pad wears: a paraboloid whose tip has worn flat, with a sharp or a round blend.

The pad of ``studies/physical.py`` (R = 50 mm, aluminium on aluminium) under a constant normal force of 200 N
and an oscillating tangential force, from new to a wear of 5 µm: its face is then wider than the contact was.
Each worn pad is a table, studies/worn/*.csv (radius and height in mm); ``--tables`` writes them anew. The
shape that wear tends to at a constant radius of stick has a singular pressure and is not among them.

Run from the project's folder: ``python studies/worn.py``; writes results/worn.png.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine
from numpy.typing import NDArray

import swtstudy
from swtstudy.contacts.contact import PhysicalContact

TABLES = Path(__file__).parent / "worn"
RADIUS, FORCE, FRICTION = 50.0, 200.0, 0.5
#: Wear depths in µm, and the half width of the blend over the radius of the face.
WEAR = (0.25, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0)
BLENDS = {"sharp": 0.03, "round": 0.3}
#: Amplitudes of the tangential force over that at which the pad slides.
SHARES = (0.4, 0.8)
#: Radii of a table: in steps over the pad, and in finer ones over the blend.
COUNT, COUNT_IN_BLEND, LARGEST = 151, 101, 1.5

Array = NDArray[np.float64]


def worn(wear: float, blend: float) -> tuple[Array, Array]:
    """Radii and heights in mm: the slope r/R sets in smoothly about the edge of the face."""
    edge = np.sqrt(2.0 * RADIUS * 1e-3 * wear)
    low, high = edge * (1.0 - blend), edge * (1.0 + blend)
    fine = np.linspace(low, high, 8 * COUNT_IN_BLEND)
    r = np.unique(np.concatenate([np.linspace(0.0, LARGEST, 20 * COUNT), fine]))
    t = np.clip((r - low) / (high - low), 0.0, 1.0)
    slope = r / RADIUS * t * t * (3.0 - 2.0 * t)
    height = np.append(0.0, np.cumsum(0.5 * (slope[1:] + slope[:-1]) * np.diff(r)))
    few = np.union1d(np.linspace(0.0, LARGEST, COUNT), np.linspace(low, high, COUNT_IN_BLEND))
    return few, np.where(few <= low, 0.0, np.interp(few, r, height))


def write_tables() -> None:
    """The tables of all worn pads."""
    TABLES.mkdir(exist_ok=True)
    for name, blend in BLENDS.items():
        for wear in WEAR:
            rows = zip(*worn(wear, blend), strict=True)
            text = "radius,height\n" + "".join(f"{r:.9g},{f:.12g}\n" for r, f in rows)
            (TABLES / f"{name}_{wear:g}.csv").write_text(text, encoding="utf-8")


def pad(name: str, wear: float) -> swtstudy.TabulatedProfile:
    """A worn pad from its table."""
    columns = np.loadtxt(TABLES / f"{name}_{wear:g}.csv", delimiter=",", skiprows=1)
    return swtstudy.TabulatedProfile(f"{name} {wear:g}", *columns.T)


def contact_of(share: float, profile: swtstudy.TabulatedProfile | None = None) -> PhysicalContact:
    """A worn pad under its forces, or the new one."""
    shape = {"radius": RADIUS} if profile is None else {"profile": profile}
    return swtstudy.physical(
        young_modulus=73.1e3,
        poisson_ratio=0.33,
        normal_force=FORCE,
        friction=FRICTION,
        tangential_force_amplitude=share * FRICTION * FORCE,
        **shape,
    )


def swt_of(contact: PhysicalContact) -> float:
    """SWT in MPa, of either of two equal bodies."""
    return float(contact.solve().SWT[0])


def main() -> None:
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--results", type=Path, default=Path("results"), help="folder for the figure")
    arguments.add_argument("--tables", action="store_true", help="write the tables anew")
    arguments.add_argument("--quick", action="store_true", help="one wear depth, to see that it runs")
    given = arguments.parse_args()
    if given.tables:
        write_tables()
    depths, count = (WEAR[:1], 50) if given.quick else (WEAR, 1500)
    figure = Figure((9.0, 3.6), layout=ConstrainedLayoutEngine())
    shapes, pressures, values = figure.subplots(1, 3)
    r = np.linspace(1e-6, 1.0, count)
    of_new = {share: swt_of(contact_of(share)) for share in SHARES}
    for color, (name, blend) in zip(("C3", "C0"), BLENDS.items(), strict=True):
        pads = [pad(name, wear) for wear in depths]
        half = min(4, len(pads) - 1)
        label = f"{name} blend (±{100 * blend:g} %)"
        shapes.plot(pads[half].radius, 1e3 * pads[half].height, color=color, label=label)
        contact = contact_of(SHARES[0], pads[half])
        pressures.plot(r, pressure(contact, r), color=color)
        for style, share in zip(("-", "--"), SHARES, strict=True):
            swt = [of_new[share], *(swt_of(contact_of(share, one)) for one in pads)]
            values.plot((0.0, *depths), swt, style, color=color, marker=".", label=f"{name}, {share:g}")
    new = contact_of(SHARES[0])
    shapes.plot(r, 1e3 * r**2 / (2.0 * RADIUS) - depths[half], ":", color="0.5", label="new, shifted")
    pressures.plot(r, pressure(new, r), ":", color="0.5")
    shapes.set(
        xlabel="r in mm",
        ylabel="height in µm",
        xlim=(0, 1),
        ylim=(-2.5, 8),
        title=f"worn by {depths[half]:g} µm",
    )
    shapes.legend(frameon=False, fontsize=8)
    pressures.set(xlabel="r in mm", ylabel="pressure in MPa", xlim=(0, 1), ylim=(0, None))
    values.set(xlabel="wear in µm", ylabel="SWT in MPa", xlim=(0, None), ylim=(0, None))
    values.legend(title="blend, $Q_A/(\\mu F_0)$", frameon=False, fontsize=8)
    figure.savefig(given.results / "worn.png", dpi=150)


def pressure(contact: PhysicalContact, r: Array) -> Array:
    """Pressure in MPa at radii in mm."""
    field = swtstudy.stress_field(r / contact.length_scale, 0.0, 0.0, time=[0.0], **contact.parameters())
    return np.asarray(-contact.stress_scale * field.sigma_zz.values[0])


if __name__ == "__main__":
    main()
