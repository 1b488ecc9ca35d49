"""swtstudy run"""

from __future__ import annotations

import logging
import signal
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn

import click

from swtstudy.archive.paths import archive_paths
from swtstudy.cli import terminal
from swtstudy.vocabulary.files import check_writable
from swtstudy.vocabulary.wording import number_of, number_words

if TYPE_CHECKING:
    import xarray as xr
    from distributed import Client

    from swtstudy.figures.sheet import Width
    from swtstudy.study.definition import Study

#: Exit code of a run in which points failed.
POINTS_FAILED = 3

#: Seconds to wait for a scheduler: a cluster answers in one, a user waits for ten.
CONNECT_SECONDS = 10.0

#: How many failed points the summary lists; swtstudy info lists more.
_NAMED = 5


@click.command()
@click.argument("studies", nargs=-1, metavar="STUDY...", shell_complete=terminal.study_completion)
@click.option("--all", "suite", is_flag=True, help="Every study of the paper; see swtstudy list.")
@terminal.with_results
@click.option(
    "--format",
    "formats",
    multiple=True,
    default=("png",),
    show_default=True,
    type=click.Choice(["png", "pdf", "svg"]),
    help="Format of the figure; may be given more than once.",
)
@terminal.with_width
@terminal.with_workers
@click.option("--processes", is_flag=True, help="Compute in processes: a point that kills one fails alone.")
@click.option("--scheduler", metavar="ADDRESS", help="Use this dask cluster instead, e.g. tcp://host:8786.")
@click.option("--retry-failed", is_flag=True, help="Recompute points that failed before.")
def run(
    studies: tuple[str, ...],
    suite: bool,
    results: str,
    formats: tuple[str, ...],
    width: Width | None,
    scheduler: str | None,
    **options: Any,
) -> None:
    """Compute each STUDY, and write its archive and its figure.

    STUDY is a TOML file, a folder of them, or the name of a study of the paper (see swtstudy list).

    Points already computed are not computed again: a stopped run continues, and a study that has grown is
    extended.

    \b
    Exit codes: 0  all points are computed
                2  one line says what is wrong: input, disk or cluster
                3  points failed
              130  stopped, by Ctrl-C or SIGTERM

    After 2 and 130 everything computed so far is saved, and the same command
    continues from there.

    \b
    Examples:
      swtstudy run figure3
      swtstudy run mine.toml --workers 8 --format pdf
      swtstudy run mine.toml --scheduler tcp://host:8786
      swtstudy run --all
    """
    from swtstudy.study.definition import read_studies
    from swtstudy.study.shipped import shipped_folder

    if not studies and not suite:
        raise click.UsageError("Missing argument 'STUDY...', or --all.")
    defined = read_studies([*studies, str(shipped_folder())] if suite else studies)
    targets = archive_paths(defined, results)
    check_writable(*targets.values())

    from swtstudy.archive.run import run_several

    client = _connect(scheduler) if scheduler else None
    before = {target: _written(target) for target in targets.values()}
    failed: list[bool] = []

    def done(study: Study, target: Path, dataset: xr.Dataset) -> None:
        seconds = dataset.attrs["wall_time_seconds"]
        effort = "already computed" if _written(target) == before[target] else f"in {seconds:.1f} s"
        failed.append(_summarize(dataset, target, effort))
        for ending in formats if study.figure is not None else ():
            click.echo(str(target.with_suffix(f".{ending}")))

    pairs = [(study, targets[source]) for source, study in defined.items()]
    with _stopped_once():
        run_several(pairs, done, formats, width, client=client, **options)
    if any(failed):
        sys.exit(POINTS_FAILED)
    if len(targets) == 1:
        terminal.say_next(f"swtstudy report {next(iter(targets.values()))}")


@contextmanager
def _stopped_once() -> Iterator[None]:
    """Ctrl-C and SIGTERM, which batch systems send before they kill, stop a run; what comes later, nothing.

    A second one must not find what the first has to say, or to end, half done.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return

    def stop(*_: object) -> NoReturn:
        for each in (signal.SIGINT, signal.SIGTERM):
            signal.signal(each, signal.SIG_IGN)
        raise KeyboardInterrupt

    before = {each: signal.signal(each, stop) for each in (signal.SIGINT, signal.SIGTERM)}
    try:
        yield
    finally:
        for each, handler in before.items():
            if signal.getsignal(each) is stop:
                signal.signal(each, handler)


def _connect(address: str) -> Client:
    try:
        from distributed import Client
    except ImportError:
        raise ValueError(
            '--scheduler needs the extra "distributed": pip install "swtstudy[distributed]"'
        ) from None
    try:
        client = Client(address, timeout=CONNECT_SECONDS)
    except (OSError, ValueError) as error:
        raise OSError(f"no dask scheduler at {address} ({error})") from None
    for name in ("distributed", "distributed.client"):
        # A lost connection is reported in one line of ours; distributed would log a traceback.
        logging.getLogger(name).setLevel(logging.CRITICAL)
    click.echo(f"dashboard: {client.dashboard_link}", err=True)
    return client


def _written(target: Path) -> int | None:
    """Time at which an archive was written, ns; None if there is none."""
    return target.stat().st_mtime_ns if target.exists() else None


def _summarize(dataset: xr.Dataset, target: Path, effort: str) -> bool:
    """Print a summary of a run; return whether points failed."""
    from swtstudy.archive.describe import failures, outcome, relative_errors, rest_words

    relative, worst = relative_errors(dataset), "s finite and positive at none of them"
    if relative.size:
        worst = f"relative error up to {number_words(relative.max(), 2)}"
    click.echo(f"{target}: {number_of(dataset.s.size, 'point')} {effort}, {worst}")
    for line in outcome(dataset):
        terminal.say(line, 2)
    if at_rest := rest_words(dataset):
        terminal.say(f"Contact at rest: {at_rest}.", 2)
    failed = [*failures(dataset)]
    for where, why in failed[:_NAMED]:
        click.echo(f"failed: {where}: {why}", err=True)
    if len(failed) > _NAMED:
        click.echo(f"failed: {len(failed) - _NAMED} more, see swtstudy info {target}", err=True)
    if failed:
        click.echo(f"{number_of(len(failed), 'point')} failed; --retry-failed recomputes them", err=True)
    return bool(failed)
