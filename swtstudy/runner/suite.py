"""Running many studies at once, each with its archive and its figures."""

from __future__ import annotations

from collections.abc import Iterable
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import xarray as xr

    from swtstudy.figures.sheet import Width
    from swtstudy.runner.run import Finished
    from swtstudy.study.definition import Study


def run_suite(
    folder: str | PathLike[str] | None = None,
    results: str | PathLike[str] = "results",
    formats: Iterable[str] = ("png",),
    width: Width | None = None,
    **options: Any,
) -> dict[str, xr.Dataset]:
    """Compute every study in a folder, and write their archives and figures.

    Parameters
    ----------
    folder
        Folder with study files (TOML); by default the studies of the paper, which come with the package.
    results
        Folder for archives and figures, which are named after their studies.
    formats
        Formats of the figures: "png", "pdf", "svg".
    width
        What the figures are made for: "column", "page", or None for a screen.
    **options
        Further arguments of `swtstudy.run`.

    Returns
    -------
    dict of xarray.Dataset
        The archives, loaded, by the name of the study.

    Raises
    ------
    StudyError
        A ValueError with every mistake in every study, before anything is computed.
    """
    from swtstudy.archive.paths import archive_paths
    from swtstudy.study.definition import read_studies
    from swtstudy.study.shipped import shipped_folder

    folder = shipped_folder() if folder is None else folder
    studies = read_studies([str(folder)])
    targets = archive_paths(studies, results)
    found: dict[str, xr.Dataset] = {}

    def done(study: Study, path: Path, dataset: xr.Dataset) -> None:
        found[path.stem] = dataset

    pairs = [(study, targets[path]) for path, study in studies.items()]
    run_and_draw(pairs, formats, done, width, **options)
    return found


def run_and_draw(
    studies: Iterable[tuple[Study, Path]],
    formats: Iterable[str],
    done: Finished,
    width: Width | None = None,
    **options: Any,
) -> None:
    """Run studies with the same workers, and draw the figures of those that have one beside their archives.

    Parameters
    ----------
    studies
        Studies and the paths of their archives.
    formats
        Formats of the figures.
    done
        Called with every archive once its figure is drawn; not always in this thread.
    width
        What the figures are made for, as for `swtstudy.accessor.SwtAccessor.figure`.
    **options
        Further arguments of `swtstudy.run`.
    """
    from swtstudy.runner.run import run_several

    def finished(study: Study, path: Path, dataset: xr.Dataset) -> None:
        if study.figure is not None:
            from swtstudy.figures.draw import draw
            from swtstudy.figures.style import save_figure

            figure = draw(dataset, width=width)
            for ending in formats:
                save_figure(figure, path.with_suffix(f".{ending}"))
        done(study, path, dataset)

    run_several(studies, finished, **options)
