"""What figures and Datasets show and say, as plain data, beside what is kept of them in `tests/data/kept`.

Numbers may differ by a thousandth. A change on purpose is kept with `pytest -n 0 --keep`, and read in the
diff; so are the texts of `tests/data`.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr
from folders import DATA
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.collections import Collection, LineCollection
from matplotlib.colors import to_hex
from matplotlib.container import ErrorbarContainer
from matplotlib.figure import Figure
from matplotlib.image import AxesImage
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.text import Annotation, Text

KEPT = DATA / "kept"
#: Values of which each is kept; of more some numbers that tell them apart are.
FEW = 6
#: Signs of a line of a file.
LINE = 200


class Kept:
    """The files of what is kept; with ``anew`` they are written, not compared."""

    def __init__(self, anew: bool) -> None:
        self.anew = anew

    def __call__(self, name: str, found: object) -> None:
        path = KEPT / f"{name}.json"
        if self.anew:
            path.parent.mkdir(exist_ok=True)
            path.write_text(lines_of(found) + "\n", encoding="utf-8")
        known = json.loads(path.read_text(encoding="utf-8"))
        apart = [*differences(json.loads(json.dumps(found)), known)]
        assert not apart, "\n".join(apart[:20])

    def text(self, path: Path, known: str, found: str) -> None:
        """Compare a part of a file of texts; with ``anew`` put what is found in its place, in one process."""
        if self.anew and found != known:
            path.write_text(path.read_text(encoding="utf-8").replace(known, found, 1), encoding="utf-8")
        else:
            assert found == known


def lines_of(value: Any, indent: str = "") -> str:
    """JSON in which what fits into a line is one."""
    whole = json.dumps(value, ensure_ascii=False)
    if len(indent + whole) <= LINE or not isinstance(value, dict | list):
        return whole
    deeper, named = f"{indent} ", isinstance(value, dict)
    heads = [f"{json.dumps(name, ensure_ascii=False)}: " for name in value] if named else [""] * len(value)
    parts = [
        head + lines_of(each, deeper)
        for head, each in zip(heads, value.values() if named else value, strict=True)
    ]
    begin, end = "{}" if named else "[]"
    return f"{begin}\n" + ",\n".join(f"{deeper}{part}" for part in parts) + f"\n{indent}{end}"


def differences(found: Any, known: Any, place: str = "") -> Iterator[str]:
    """Where two structures differ."""
    if isinstance(known, dict) and isinstance(found, dict) and [*found] == [*known]:
        for name in known:
            yield from differences(found[name], known[name], f"{place}/{name}")
    elif isinstance(known, list) and isinstance(found, list) and len(found) == len(known):
        for number, pair in enumerate(zip(found, known, strict=True)):
            yield from differences(*pair, f"{place}/{number}")
    elif isinstance(known, float) and isinstance(found, float):
        if found != pytest.approx(known, rel=1e-3, abs=1e-6, nan_ok=True):
            yield f"{place}: {found!r}, kept is {known!r}"
    elif found != known:
        yield f"{place}: {found!r}, kept is {known!r}"


def numbers(values: Any) -> list[float]:
    """Numbers one by one if they are few, else their count, ends, mean, mean square and first moment."""
    flat = np.ravel(np.ma.filled(np.ma.asarray(values, dtype=float), np.nan))
    if flat.size <= FEW:
        return [float(f"{each:.6g}") for each in flat]
    known = flat[np.isfinite(flat)]
    where = np.flatnonzero(np.isfinite(flat)) / flat.size
    means = (known.mean(), (known**2).mean(), (where * known).mean()) if known.size else (0.0,)
    sizes = (flat[0], flat[-1], *means)
    return [flat.size, known.size, *(float(f"{each:.6g}") for each in sizes)]


def colour(value: Any) -> str:
    return str(value) if isinstance(value, str) and value == "none" else to_hex(value, keep_alpha=True)


def _colours(values: Any) -> list[str]:
    return [*dict.fromkeys(colour(each) for each in values)][:FEW]


def _place(artist: Artist, axes: Axes | None) -> str:
    """What the coordinates of an artist are."""
    if axes is None:
        return ""
    known = {"data": axes.transData, "axes": axes.transAxes, "x data": axes.get_xaxis_transform()}
    return next((name for name, each in known.items() if artist.get_transform() == each), "")


def _text(text: Text, axes: Axes | None = None) -> dict[str, Any]:
    box = text.get_bbox_patch()
    said = {
        "text": text.get_text(),
        "at": numbers(text.get_position()),
        "of": _place(text, axes),
        "look": f"{text.get_ha()} {text.get_va()} {colour(text.get_color())} z{text.get_zorder():g}",
        "size": [float(text.get_fontsize()), float(text.get_rotation())],
    }
    if box:
        style = box.get_boxstyle()
        said["box"] = [type(style).__name__, style.pad, *map(colour, (box.get_fc(), box.get_ec()))]
        said["box"].append(box.get_linewidth())
    if isinstance(text, Annotation):
        said["from"], said["to"], said["in"] = numbers(text.xyann), numbers(text.xy), str(text.anncoords)
        if arrow := text.arrow_patch:
            head = f"{type(arrow.get_arrowstyle()).__name__} {colour(arrow.get_ec())}"
            said["arrow"] = [head, *map(float, (arrow.get_linewidth(), arrow.get_mutation_scale()))]
            said["arrow"] += [float(arrow.shrinkA), float(arrow.shrinkB)]
    return said


def line_of(line: Line2D, axes: Axes | None = None) -> dict[str, Any]:
    words = [str(line.get_label()), colour(line.get_color()), str(line.get_linestyle()), line.get_drawstyle()]
    words += [str(line.get_marker()), str(line.get_fillstyle()), colour(line.get_markerfacecolor())]
    words += [str(line.get_markevery()), "clipped" if line.get_clip_on() else "", _place(line, axes)]
    dashes = line._unscaled_dash_pattern  # type: ignore[attr-defined]
    sizes = [line.get_linewidth(), line.get_markersize(), line.get_markeredgewidth(), line.get_zorder()]
    x, y = line.get_xdata(), line.get_ydata()
    return {
        "look": " | ".join(words),
        "dashes": [float(dashes[0] or 0.0), *map(float, dashes[1] or ())],
        "sizes": [float(each) for each in (*sizes, 1.0 if line.get_alpha() is None else line.get_alpha())],
        "x": numbers(x) if np.asarray(x).dtype.kind in "fiub" else [*map(str, x)][:FEW],
        "y": numbers(y),
    }


def _collection(each: Collection) -> dict[str, Any]:
    paths = [path.vertices for path in each.get_paths()]
    said = {
        "kind": type(each).__name__,
        "label": str(each.get_label()),
        "colours": [*_colours(each.get_facecolor()), "/", *_colours(each.get_edgecolor())],
        "sizes": numbers([*np.unique(each.get_linewidths()), each.get_zorder(), each.get_alpha() or 1.0]),
        "paths": numbers(np.concatenate(paths)) if paths else [],
    }
    if each.get_array() is not None:
        said["values"], said["map"] = numbers(each.get_array()), str(each.get_cmap().name)
        said["norm"] = [type(each.norm).__name__, *numbers(getattr(each.norm, "boundaries", each.get_clim()))]
    if isinstance(each, LineCollection):
        said["ends"] = str(each.get_capstyle())
    return said


def _patch(patch: Patch) -> dict[str, Any]:
    look = [str(patch.get_label()), colour(patch.get_facecolor()), colour(patch.get_edgecolor())]
    look += [str(patch.get_linestyle()), str(patch.get_hatch()), f"z{patch.get_zorder():g}"]
    corners = patch.get_path().transformed(patch.get_patch_transform()).vertices
    return {"look": " | ".join(look), "width": float(patch.get_linewidth()), "at": numbers(corners)}


def _ticks(axis: Any) -> list[str]:
    """The words at ticks within the ends of an axis."""
    low, high = sorted(axis.get_view_interval())
    room = 1e-9 * (high - low)
    places = axis.get_majorticklocs()
    both = zip(places, axis.get_major_formatter().format_ticks(places), strict=True)
    return [words for place, words in both if low - room <= place <= high + room]


def _panel(axes: Axes) -> dict[str, Any]:
    said: dict[str, Any] = {
        "titles": [axes.get_title("left"), axes.get_title()],
        "labels": [axes.get_xlabel(), axes.get_ylabel()],
        "colour of label": colour(axes.yaxis.label.get_color()),
        "scales": [axes.get_xscale(), axes.get_yscale()],
        "ends": [*numbers(axes.get_xlim()), *numbers(axes.get_ylim())],
        "ticks": [_ticks(axes.xaxis), _ticks(axes.yaxis)],
        "size of ticks": [float(each.label1.get_fontsize()) for each in axes.yaxis.get_major_ticks()[:1]],
        "grid": [bool(axis._major_tick_kw.get("gridOn")) for axis in (axes.xaxis, axes.yaxis)],
        "frame": [axes.get_frame_on(), colour(axes.get_facecolor())],
        "aspect": str(axes.get_aspect()),
        "lines": [line_of(each, axes) for each in axes.lines],
        "texts": [_text(each, axes) for each in axes.texts],
        "collections": [_collection(each) for each in axes.collections],
        "patches": [_patch(each) for each in axes.patches],
        "bars": [
            numbers(each.get_segments())
            for c in axes.containers
            if isinstance(c, ErrorbarContainer)
            for each in c[2]
        ],
        "images": [_image(each) for each in axes.images],
        "insets": [_panel(each) for each in axes.child_axes],
    }
    if legend := axes.get_legend():
        said["legend"] = _legend(legend)
    return {name: each for name, each in said.items() if each not in ([], {})}


def _image(image: AxesImage) -> dict[str, Any]:
    return {
        "values": numbers(image.get_array()),
        "ends": numbers(image.get_extent()),
        "map": _colours(image.get_cmap().colors),
    }


def _legend(legend: Any) -> dict[str, Any]:
    sizes = [
        legend._ncols,
        legend.handlelength,
        legend.columnspacing,
        legend.borderaxespad,
        legend.labelspacing,
    ]
    return {
        "title": legend.get_title().get_text(),
        "texts": [each.get_text() for each in legend.get_texts()],
        "size": [float(each.get_fontsize()) for each in [*legend.get_texts()[:1], legend.get_title()]],
        "sizes": [float(each) for each in sizes],
        "place": str(legend._loc),
        "frame": bool(legend.get_frame_on()),
    }


def drawn(figure: Figure) -> dict[str, Any]:
    """All that a figure shows, but for its layout."""
    said = {
        "title": figure.get_suptitle(),
        "panels": [_panel(each) for each in figure.axes],
        "legends": [_legend(each) for each in figure.legends],
    }
    return said


def told(dataset: xr.Dataset) -> dict[str, Any]:
    """All that a Dataset holds and says."""
    return {
        "attributes": {str(k): v if isinstance(v, str) else numbers(v) for k, v in dataset.attrs.items()},
        **{
            str(name): _variable(each)
            for name, each in sorted(dataset.variables.items(), key=lambda e: str(e[0]))
        },
    }


def _variable(values: xr.Variable) -> dict[str, Any]:
    array = values.values
    said = [*map(str, np.ravel(array)[:FEW])] if array.dtype.kind in "OUS" else numbers(array)
    words = {
        str(name): v if isinstance(v, str) else [*map(str, np.ravel(v))] for name, v in values.attrs.items()
    }
    return {"over": " ".join(map(str, values.dims)), "kind": array.dtype.kind, "values": said, **words}
