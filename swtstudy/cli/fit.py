"""swtstudy fit"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from swtstudy.cli.options import examples, with_width


@click.command(epilog=examples("swtstudy fit rig.toml tests.csv"))
@click.argument("study")
@click.argument("tests")
@click.option(
    "--y", default="cycles_volume", show_default=True, help="Which lives: cycles_volume, _point or _line."
)
@click.option("--friction", is_flag=True, help="Fit friction, too.")
@click.option("--confidence", default=0.95, show_default=True, help="Level of the confidence intervals.")
@click.option("--results", default="results", show_default=True, help="Folder for the fit and its figure.")
@with_width
def fit(study: str, tests: str, y: str, friction: bool, confidence: float, results: str, width: Any) -> None:
    """Fit the critical distance, and friction, to the lives of TESTS.

    STUDY is a study file with units and the constants of the material: what all tests have in common. TESTS
    is a CSV file with a row for each test: parameters, in the units of the study, and life, the rounds to a
    crack. Least squares of the logarithms of predicted over observed lives. Writes the fit as netCDF and the
    figure of predicted over observed lives: NAME_fit.
    """
    from swtstudy.archive.write import save
    from swtstudy.figures.fitted import draw_fit, fit_lines
    from swtstudy.figures.save import save_figure
    from swtstudy.results.fitting import fit as fitted_to
    from swtstudy.vocabulary.files import check_writable

    targets = {end: Path(results) / f"{Path(study).stem}_fit{end}" for end in (".nc", ".png")}
    for path in targets.values():
        check_writable(path)
    found = fitted_to(study, tests, y=y, friction=friction, confidence=confidence)
    save(found, targets[".nc"])
    save_figure(draw_fit(found, width=width), targets[".png"])
    for line in fit_lines(found):
        click.echo(line)
    for path in targets.values():
        click.echo(str(path))
