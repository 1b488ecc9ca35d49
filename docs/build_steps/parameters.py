"""The table of parameters."""

from build_steps.markdown import table
from swtstudy.vocabulary.choices import FAMILIES, PLAIN, PLAIN_STRIP, Family
from swtstudy.vocabulary.parameters import PARAMETERS, Parameter


def parameters() -> str:
    """Every parameter, and the profiles with the shape parameters that they need."""
    rows = (
        (f"`{p.name}`", f"${p.symbol}$", _meaning(p), _allowed(p), _default(p.default), p.scale or "–")
        for p in PARAMETERS.values()
    )
    profiles = (
        (
            f"`{family.name}`",
            family.geometry,
            ", ".join(f"`{s}`" for s in family.shape) or "–",
            _plain(family),
        )
        for family in FAMILIES.values()
    )
    return (
        table(("name", "symbol", "meaning", "allowed", "default", "in a real contact over"), rows)
        + "\n"
        + table(("profile", "contact", "needs", f"is the {PLAIN} or {PLAIN_STRIP} at"), profiles)
    )


def _allowed(parameter: Parameter) -> str:
    more = ", or what the study defines" if parameter.kind == "name" else ""
    return parameter.allowed + more


def _meaning(parameter: Parameter) -> str:
    other = parameter.instead_of
    return f"{parameter.meaning}, instead of `{other}`" if other else parameter.meaning


def _plain(family: Family) -> str:
    return f"`{family.plain[0]}` = {family.plain[1]:g}" if family.plain else "–"


def _default(value: float | str | None) -> str:
    if value is None:
        return "–"
    return f"`{value}`" if isinstance(value, str) else f"{value:.6g}"
