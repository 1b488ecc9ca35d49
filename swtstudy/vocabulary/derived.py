"""The table of data variables that results of real contacts have besides: with units, and lives.

The door out (`swtstudy.study.units.results`), figures and messages read it; none repeats a name.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator
from typing import NamedTuple

from swtstudy.vocabulary.choices import CRITERIA, Criterion, with_values_of
from swtstudy.vocabulary.files import read_table
from swtstudy.vocabulary.quantities import ATTRIBUTES, DISTANCE, EVERY_VARIABLE, NONLOCAL, Request, error_of

#: Per cent of the bodies that have a crack before the life of that name.
PERCENTS = (10, 50, 90)
#: Kinds of variables: a life, and variables that blocks and constants that scatter make of it.
LIFE, REPETITIONS, SHARE, FAILED = "cycles", "repetitions", "damage_share", "failure_probability"
RANKS = (*map(str, PERCENTS), FAILED)


class Derived(NamedTuple):
    """One data variable.

    Attributes
    ----------
    name, symbol, meaning
        As of a `swtstudy.vocabulary.quantities.Quantity`; ``{radius}``, ``{mean}``, ``{shear}`` and
        ``{target}`` in the meaning stand for words that depend on the contacts.
    unit
        "length", "force", "stress", "work", or "1".
    scale
        Name of its factor, or of its value, among the properties of a contact at rest.
    of
        The data variable that it is made of, without units or a life; empty for what a contact at rest has.
    needs
        The facts of contacts without which it is not there: one of them is needed.
    criterion
        Its criterion; empty for a variable of every criterion.
    kind
        `LIFE`, `REPETITIONS`, `SHARE`, or one of `RANKS`; else empty.
    """

    name: str
    symbol: str
    meaning: str
    unit: str = "1"
    scale: str = ""
    of: str = ""
    needs: tuple[str, ...] = ()
    criterion: str = ""
    kind: str = ""


def _indexed(letter: str, *parts: str) -> str:
    """A symbol with an index of some parts, of which some may be empty."""
    index = ", ".join(filter(None, parts))
    return rf"{letter}_\mathrm{{{index}}}" if index else letter


def _meaning(row: Criterion, of: str) -> str:
    """Words for the values of a criterion: at the worst point, or a mean of them."""
    return row.values if of == "s" else with_values_of(NONLOCAL[of].meaning, row.values)


def _by(row: Criterion, of: str) -> str:
    """Words for what a life is by, behind it; empty at the worst point by SWT."""
    return f" by the {_meaning(row, of)}" * (of != "s") + "{shear}" * bool(row.by)


def _of_criterion(criterion: str, row: Criterion) -> Iterator[Derived]:
    """The values of s and of its means, their errors, lives, and usages of a limit."""
    for of, end in _ENDS.items():
        place = end.removeprefix("_")
        symbol, meaning = _indexed(row.sign, place), _meaning(row, of)
        name, scale = f"{row.name}{end}", (row.unit, row.scale)
        yield Derived(name, symbol, meaning, *scale, of, criterion=criterion)
        if row.limit:
            over = rf"{symbol}/f_\mathrm{{lim}}", f"{meaning} over its limit"
            yield Derived(f"{row.usage}{end}", *over, "1", "stress_scale", of, (row.limit,), criterion)
        if row.life:
            life = _indexed("N", row.subscript, place), f"load cycles to a crack{_by(row, of)}"
            yield Derived(f"{row.life}{end}", *life, "1", row.scale, of, row.constants, criterion, LIFE)
        error = error_of(name), rf"\Delta {symbol}", f"error of {meaning}"
        yield Derived(*error, *scale, error_of(of), criterion=criterion)


def _of_life(criterion: str, row: Criterion, of_value: str, end: str) -> Iterator[Derived]:
    """All that is made of a life: by blocks, and of constants that scatter.

    Blocks: repetitions of their sequence to a crack, and the share of each load in its damage. Constants that
    scatter: percentiles of the life, also in repetitions, and the probability of a crack before a target.
    """
    life, start, place = f"{row.life}{end}", row.life.removesuffix(LIFE), end.removeprefix("_")
    words = _by(row, of_value)
    for kind, symbol, meaning in (
        (REPETITIONS, _indexed("N", "seq", row.subscript, place), f"repetitions to a crack{words}"),
        (SHARE, "D_k/D", f"share of the damage{words}"),
    ):
        yield Derived(f"{start}{kind}{end}", symbol, meaning, of=life, needs=("blocks",), kind=kind)
    of = {"of": life, "criterion": criterion}
    for percent in map(str, PERCENTS):
        meaning = f"load cycles to a crack{words}, before which {percent} % fail"
        symbol = _indexed("N", row.subscript, place, percent)
        yield Derived(f"{life}_{percent}", symbol, meaning, needs=("scatter",), kind=percent, **of)
        meaning = f"repetitions to a crack{words}, before which {percent} % fail"
        symbol = _indexed("N", "seq", row.subscript, place, percent)
        name = f"{start}{REPETITIONS}{end}_{percent}"
        yield Derived(name, symbol, meaning, needs=("blocks",), kind=percent, **of)
    symbol, where = _indexed("P", row.subscript, place), f" by the {_meaning(row, of_value)}"
    meaning = f"probability of a crack before {{target}} load cycles{row.by},"
    meaning += where if place else " at the worst point"
    yield Derived(f"{start}{FAILED}{end}", symbol, meaning, needs=("target_life",), kind=FAILED, **of)


def _rows() -> Iterator[Derived]:
    """All rows: of each criterion, of every criterion alike, and lives by blocks and by scatter."""
    for criterion, row in CRITERIA.items():
        yield from _of_criterion(criterion, row)
    for name, alike in read_table(__file__, "derived").items():
        yield Derived(name, **alike)
    lives = [(name, row, *each) for name, row in CRITERIA.items() if row.life for each in _ENDS.items()]
    made = [each for life in lives for each in _of_life(*life)]
    yield from sorted(made, key=lambda each: each.kind in RANKS)  # by blocks first


#: Ends of names by what they are made of: s, and its means over a critical distance.
_ENDS = {"s": ""} | {name: name.removeprefix("s") for name, row in NONLOCAL.items() if not row.is_place}
#: By name.
DERIVED: dict[str, Derived] = {row.name: row for row in _rows()}
#: Names of all lives that there may be.
LIVES = tuple(name for name, row in DERIVED.items() if row.kind == LIFE)
#: Names without units, for variables whose names mean values with units in a study with units.
NORMALISED = {name: f"normalised_{name}" for name in (*EVERY_VARIABLE, *ATTRIBUTES) if name in DERIVED}
#: Words for the facts of contacts that data variables need.
_FACTS = {
    "materials": "fatigue constants ([material], swtstudy.FatigueConstants)",
    "yield_strengths": "a yield_strength",
    "findley_limits": "a findley_limit",
    "blocks": "blocks",
    "scatter": "constants that scatter",
    "target_life": "a target_life",
}


def lacking(name: str, facts: object, criteria: Collection[object], asked: Request) -> list[str]:
    """The facts that contacts lack for a data variable, in words; nothing for an unknown one.

    Parameters
    ----------
    name
        Name of the data variable.
    facts
        Has the facts of contacts as attributes, and no ``units`` where there are no contacts.
    criteria, asked
        The criteria of the points, and the request beside s.
    """
    row = DERIVED.get(name)
    if row is None:
        return []
    words = [] if hasattr(facts, "units") else ["units"]
    if row.needs and not any(getattr(facts, fact, ()) for fact in row.needs):
        words.append(_FACTS[row.needs[0]])
    if row.criterion and row.criterion not in map(str, criteria):
        words.append(f'the criterion "{row.criterion}"')
    if row.of in NONLOCAL and not asked.distances:
        words.append(f"a {DISTANCE}")
    of = "" if row.of == name else row.of  # a quantity has the name of its value without units
    return [*dict.fromkeys((*words, *lacking(of, facts, criteria, asked)))]


#: Names of all that results with units may have besides.
NAMES = (*DERIVED, *NORMALISED.values())
