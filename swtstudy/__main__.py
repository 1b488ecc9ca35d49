"""``python -m swtstudy`` is the command ``swtstudy``."""

from swtstudy.cli import main

main(prog_name="swtstudy")
