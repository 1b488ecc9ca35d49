"""Tables of rows with names, such as the parameters: TOML files beside the modules that read them."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any


def read_table(module: str, name: str) -> dict[str, dict[str, Any]]:
    """The rows of the table in ``NAME.toml`` beside a module's file; lists in them become tuples."""
    rows = tomllib.loads(Path(module).with_name(f"{name}.toml").read_text(encoding="utf-8"))
    return {
        each: {key: tuple(value) if isinstance(value, list) else value for key, value in row.items()}
        for each, row in rows.items()
    }
