"""The kinds of figures, with studies that draw them."""

from itertools import islice

from build_steps.markdown import table
from swtstudy.study.shipped import shipped_studies
from swtstudy.vocabulary.choices import FIGURES
from swtstudy.vocabulary.files import parse_toml, read_text


def figure_kinds() -> str:
    """A table of the kinds, what each draws, the keys that it lacks, and examples."""
    figures = {
        name: parse_toml(read_text(path)).get("figure", {}) for name, path in shipped_studies().items()
    }
    rows = []
    for kind, drawing in FIGURES.items():
        named = (name for name, figure in figures.items() if figure.get("kind", "lines") == kind)
        links = ", ".join(f"[{name}.toml](../studies/{name}.toml)" for name in islice(named, 2))
        rows.append(
            (f"`{kind}`", drawing.words, ", ".join(f"`{key}`" for key in drawing.lacks), links or "–")
        )
    return table(("`kind`", "draws", "without", "examples"), rows)
