"""The critical distance from a threshold of crack growth and a fatigue limit: L = (ΔK_th/Δσ_0)²/π."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from swtstudy.units.labels import KNOWN, Units
from swtstudy.units.sizes import wrong_size
from swtstudy.vocabulary.mistakes import Mistake, Report, literal, plain_number

#: ΔK_th in stress times √length, and Δσ_0: ranges, both at one ratio of least over largest stress.
RANGES = ("threshold_stress_intensity_range", "fatigue_limit_range")
LOAD_RATIO = "load_ratio"
#: Critical distances of metals, in m: a few µm (hard steels) to about a mm (cast iron, mild steel).
USUAL = 1e-6, 3e-3


@dataclass(frozen=True)
class CriticalDistance:
    """A critical distance from a threshold and a fatigue limit.

    Attributes
    ----------
    intensity, limit
        Both ranges.
    load_ratio
        At which both were found; None if it is not said.
    """

    intensity: float
    limit: float
    load_ratio: float | None = None

    @property
    def length(self) -> float:
        """L."""
        return (self.intensity / self.limit) ** 2 / math.pi

    def words(self, units: Units) -> tuple[bool, str]:
        """Check whether a metal may have a critical distance, and describe it."""
        ratio = "one load ratio, which load_ratio would name"
        if self.load_ratio is not None:
            ratio = f"the load ratio {self.load_ratio:g}"
        found = (
            f"critical_distance = {self.length:.4g} {units.length}, (ΔK_th/Δσ_0)²/π of ranges at {ratio}: "
            f"{self.intensity:g} {units.stress}√{units.length} and {self.limit:g} {units.stress}"
        )
        metre = KNOWN["length"].get(units.length)
        if metre is None or USUAL[0] <= metre * self.length <= USUAL[1]:
            return True, found
        words = f"{found}; metals have {USUAL[0] / metre:g} to {USUAL[1] / metre:g} {units.length}"
        if metre != 1.0:
            words += f": 1 {units.stress}√m is {metre**-0.5:.4g} {units.stress}√{units.length}"
        return False, words


def critical_distance(tables: Sequence[Mapping[str, Any]], report: Report) -> CriticalDistance | None:
    """That of the properties of both bodies; None without them, or with mistakes, which are added."""
    given = [[table.get(name) for name in (*RANGES, LOAD_RATIO)] for table in tables]
    one = given[0]
    if all(value is None for each in given for value in each):
        return None
    found: list[Mistake] = []
    for name, *values in zip((*RANGES, LOAD_RATIO), *given, strict=True):
        if values[0] != values[1]:
            allowed = "one value: there is one critical distance for both bodies"
            found.append(Mistake(name, ", ".join(map(literal, values)), allowed))
        elif name == LOAD_RATIO:
            if values[0] is not None and not -math.inf < plain_number(values[0]) < 1.0:
                found.append(
                    Mistake(name, literal(values[0]), "a number below 1: the least over the largest")
                )
        elif values[0] is None:
            other = RANGES[1 - RANGES.index(name)]
            found.append(Mistake(name, "nothing", f"a positive number, since there is {other}"))
        else:
            found += wrong_size(name, values[0], "a positive number")
    report += found
    if found:
        return None
    ratio = None if one[2] is None else plain_number(one[2])
    return CriticalDistance(plain_number(one[0]), plain_number(one[1]), ratio)
