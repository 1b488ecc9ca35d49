"""The table of parameters."""

from build_steps.markdown import table
from swtstudy.parameters import FAMILIES, PARAMETERS


def parameters() -> str:
    """Every parameter, and the profiles with the shape parameters that they need."""
    rows = (
        (f"`{p.name}`", f"${p.symbol}$", p.meaning, p.allowed, _default(p.default))
        for p in PARAMETERS.values()
    )
    profiles = (
        (f"`{family.name}`", ", ".join(f"`{s}`" for s in family.shape) or "–") for family in FAMILIES.values()
    )
    return (
        table(("name", "symbol", "meaning", "allowed", "default"), rows)
        + "\n"
        + table(("profile", "needs"), profiles)
    )


def _default(value: float | str | None) -> str:
    if value is None:
        return "–"
    return f"`{value}`" if isinstance(value, str) else f"{value:.6g}"
