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
from numpy.typing import NDArray

import swtstudy
from swtstudy.faces.contacts import PhysicalContact
from swtstudy.figures.sheet import Sheet
from swtstudy.figures.style import COLOURS, MARKERS, save_figure, styled

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
    r = np.linspace(1e-6, 1.0, count)
    pads = {name: [pad(name, wear) for wear in depths] for name in BLENDS}
    figure = chart(depths, pads, r)
    save_figure(figure, given.results / "worn.png")


def chart(depths: tuple[float, ...], pads: dict[str, list[swtstudy.TabulatedProfile]], r: Array) -> Figure:
    """Shapes and pressures half way, and SWT over the wear: dashes and markers tell them apart in grey."""
    half = min(4, len(depths) - 1)
    new = contact_of(SHARES[0])
    with styled(width="page"):
        sheet = Sheet(1, 3, "page", least_height=2.4)
        figure = sheet.figure()
        shapes, pressures, values = sheet.panels(figure, share_x="none", share_y="none")[0]
        looks = zip(COLOURS, ("-", "--"), MARKERS[1:], BLENDS.items(), strict=False)
        for color, dashes, marker, (name, blend) in looks:
            look = {"color": color, "linestyle": dashes, "marker": ""}
            middle = pads[name][half]
            shapes.plot(middle.radius, 1e3 * middle.height, label=f"{name} (±{100 * blend:g} %)", **look)
            pressures.plot(r, pressure(contact_of(SHARES[0], middle), r), **look)
            for share, fill in zip(SHARES, ("white", color), strict=True):
                contacts = [new if share == SHARES[0] else contact_of(share)]
                contacts += [contact_of(share, one) for one in pads[name]]
                look |= {"marker": marker, "mfc": fill}
                swt = [swt_of(contact) for contact in contacts]
                values.plot((0.0, *depths), swt, label=f"{name}, {share:g}", **look)
        faint = {"linestyle": ":", "color": "0.4", "marker": ""}
        shapes.plot(r, 1e3 * r**2 / (2.0 * RADIUS) - depths[half], **faint, label="new, shifted")
        pressures.plot(r, pressure(new, r), **faint)
        shapes.set(xlabel="$r$ (mm)", ylabel="height (µm)", xlim=(0, 1), ylim=(-2.5, 8))
        shapes.set_title(f"(A)  worn by {depths[half]:g} µm")
        shapes.legend(title="blend", loc="upper left")
        pressures.set(xlabel="$r$ (mm)", ylabel="pressure (MPa)", xlim=(0, 1), ylim=(0, None))
        pressures.set_title("(B)  pressure of these")
        values.set(xlabel="wear (µm)", ylabel="SWT (MPa)", xlim=(0, None), ylim=(0, None))
        values.set_title(r"(C)  SWT at $Q_A/(\mu F_0)$")
        values.legend(loc="lower left")
    return figure


def pressure(contact: PhysicalContact, r: Array) -> Array:
    """Pressure in MPa at radii in mm."""
    field = swtstudy.stress_field(r / contact.length_scale, 0.0, 0.0, time=[0.0], **contact.parameters())
    return np.asarray(-contact.stress_scale * field.sigma_zz.values[0])


if __name__ == "__main__":
    main()
