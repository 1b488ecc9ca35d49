"""Reports in Markdown, from the templates in this folder."""

from __future__ import annotations

from typing import Any

import jinja2


def rendered(template: str, **content: Any) -> str:
    """A report from a template."""
    look: dict[str, Any] = {"trim_blocks": True, "lstrip_blocks": True, "keep_trailing_newline": True}
    loader = jinja2.PackageLoader("swtstudy.paper", ".")
    room = jinja2.Environment(loader=loader, undefined=jinja2.StrictUndefined, **look)
    return room.get_template(template).render(**content)
