"""The attributes of an archive: reading them, and the versions with which it was made.

Malformed ones raise a ValueError with the reason. Nothing here imports xarray, which workers need not wait
for.
"""

from __future__ import annotations

import math
import platform
from collections.abc import Callable, Collection
from functools import cache
from importlib.metadata import version
from typing import Any

from pydantic import TypeAdapter, ValidationError

from swtstudy.points.chunk import Run
from swtstudy.study.figure import VARIABLES, FigureLayout, reference, wrong_layout
from swtstudy.vocabulary.mistakes import literal
from swtstudy.vocabulary.quantities import COUNTS, DISTANCE, EVERY_VARIABLE, NAMED
from swtstudy.vocabulary.version import __version__


def read_runs(text: object) -> tuple[Run, ...]:
    """The runs that made the values."""
    runs: tuple[Run, ...] = _read(tuple[Run, ...], text)
    for run in runs:
        if not {*run.quantities} <= {*NAMED, COUNTS, DISTANCE}:
            raise ValueError(f"quantities of a run: {literal(run.quantities)}")
        if not 0.0 <= run.seconds < math.inf:
            raise ValueError(f"seconds of a run: {literal(run.seconds)}")
    return runs


def read_figure(text: object, others: Collection[str] = ()) -> FigureLayout:
    """The layout of the figure, which may show others than what every study may have."""
    layout: FigureLayout = _read(FigureLayout, text)
    for key, found, allowed in wrong_layout(layout):
        raise ValueError(f"{key.removeprefix('figure.')}: found {found}; allowed: {allowed}")
    for y in layout.y:
        if reference(y) is None and y.strip() not in (*VARIABLES, *EVERY_VARIABLE, *others):
            raise ValueError(f"{literal(y)} is not a quantity")
    return layout


#: The reader of values of a type; pydantic takes a millisecond to make one.
_reader: Callable[[Any], TypeAdapter[Any]] = cache(TypeAdapter)


def _read(kind: Any, text: object) -> Any:
    """The value of a type that is written as JSON; a ValueError with the first thing that is wrong in it."""
    try:
        return _reader(kind).validate_json(text, strict=True)  # type: ignore[arg-type]
    except ValidationError as error:
        wrong = error.errors()[0]
        raise ValueError(": ".join([*map(str, wrong["loc"]), wrong["msg"]])) from None


#: Packages whose versions can affect the numbers or the file.
_PACKAGES = ("numpy", "scipy", "xarray", "netCDF4", "dask")


@cache
def versions() -> str:
    """Versions of Python, of this package and of packages that affect its numbers and files."""
    packages = (f"{name} {version(name)}" for name in _PACKAGES)
    return ", ".join([f"python {platform.python_version()}", f"swtstudy {__version__}", *packages])
