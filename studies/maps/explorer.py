"""The first picture of the sliders of studies/explore_live.ipynb.

Run from the project's folder: python studies/maps/explorer.py (extra ``live``)
"""

import argparse
from io import BytesIO
from pathlib import Path

from matplotlib.image import imread

from swtstudy.figures.live import Explorer
from swtstudy.figures.sheet import new_figure
from swtstudy.figures.style import COLOURS, save_figure, stroke, styled

#: Dots per inch of the panels, inches of a row of the sliders, and the share of a column that its words have.
DOTS, ROW, WORDS = 150.0, 0.27, 0.56
#: The width of the panels, and their height over it.
WIDTH, SHAPE = 13.5, 4.2 / 13.5


def main() -> None:
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--results", type=Path, default=Path("results"), help="folder for the figure")
    arguments.add_argument("--quick", action="store_true", help="few dots, to see that it runs")
    given = arguments.parse_args()
    live = Explorer()
    dots = 0.2 * DOTS if given.quick else DOTS
    shown = [each for each in live.controls.values() if each.layout.display != "none"]
    rows = -(-len(shown) // 2)
    with styled():
        figure = new_figure((WIDTH, ROW * (rows + 2) + SHAPE * WIDTH))
        figure.set_layout_engine("none")
        high = ROW * (rows + 2) / figure.get_figheight()
        controls = figure.add_axes((0.0, 1.0 - high, 1.0, high))
        controls.set(xlim=(0.0, 2.0), ylim=(rows + 1.5, -0.5))
        for index, control in enumerate(shown):
            draw(controls, control, index // rows, index % rows + 0.2)
        words = live.caption.value.replace("<b>", "").replace("</b>", "")
        controls.text(0.02, rows + 0.8, words, va="center", weight="bold")
        panels = figure.add_axes((0.0, 0.0, 1.0, 1.0 - high))
        picture = BytesIO()
        live.live.figure.savefig(picture, format="png", dpi=dots)
        picture.seek(0)
        panels.imshow(imread(picture), aspect="auto", interpolation="none")
        for axes in (controls, panels):
            axes.axis("off")
        save_figure(figure, given.results / "explorer.png", {"savefig.dpi": dots})


def draw(axes, control, column: int, row: float) -> None:
    """A control in the place that the notebook has for it: its words, its rail, and where it stands."""
    axes.text(column + 0.42, row, control.description, ha="right", va="center")
    begin, end = column + 0.44, column + 0.87
    if not hasattr(control, "min"):
        box = {"facecolor": "white", "edgecolor": "0.6", "boxstyle": "square,pad=0.25"}
        axes.text(begin + 0.005, row, f"{control.value}  ▾", va="center", bbox=box)
        return
    place = begin + (control.value - control.min) / (control.max - control.min) * (end - begin)
    axes.plot([begin, end], [row, row], **stroke("0.75", linewidth=3))
    axes.plot([begin, place], [row, row], **stroke(COLOURS[0], linewidth=3))
    axes.plot([place], [row], "o", color=COLOURS[0], markersize=9)
    axes.text(column + 0.89, row, f"{control.value:.3g}", va="center")


if __name__ == "__main__":
    main()
