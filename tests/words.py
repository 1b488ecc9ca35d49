"""Names and numbers as the package says them: in the schema of studies, and in the words of results."""

import json
import re

from folders import STUDIES

_FIXED = json.loads((STUDIES / "study.schema.json").read_text(encoding="utf-8"))["properties"]["fixed"]
#: What the schema says of each parameter.
SAID = _FIXED["properties"]
#: Parameters without units, which come first.
PARAMETERS = [*SAID][: [*SAID].index("critical_distance")]
PROFILES = SAID["profile"]["examples"]

_POWERS = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")


def number(words: str) -> float:
    """The number in words such as 0.1235, −1.32 or 5·10⁻⁷."""
    power = re.fullmatch(r"(?:(.*)·)?10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)", words.replace("−", "-"))
    if power is None:
        return float(words.replace("−", "-"))
    return float(f"{power[1] or 1}e{power[2].translate(_POWERS)}")
