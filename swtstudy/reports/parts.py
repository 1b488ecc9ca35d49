"""Pieces of HTML; whoever calls them escapes what an archive says."""

from __future__ import annotations

import json
from collections.abc import Iterable, Sequence
from html import escape
from importlib.resources import files
from typing import Any, NamedTuple

from swtstudy.reports.pictures import Picture

#: A dot: without an icon, browsers ask the place where a page lies for one.
_ICON = (
    "data:image/svg+xml,%3Csvg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 16 16'%3E"
    "%3Ccircle cx='8' cy='8' r='7' fill='%230072b2'/%3E%3C/svg%3E"
)


class Section(NamedTuple):
    """A part of a page.

    Attributes
    ----------
    name
        Its address in the page.
    title
        Its heading, HTML.
    body
        Its content, HTML; empty where there is nothing to say.
    live
        Whether it is for scripts alone.
    """

    name: str
    title: str
    body: str
    live: bool = False

    @property
    def html(self) -> str:
        """The section with its heading."""
        hidden = " data-script hidden" if self.live else ""
        return f'<section id="{self.name}"{hidden}>\n<h2>{self.title}</h2>\n{self.body}\n</section>'

    @property
    def link(self) -> str:
        """A link to it."""
        return f'<a href="#{self.name}"{" data-script hidden" if self.live else ""}>{self.title}</a>'


def section(name: str, title: str, *parts: str) -> Section:
    """A section of several parts, some of which may be empty."""
    return Section(name, title, "\n".join(filter(None, parts)))


def table(
    head: Sequence[str], rows: Iterable[Sequence[str]], numbers: Sequence[int] = (), wide: bool = False
) -> str:
    """A table; columns of numbers are set flush right."""

    def cells(row: Sequence[str], kind: str) -> str:
        marks = (' class="n"' if index in numbers else "" for index in range(len(row)))
        return "".join(f"<{kind}{mark}>{cell}</{kind}>" for mark, cell in zip(marks, row, strict=True))

    body = "\n".join(f"<tr>{cells(row, 'td')}</tr>" for row in rows)
    top = f"<thead><tr>{cells(head, 'th')}</tr></thead>" if any(head) else ""
    look = ' class="wide"' if wide else ""
    return f'<div class="scroll"><table{look}>{top}<tbody>\n{body}\n</tbody></table></div>'


def figure(picture: Picture, words: str, caption: str = "", name: str = "") -> str:
    """A picture on paper, as wide as it is drawn; `words` say it to those who do not see it."""
    own = f' id="{name}"' if name else ""
    room = f"max-width:{round(1.4 * picture.width)}px;min-width:{round(min(0.75 * picture.width, 560))}px"
    image = f'<img src="{picture.source}" {picture.size} alt="{escape(words)}">'
    below = f"<figcaption>{caption}</figcaption>" if caption else ""
    plot = f'<div class="plot"{own} style="{room}">{image}</div>'
    return f'<figure><div class="paper">{plot}</div>{below}</figure>'


def code(text: str) -> str:
    """Lines as they are."""
    return f"<pre><code>{escape(text)}</code></pre>"


def data(name: str, content: Any) -> str:
    """Values for the scripts of a page; nothing in them can end their element."""
    text = json.dumps(content, ensure_ascii=False, separators=(",", ":"))
    for sign in "<>&":
        text = text.replace(sign, f"\\u{ord(sign):04x}")
    return f'<script type="application/json" id="{name}">{text}</script>'


def whole(title: str, body: str, script: bool = False) -> str:
    """A page that needs no other file."""
    style, act = (
        files("swtstudy.reports").joinpath(f"page.{end}").read_text("utf-8") for end in ("css", "js")
    )
    return "\n".join(
        (
            "<!DOCTYPE html>",
            '<html lang="en">',
            "<head>",
            '<meta charset="utf-8">',
            '<meta name="viewport" content="width=device-width, initial-scale=1">',
            f"<title>{escape(title)}</title>",
            f'<link rel="icon" href="{_ICON}">',
            f"<style>\n{style}</style>",
            "</head>",
            "<body>",
            body,
            *([f"<script>\n{act}</script>"] if script else []),
            "</body>",
            "</html>\n",
        )
    )
