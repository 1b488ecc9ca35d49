"""Classes of the definitions that a user may give, by the parameter that takes them."""

from __future__ import annotations

from swtstudy.vocabulary.named import Named


def kinds() -> dict[str, type[Named]]:
    """The classes of definitions, by parameter; imported where they are needed."""
    from swtstudy.mechanics.indenter.profile_table import TabulatedProfile
    from swtstudy.mechanics.load.load_path import LoadPath

    return {each.parameter: each for each in (LoadPath, TabulatedProfile)}
