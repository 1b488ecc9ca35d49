"""The layout of a study's figure: which dimension goes where, and which quantity is drawn."""

from __future__ import annotations

import json
import re
import unicodedata
from collections.abc import Iterator
from dataclasses import asdict, dataclass

from swtstudy.points.values import Value, read_exact, read_value
from swtstudy.vocabulary.axes import AXES
from swtstudy.vocabulary.parameters import LETTERS

_NORMALISED = re.compile(r"s\s*/\s*s\s*\(\s*(\w+)\s*=\s*([^()]+|[^()]*\([^()]*\)[^()]*)\)")

#: Kinds of figures of a sample: points over each of its parameters, or how often there are which values.
SAMPLE_KINDS = ("scatter", "histogram")
#: Kinds of lines: over x, or x upright over the quantity, as S–N curves are drawn.
LINE_KINDS = ("lines", "life")
#: Kinds of figures: lines, a surface over x and vertical, or those of a sample.
KINDS = (*LINE_KINDS, "contour", "heatmap", *SAMPLE_KINDS)

#: The data variables of an archive.
VARIABLES = ("s", "s_error", "critical_x", "critical_angle", "regime", "s_surface", "status", "run")

#: What else a figure may show.
QUANTITY = '"s/s(name=value)"'


@dataclass(frozen=True)
class FigureLayout:
    """Layout of a figure.

    Attributes
    ----------
    x
        Dimension along the horizontal axis; "sample" for a figure of a sample.
    hue
        Dimension whose values are the lines, or None for one line.
    panels
        Dimension whose values are the panels side by side, or None for one panel.
    y
        Quantities, with a row of panels each: the name of a data variable, such as "s" or "critical_x", or
        "s/s(name=value)" for s over its value at one place, with the name or the symbol of a parameter.
    title
        Title over the figure, or None.
    kind
        "lines"; "life", lines with x upright over a logarithmic axis of the quantity, as S–N curves;
        "contour", which for s also shows where it is least and greatest along x; or "heatmap", with a cell
        for each point; or, of a sample, "scatter", with a panel for each of its parameters, or "histogram".
    vertical
        Dimension along the vertical axis of a contour or heat map, None for lines.
    regimes
        Whether to mark where a regime of the contact begins along a line, or the borders of regimes on a
        contour map.
    validity
        Whether to mark the points that are outside of what the model holds for.
    caption
        What there is to say beneath it, in reports; or None.
    """

    x: str
    hue: str | None = None
    panels: str | None = None
    y: tuple[str, ...] = ("s",)
    title: str | None = None
    kind: str = "lines"
    vertical: str | None = None
    regimes: bool = False
    validity: bool = False
    caption: str | None = None

    def to_json(self) -> str:
        """The layout as text, for an archive."""
        return json.dumps(asdict(self))

    @classmethod
    def from_json(cls, text: str) -> FigureLayout:
        """The layout from its text in an archive."""
        raw = json.loads(text)
        return cls(**{**raw, "y": tuple(raw["y"])})

    def roles(self) -> Iterator[tuple[str, str]]:
        """Role and name of every dimension that is used."""
        for role in ("x", "vertical", "hue", "panels"):
            name = getattr(self, role)
            if name is not None:
                yield role, name


def reference(y: str) -> tuple[str, Value] | None:
    """Parameter and value of the place that normalises a quantity; None for a data variable.

    Raises
    ------
    ValueError
        If the text is neither; the message gives the reason.

    Examples
    --------
    >>> reference("s/s(flat_radius=0)")
    ('flat_radius', 0.0)
    >>> reference("s/s(b=0)")
    ('flat_radius', 0.0)
    """
    if y.strip().isidentifier():
        return None
    match = _NORMALISED.fullmatch(y.strip())
    if match is None:
        raise ValueError("not a quantity")
    name, raw = match.groups()
    name = LETTERS.get(unicodedata.normalize("NFKC", name), name)  # a keyboard's µ is not the letter μ
    if name not in AXES:
        raise ValueError(f"unknown parameter {name}")
    if AXES[name].kind == "name":
        return name, raw.strip()  # what results or a study define has names of its own
    if AXES[name].scale or AXES[name].part == "contact":
        return name, float(read_exact(raw.strip()))  # whose range depends on its unit
    return name, read_value(AXES[name], raw.strip())
