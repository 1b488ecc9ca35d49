"""Statements of the paper: the rows of ``statements.toml``, each tested by a function of a file beside it."""

from __future__ import annotations

from dataclasses import dataclass, field
from pkgutil import resolve_name
from typing import Any, NamedTuple

import xarray as xr

from swtstudy.vocabulary.tables import read_table

#: A test's result: whether the statement holds, and the values for the words of the finding, by name.
Measured = tuple[Any, dict[str, Any]]


class Finding(NamedTuple):
    """A measurement in words, and whether the statement holds by it."""

    measured: str
    holds: bool


@dataclass(frozen=True)
class Statement:
    """A statement of the paper and how it is tested; ``statements.toml`` explains the attributes."""

    place: str
    sentence: str
    holds_if: str
    measured: str
    test: str
    studies: tuple[str, ...] = ()
    bounds: dict[str, Any] = field(default_factory=dict)

    @property
    def criterion(self) -> str:
        """The criterion with its bounds."""
        return self.holds_if.format(**self.bounds)

    def __call__(self, *archives: xr.Dataset) -> Finding:
        """Test the statement on the archives of its studies, in their order."""
        holds, values = resolve_name(f"{__package__}.{self.test}")(*archives, **self.bounds)
        return Finding(self.measured.format(**self.bounds, **values), bool(holds))


#: All statements by name, in the order of the paper.
STATEMENTS = {name: Statement(**row) for name, row in read_table(__file__, "statements").items()}
