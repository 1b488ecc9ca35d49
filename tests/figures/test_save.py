"""What a process that is killed while drawing leaves behind."""

import signal
import subprocess
import sys

import matplotlib
import pytest

import swtstudy
from swtstudy.figures.draw import draw
from swtstudy.figures.style import save_figure
from swtstudy.study.figure import FigureLayout


@pytest.mark.skipif(sys.platform == "win32", reason="signals")
def test_nothing_is_left_of_a_figure_whose_drawing_is_ended(tmp_path):
    (tmp_path / "figure.png").write_bytes(b"the last one")
    code = f"""
import os, signal
from swtstudy.figures.style import save_figure
class Ended:
    def savefig(self, *_, **__):
        os.kill(os.getpid(), signal.SIGTERM)
save_figure(Ended(), {str(tmp_path / "figure.png")!r})
"""
    assert subprocess.run([sys.executable, "-c", code]).returncode == -signal.SIGTERM
    assert [path.name for path in tmp_path.iterdir()] == ["figure.png"]
    assert (tmp_path / "figure.png").read_bytes() == b"the last one"


def test_figures_are_drawn_without_the_users_latex(tmp_path):
    dataset = swtstudy.solve(phase=[0.0, 1.0, 2.0], rtol=1e-2)
    with matplotlib.rc_context({"text.usetex": True}):
        figure = draw(dataset, FigureLayout(x="phase"))
        save_figure(figure, tmp_path / "phase.png")
    assert (tmp_path / "phase.png").stat().st_size > 1000
