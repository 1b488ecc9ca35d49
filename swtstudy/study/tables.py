"""The structure of a study file; values of parameters are checked elsewhere, against their table."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Discriminator, Field, Tag

from swtstudy.vocabulary.accuracy import DEFAULT_RTOL, LARGEST_RTOL, SMALLEST_RTOL


class _Table(BaseModel):
    model_config = ConfigDict(extra="forbid", strict=True, frozen=True)


class RangeTable(_Table):
    """Values of an axis in equal steps or equal ratios, both ends included."""

    start: Any
    stop: Any
    num: int
    spacing: Literal["linear", "log"] = "linear"
    also: list[Any] = []


def _axis_kind(raw: object) -> str:
    return "range" if isinstance(raw, dict) else "list"


Axis = Annotated[
    Annotated[list[Any], Tag("list")] | Annotated[RangeTable, Tag("range")], Discriminator(_axis_kind)
]


class SampleTable(_Table):
    """Parameters that vary together: a design of points in ranges, or given points."""

    design: Literal["sobol", "latin_hypercube", "random", "saltelli"] | None = None
    size: int | None = None
    seed: int = 0
    ranges: dict[str, Any] = {}
    file: str | None = None
    points: dict[str, list[Any]] = {}


class FigureTable(_Table):
    """The layout of the figure: x, hue, vertical and panels are dimensions of the study."""

    kind: Literal["lines", "life", "contour", "heatmap", "scatter", "histogram"] = "lines"
    x: str
    vertical: str | None = None
    hue: str | None = None
    panels: str | None = None
    y: str | list[str] = "s"
    title: str | None = None
    regimes: bool = False
    validity: bool = False


class LoadTable(_Table):
    """A loop of loads: its vertices, its harmonics, or the file of a signal."""

    vertices: Any = None
    file: str | None = None
    normal: Any = None
    tangential: Any = None
    bulk: Any = None
    mean_normal: Any = None
    # Checked where the signal is read.
    columns: Any = None
    absolute: Any = None
    separator: Any = None
    decimal: Any = None
    time: Any = None
    recorded_cycles: Any = None
    period: Any = None
    harmonics: Any = None
    keep_cycles: bool = False


class BlockTable(_Table):
    """A block of a sequence: rounds of a load."""

    load: str
    rounds: Any


class ProfileTable(_Table):
    """A profile as a table: its radii and heights, or the file that has them."""

    radius: Any = None
    height: Any = None
    file: str | None = None
    smoothing: Any = None
    geometry: Any = "axisymmetric"
    # Checked where the file is read.
    columns: Any = None
    separator: Any = None
    decimal: Any = None
    two_sided: bool = False
    level: bool = True


class StudyTable(_Table):
    """A study file."""

    title: str = Field(min_length=1)
    rtol: float = Field(default=DEFAULT_RTOL, ge=SMALLEST_RTOL, le=LARGEST_RTOL)
    # Checked against the table of quantities.
    quantities: Any = []
    fixed: dict[str, Any] = {}
    axes: dict[str, Axis] = {}
    sample: SampleTable | None = None
    # Checked where units and constants are read.
    units: dict[str, Any] | None = None
    material: dict[str, Any] | None = None
    loads: dict[str, LoadTable] = {}
    profiles: dict[str, ProfileTable] = {}
    blocks: list[BlockTable] = []
    figure: FigureTable | None = None
