"""What a process that is killed while drawing leaves behind."""

import signal
import subprocess
import sys

import matplotlib
import pytest
from command import call

import swtstudy


@pytest.mark.slow
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
    study = 'title = "t"\nrtol = 1e-2\naxes.phase = [0, 1, 2]\n[figure]\nx = "phase"\n'
    swtstudy.run(swtstudy.Study.from_text(study), tmp_path / "phase.nc")
    with matplotlib.rc_context({"text.usetex": True}):
        assert call("plot", tmp_path / "phase.nc").exit_code == 0
    assert (tmp_path / "phase.png").stat().st_size > 1000
