"""The sections of a page: what was found, and how sure it is."""

from __future__ import annotations

from collections.abc import Iterator
from html import escape

import numpy as np
import xarray as xr

from swtstudy.archive.describe import (
    accuracy,
    completeness,
    failures,
    recorded_loads,
    regime_counts,
    relative_errors,
    scatter_words,
    unsaid,
)
from swtstudy.figures.evaluated import draw_sensitivity
from swtstudy.figures.quantity_words import is_life
from swtstudy.points.values import index_at
from swtstudy.reports.findings import along, extreme_points, levers, measured, measured_at
from swtstudy.reports.parts import Section, embedded, figure, of_point, section, table
from swtstudy.reports.values import place_html, share, symbol_html, symbol_of, value_text, with_unit
from swtstudy.units.reading import read_contact
from swtstudy.units.results import KINDS, measures
from swtstudy.vocabulary.mistakes import StudyError
from swtstudy.vocabulary.parameters import AXES
from swtstudy.vocabulary.variables import COMPUTED, CONTACT, has_units
from swtstudy.vocabulary.wording import number_words

#: Lives at the worst point.
_LIVES = tuple(kind.life for kind in KINDS.values() if kind.life)
#: Most rows of a table of extrema, failed points and values of an axis that are listed one by one.
_ROWS, _FAILURES, _LISTED = 12, 12, 8


def tiles(dataset: xr.Dataset) -> str:
    """The four numbers that one asks for first."""
    relative, values = relative_errors(dataset), measured(dataset)
    known = (np.isfinite(values) & (dataset.status == COMPUTED)).any(
        [dim for dim in values.dims if dim not in dataset.s.dims]
    )
    shape, missing = " × ".join(map(str, known.shape)) or "one", int((~known).sum())
    found = [("points", f"{known.size:,}".replace(",", " "), f"{shape}, {missing or 'none'} without a value")]
    for end, one in _ends(dataset):
        where = ", ".join(place_html(one[name]) for name in _varying(dataset))
        own = dict.fromkeys((*measures(one), *(n for n in one if n in _LIVES), measured(one).name))
        for value in [one[name] for name in own] if values.size == 1 and has_units(one) else [measured(one)]:
            words = with_unit(number_words(float(value)), value)
            found.append((f"{end} {symbol_of(value)}".strip(), words, where))
    if relative.size:
        largest, middle = (share(float(each)) for each in (relative.max(), np.median(relative)))
        words = f"estimated, half of them below {middle}" if middle != largest else "estimated"
        found.append(("relative error, at most", largest, words))
    each = (f"<div><dt>{a}</dt><dd>{b}<small>{c}</small></dd></div>" for a, b, c in found)
    return f'<dl class="tiles">{"".join(each)}</dl>'


def _ends(dataset: xr.Dataset) -> Iterator[tuple[str, xr.Dataset]]:
    """The points of `extreme_points`, each with its word; none where all points have one value."""
    points = extreme_points(dataset)
    life = is_life(measured(dataset).attrs)
    words = {"best": "longest", "worst": "shortest"} if life else {"best": "lowest", "worst": "highest"}
    for word, one in points.items():
        yield words[word] if len(points) > 1 else "", one


def _varying(dataset: xr.Dataset) -> list[str]:
    """Names of the parameters that differ from point to point."""
    dims = {*map(str, dataset.s.dims)}
    names = (str(name) for name, values in dataset.coords.items() if {*map(str, values.dims)} & dims)
    return [name for name in names if name in AXES and dataset[name].size > 1]


def extrema_section(dataset: xr.Dataset) -> Section:
    """Lowest and highest values along every dimension, for each place of the others."""
    return section("extremes", "Extremes", *_extrema_tables(dataset))


def _extrema_tables(dataset: xr.Dataset) -> Iterator[str]:
    symbol = symbol_of(measured(dataset))
    for lever in levers(dataset):
        ratio = lever.table.ratio
        others = [str(name) for name in ratio.dims]
        order = np.argsort(-np.nan_to_num(ratio.values.ravel(), nan=-1.0, posinf=-0.5), kind="stable")
        rows = []
        if len(order) > _ROWS:
            known = order[np.isfinite(ratio.values.ravel()[order])]
            order = known[[0, len(known) // 2, -1]]
        for flat in order:
            one = lever.table.isel(index_at(ratio, int(flat)))
            cells = [along(name, one[name]) for name in others]
            for end in ("minimum", "maximum"):
                value = with_unit(number_words(float(one[end])), measured_at(dataset, one))
                cells += [value, along(lever.name, one[f"at_{end}"])]
            rows.append([*cells, number_words(float(one.ratio), 3)])
        own = symbol_of(dataset[lever.name])
        head = [symbol_of(dataset[name]) for name in others]
        head += [f"lowest {symbol}", f"at {own}", f"highest {symbol}", f"at {own}", "ratio"]
        count = len(others)
        more = f": of {ratio.size} ratios the largest, the middle and the smallest" * (ratio.size > len(rows))
        yield f"<h3>Along {own}, {escape(AXES[lever.name].meaning)}{more}</h3>"
        yield table(head, rows, numbers=(count, count + 2, count + 4))


def points_section(dataset: xr.Dataset) -> Section:
    """The best and the worst point, as `swtstudy.inspect` draws them."""
    parts = []
    for end, one in _ends(dataset):
        where = ", ".join(place_html(one[name]) for name in _varying(dataset))
        own = f"{'The ' * bool(end)}{end} {symbol_of(measured(one))}".strip()
        title = f"<h3>{own}: {where}</h3>" if where else ""
        try:
            picture = of_point(one)
        except StudyError as error:
            parts.append(f'{title}<p class="note">Not drawn: {escape(str(error))}</p>')
            continue
        words = f"Load path, slip, springs, tractions, stress cycle and swt of the {end} point"
        parts.append(f"<div>{title}{_point_line(one)}{figure(picture, words)}</div>")
    body = f'<div class="points">{"".join(parts)}</div>' if parts else ""
    return section("points", "Best and worst" if len(parts) > 1 else "The point", body)


def _point_line(one: xr.Dataset) -> str:
    """Describe the results of one point in a line."""
    said = [f"<i>s</i> = {number_words(float(one.s))} ± {number_words(float(one.s_error), 2)}"]
    place = "critical_position" if "critical_position" in one else "critical_x"
    lives = [n for n in map(str, one) if is_life(one[n].attrs) or n.startswith("failure_probability")]
    names = (*measures(one), *lives, place, "critical_angle")
    known = (one[name] for name in names if name in one and not one[name].ndim)
    said += [place_html(values) for values in known if np.isfinite(values.item())]
    said.append(escape(one.regime.attrs["flag_meanings"].split()[int(one.regime)].replace("_", " ")))
    return f"<p>{'; '.join(said)}.</p>"


def settings_section(dataset: xr.Dataset) -> Section:
    """Every parameter with its symbol, values and unit."""
    rows: list[tuple[str, str, str, str]] = []
    for name in [*map(str, dataset.s.dims), *map(str, dataset.coords)]:
        hidden = ("body", "direction", *unsaid(dataset), *(row[0] for row in rows))
        if name in AXES and name not in hidden:
            values = dataset[name]
            own = "<b>{}</b>" if values.size > 1 else "{}"
            said = own.format(with_unit(_values(name, values), values))
            symbol = "" if AXES[name].kind == "name" else symbol_of(values)
            rows.append((name, symbol, escape(AXES[name].meaning), said))
    rows += [("", "", f"load {escape(load)}", escape(words)) for load, words in recorded_loads(dataset)]
    control = escape(str(dataset.control.item())) if "control" in dataset.coords else ""
    body = table(("symbol", "parameter", "value"), [row[1:] for row in rows], wide=True)
    note = f'<p class="note">Prescribed: {control}.{_units_note(dataset)}</p>'
    return section("settings", "Settings", note, body, *_materials(dataset))


def _units_note(dataset: xr.Dataset) -> str:
    length = "<i>a</i><sub>H</sub> = √(<i>R</i><i>δ</i><sub>0</sub>)"
    return "" if has_units(dataset) else f" Lengths are in {length}."


def _values(name: str, values: xr.DataArray) -> str:
    known = np.atleast_1d(values.values)
    if len(known) > _LISTED and known.dtype.kind in "fiu":
        ends = (value_text(name, float(end), values.attrs) for end in (known.min(), known.max()))
        return f"{' to '.join(ends)} ({len(np.unique(known))} values)"
    return ", ".join(dict.fromkeys(value_text(name, value, values.attrs) for value in known.tolist()))


def _materials(dataset: xr.Dataset) -> Iterator[str]:
    if has_units(dataset):
        given = read_contact(dataset.attrs[CONTACT])
        for title, several in (
            ("Strain-life constants", given.materials),
            ("Strain-life constants in torsion", given.shear_materials),
        ):
            for material in dict.fromkeys(several):
                rows = [
                    (
                        escape(name.replace("_", " ")),
                        f"{value_text(name, v)} {_unit_of_constant(dataset, name)}",
                    )
                    for name, v in vars(material).items()
                ]
                yield f"<h3>{title}</h3>" + table(("", ""), rows, numbers=(1,))
        if given.scatter:
            yield f"<h3>Scatter</h3><p>{escape(scatter_words(given.scatter))}.</p>"
        limits = {"yield_strength": given.yield_strengths, "findley_limit": given.findley_limits}
        rows = [
            (name.replace("_", " "), f"{value_text(name, value)} {given.units.stress}")
            for name, both in limits.items()
            for value in dict.fromkeys(both)
        ]
        if rows:
            yield "<h3>Limits of the stress</h3>" + table(("", ""), rows, numbers=(1,))


def _unit_of_constant(dataset: xr.Dataset, name: str) -> str:
    """The unit of a constant of a material: that of stresses, or none."""
    stress = name.endswith(("modulus", "strength"))
    return escape(str(dataset.peak_pressure.attrs["units"])) if stress and "peak_pressure" in dataset else ""


def sureness_section(dataset: xr.Dataset, validity: list[str]) -> Section:
    """Errors, regimes, failed points, and what limits the model."""
    counts = regime_counts(dataset)
    total = sum(counts.values())
    shares = [(name.replace("_", " "), count / total) for name, count in counts.items()]
    bar = "".join(
        f'<span class="b{i % 7}" style="flex:{part:.5f}"></span>' for i, (_, part) in enumerate(shares)
    )
    key = "".join(
        f'<li><i class="box b{i % 7}"></i>{escape(name)}, {share(part)}</li>'
        for i, (name, part) in enumerate(shares)
    )
    regimes = f'<h3>Regimes</h3><div class="bar">{bar}</div><ul class="key">{key}</ul>' if total else ""
    lines = "".join(f"<li>{escape(line)}</li>" for line in validity)
    return section(
        "sure",
        "How sure",
        f"<p>{_capital(escape(accuracy(dataset)))}. Points: {escape(completeness(dataset))}.</p>",
        f"<h3>Where the model holds</h3><ul>{lines}</ul>" if validity else "",
        regimes,
        _failed(dataset),
    )


def _capital(words: str) -> str:
    return words[:1].upper() + words[1:]


def _failed(dataset: xr.Dataset) -> str:
    failed = [*failures(dataset)]
    if not failed:
        return ""
    rows = [(escape(where), escape(why)) for where, why in failed[:_FAILURES]]
    more = f'<p class="note">and {len(failed) - _FAILURES} more.</p>' if len(failed) > _FAILURES else ""
    return f"<h3>Failed points</h3>{table(('point', 'why'), rows)}{more}"


def sensitivity_section(dataset: xr.Dataset, indices: xr.Dataset | StudyError | None) -> Section:
    """Sobol indices of a sample whose design has them; see `swtstudy.reports.findings.indices_of`."""
    if not isinstance(indices, xr.Dataset):
        note = f'<p class="note">No indices: {escape(str(indices))}</p>' if indices else ""
        return section("matters", "What matters", note)
    axes = [str(dim) for dim in indices.total.dims if dim not in ("quantity", "parameter")]
    flat = indices.isel(quantity=0).stack(place=[*axes, "parameter"]) if axes else indices.isel(quantity=0)
    rows = []
    for k in range(flat.total.size):
        one = flat.isel({flat.total.dims[0]: k})
        cells = [along(name, dataset[name].sel({name: one[name].item()})) for name in axes]
        cells += [symbol_html(str(one.symbol.item())), escape(AXES[str(one.parameter.item())].meaning)]
        for name in ("first_order", "total"):
            low, high = (float(one[f"{name}_{end}"]) for end in ("low", "high"))
            cells.append(f"{float(one[name]):.2f} ({low:.2f} to {high:.2f})")
        rows.append(cells)
    head = [symbol_of(dataset[name]) for name in axes] + ["", "parameter", "alone", "with others"]
    y = str(indices["quantity"].values[0])
    symbol = "<i>s</i>" if y == "s" else symbol_of(dataset[y])
    words = f"Sobol indices: the share of the variance of {symbol} that each parameter is responsible for."
    picture = figure(embedded(draw_sensitivity(indices)), "Bars of the Sobol indices in the table")
    return section("matters", "What matters", f"<p>{words}</p>", picture, table(head, rows))
