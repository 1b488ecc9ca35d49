"""Points and what is known of them, one a line: parameters by their symbols, a colon, and values."""

from typing import Any

SYMBOLS = {
    **{"ν": "poisson_ratio", "μ": "friction", "ψ": "phase", "ω": "frequency_ratio"},
    **{"δ": "normal_amplitude", "u": "tangential_amplitude"},
    **{"F": "normal_force_amplitude", "Q": "tangential_force_amplitude"},
    **{"b": "flat_radius", "h": "waviness_amplitude", "λ": "wavelength", "n": "exponent"},
    **{"B": "bulk_stress_amplitude", "Bm": "bulk_stress_mean", "Bψ": "bulk_stress_phase"},
    **{"γ": "walker_exponent", "k": "normal_sensitivity", "criterion": "criterion"},
}


def recorded(table: str) -> list[tuple[Any, ...]]:
    """The parameters for `swtstudy.solve` and the values of each point of a table.

    A word without a symbol is the profile. A line with # says what the points below it are there for; an
    indented line continues the one before.
    """
    lines = [line for line in table.splitlines() if line and not line.startswith("#")]
    return [_point(line) for line in "\n".join(lines).replace("\n    ", " ").splitlines()]


def _point(line: str) -> tuple[Any, ...]:
    parameters, _, values = line.partition(":")
    given: dict[str, Any] = {}
    for part in parameters.split():
        symbol, _, value = part.partition("=")
        name, text = (SYMBOLS[symbol], value) if value else ("profile", symbol)
        given[name] = text if name in ("profile", "criterion", "frequency_ratio") else float(text)
    return given, *(float(value) if value[0].isdigit() else value for value in values.split())
