"""What a process that is killed while drawing leaves behind."""

import signal
import subprocess
import sys

import pytest


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
