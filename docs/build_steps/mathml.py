"""Formulae as MathML, by docutils: browsers draw it themselves, without a script from elsewhere."""

import re
from typing import Any

from docutils import nodes
from docutils.utils.math import latex2mathml
from sphinx.application import Sphinx
from sphinx.writers.html5 import HTML5Translator

#: Without these browsers take a bar for a relation, with spaces around it: |τ | for |τ|.
_BAR, _TIGHT = '<mo stretchy="false">|</mo>', '<mo stretchy="false" lspace="0" rspace="0">|</mo>'
_CLOSE = 'lspace="0" rspace="0"'
_THIN = '<mspace width="0.1667em"></mspace>'
_NAME = r"<mi>(?:sin|cos|tan|arcsin|arccos|ln|log)</mi>"
#: Between what is multiplied by a function and its name, and between that and an argument without brackets.
_BEFORE = re.compile(rf"((?:</m(?:i|n|sub|sup|frac)>|>\)</mo>)\s*)(?=(?:<msup>\s*)?{_NAME})")
_AFTER = re.compile(
    rf"({_NAME}(?:\s*<mn>\d</mn>\s*</msup>)?+(?:\s*<mo>&ApplyFunction;</mo>)?+\s*)(?=<m(?:i|n|sub|sup|frac)>)"
)
_DEFINED = re.compile(r"<mo>∶</mo>\s*<mo>=</mo>")
#: Of digits after them docutils makes the wrong fraction, without a word.
_BARE = re.compile(r"\\[td]?frac\s*(?:\d|\{[^{}]*\}\s*\d)")
#: The font's primes are raised as they are.
_PRIMES = re.compile(r"(<mi>\w</mi>)((?:\s*<mo>'</mo>)+)")

#: A formula in a line, with what stands at it without a blank.
_IN_LINE = r'<math(?![^>]*display="block")[^>]*>(?:(?!</math>).)*</math>'
_TIED = re.compile(rf"[(\[]{_IN_LINE}[.,;:!?)\]]*|{_IN_LINE}[.,;:!?)\]]+", re.DOTALL)


def mathml(text: str, as_block: bool = False) -> str:
    """MathML of a formula in LaTeX, with its spaces and its primes."""
    if bare := _BARE.search(text):
        raise ValueError(f"found {bare[0]} in {text}; allowed: both parts of a fraction in braces")
    found = latex2mathml.tex2mathml(text, as_block=as_block).replace(_BAR, _TIGHT)
    for place in (_BEFORE, _AFTER):
        found = place.sub(rf"\1{_THIN}", found)
    found = _DEFINED.sub("<mo>:=</mo>", found)
    return _PRIMES.sub(lambda each: f"{each[1]}<mo {_CLOSE}>{' ′″'[each[2].count('<mo>')]}</mo>", found)


def _inline(writer: HTML5Translator, node: nodes.math) -> None:
    writer.body.append(mathml(node.astext()))
    raise nodes.SkipNode


def _block(writer: HTML5Translator, node: nodes.math_block) -> None:
    writer.body.append(f"<div>{mathml(node.astext(), as_block=True)}</div>\n")
    raise nodes.SkipNode


def tied(html: str) -> str:
    """A page on which no bracket and no full stop stands alone at the end or the beginning of a line."""
    return _TIED.sub(lambda found: f'<span class="tied">{found[0]}</span>', html)


def _tie(_app: Sphinx, _page: str, _template: str, context: dict[str, Any], _tree: object) -> None:
    if "body" in context:
        context["body"] = tied(context["body"])


def setup(app: Sphinx) -> dict[str, bool]:
    """Register the renderer as "mathml"; pages keep formulae and their full stops together."""
    app.add_html_math_renderer("mathml", (_inline, None), (_block, None))
    app.connect("html-page-context", _tie)
    return {"parallel_read_safe": True}
