"""How to cite, from CITATION.cff."""

from pathlib import Path
from typing import Any

import yaml


def citation(path: Path) -> str:
    """The message, the paper as a reference, and both as BibTeX."""
    found = yaml.safe_load(path.read_text(encoding="utf-8"))
    paper = found["preferred-citation"]
    authors = " and ".join(f"{a['family-names']}, {a['given-names']}" for a in paper["authors"])
    doi = f"[doi:{paper['doi']}](https://doi.org/{paper['doi']})"
    article = {
        "author": authors,
        "title": f"{{{paper['title']}}}",
        "journal": paper["journal"],
        "year": paper["year"],
        "volume": paper["volume"],
        "number": paper["issue"],
        "pages": f"{paper['start']}--{paper['end']}",
        "doi": paper["doi"],
    }
    software = {
        "author": "{" + " and ".join(a["name"] for a in found["authors"]) + "}",
        "title": f"{{{found['title']}}}",
        "version": found["version"],
    }
    return (
        f"{found['message']}\n\n{authors}: *{paper['title']}*. {paper['journal']} {paper['year']}, "
        f"{paper['volume']}, {paper['start']}–{paper['end']}, {doi}\n\n"
        f"```bibtex\n{_bibtex('article', 'willert2024', article)}\n"
        f"{_bibtex('software', 'swtstudy', software)}```\n"
    )


def _bibtex(kind: str, key: str, fields: dict[str, Any]) -> str:
    lines = "".join(f"  {name} = {{{value}}},\n" for name, value in fields.items())
    return f"@{kind}{{{key},\n{lines}}}\n"
