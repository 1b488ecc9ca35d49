"""Symbols and values as HTML; everything that an archive says is escaped."""

from __future__ import annotations

import math
import re
import unicodedata
from collections.abc import Iterator
from html import escape
from typing import TYPE_CHECKING, Any

from swtstudy.vocabulary.axes import AXES
from swtstudy.vocabulary.wording import number_words, value_words

if TYPE_CHECKING:
    import xarray as xr

_TOKENS = re.compile(r"\\([a-zA-Z]+|.)|([{}_^])|(\s+)|([A-Za-z])|(.)", re.DOTALL)
_SIGNS = {"ell": "<i>ℓ</i>", "cdot": "·", "infty": "∞", "approx": "≈", ",": " ", ";": " ", " ": " "}
#: What has another letter in Unicode's names than in LaTeX.
_GREEK = {"lambda": "lamda", "varphi": "phi", "varepsilon": "epsilon", "vartheta": "theta"}


def symbol_html(latex: str) -> str:
    """A symbol in LaTeX's notation as HTML.

    Examples
    --------
    >>> symbol_html(r"\\delta_A/\\delta_0")
    '<i>δ</i><sub><i>A</i></sub>/<i>δ</i><sub>0</sub>'
    >>> symbol_html(r"a_\\mathrm{max}")
    '<i>a</i><sub>max</sub>'
    """
    return "".join(_run(_tokens(latex), False))


def _tokens(latex: str) -> Iterator[tuple[str | None, ...]]:
    return (found.groups() for found in _TOKENS.finditer(latex))


def _run(tokens: Iterator[tuple[str | None, ...]], upright: bool) -> Iterator[str]:
    """The pieces up to the end of a group."""
    for token in tokens:
        if token[1] == "}":
            return
        yield _piece(token, tokens, upright)


def _piece(token: tuple[str | None, ...], rest: Iterator[tuple[str | None, ...]], upright: bool) -> str:
    """One letter, command or group, with what belongs to it."""
    command, brace, blank, letter, other = token
    if command:
        return _command(command, rest, upright)
    if brace == "{":
        return "".join(_run(rest, upright))
    if brace in ("_", "^"):
        name = "sub" if brace == "_" else "sup"
        after = next(rest, None)
        return f"<{name}>{_piece(after, rest, upright)}</{name}>" if after else ""
    if letter:
        return letter if upright else f"<i>{letter}</i>"
    return "" if blank or brace else escape("−" if other == "-" else str(other))


def _command(name: str, rest: Iterator[tuple[str | None, ...]], upright: bool) -> str:
    if name in _SIGNS:
        return _SIGNS[name]
    if name in ("mathrm", "text", "sqrt"):
        after = next(rest, None)
        inner = _piece(after, rest, upright or name != "sqrt") if after else ""
        return f"√({inner})" if name == "sqrt" else inner
    small = name.lower()
    kind = "CAPITAL" if name[0].isupper() else "SMALL"
    try:
        return f"<i>{unicodedata.lookup(f'GREEK {kind} LETTER {_GREEK.get(small, small).upper()}')}</i>"
    except KeyError:
        return f"{escape(name)} "  # a function, such as max


def symbol_of(values: xr.DataArray) -> str:
    """The symbol of a coordinate or data variable as HTML; its name in words if it has none."""
    name = str(values.name)
    latex = values.attrs.get("symbol", AXES[name].symbol if name in AXES else "")
    return tied(symbol_html(str(latex))) if latex else escape(name.replace("_", " "))


def tied(words: str) -> str:
    """HTML that keeps to one line."""
    return f'<span class="tied">{words}</span>'


def unit_of(values: xr.DataArray) -> str:
    """The unit of a coordinate or data variable; empty if it has none, or if its values say it."""
    unit = str(values.attrs.get("units", ""))
    return "" if unit in ("", "1", "rad") else {"degree": "°"}.get(unit, unit)


def value_text(name: str, value: Any) -> str:
    """A value as people say it: as `swtstudy.vocabulary.wording.value_words`, and every angle in π.

    Examples
    --------
    >>> value_text("phase", 2.7052603405912108), value_text("normal_amplitude", 8 / 9)
    ('0.861π', '8/9')
    """
    if isinstance(value, float) and not math.isfinite(value):
        return "–"
    if name not in AXES or isinstance(value, bool):
        return number_words(value) if isinstance(value, float) else str(value)
    words = value_words(name, value)
    if AXES[name].units == "rad" and "π" not in words and value:
        return f"{value / math.pi:.3g}π"
    return words


def place_html(values: xr.DataArray) -> str:
    """A single value with symbol and unit; the value alone of a name."""
    name, value = str(values.name), values.item()
    words = escape(" ".join(filter(None, (value_text(name, value), unit_of(values)))))
    return words if isinstance(value, str) else tied(f"{symbol_of(values)} = {words}")


def share(part: float) -> str:
    """A share in per cent.

    Examples
    --------
    >>> share(0.5), share(0.9996), share(9e-5)
    ('50 %', '99.96 %', '0.009 %')
    """
    percent = 100.0 * part
    digits = 0 if percent in (0.0, 100.0) else max(0, -math.floor(math.log10(min(percent, 100 - percent))))
    return f"{percent:.{digits}f} %"
