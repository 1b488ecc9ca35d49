"""Signatures and docstrings that name parameters."""

from __future__ import annotations  # as in the package, so that annotations are texts

import inspect
from typing import Any

from swtstudy.vocabulary.naming import with_parameters
from swtstudy.vocabulary.parameters import PARAMETERS

ROWS = [PARAMETERS[name] for name in ("friction", "profile", "phase")]


def test_a_function_shows_the_parameters_that_it_takes_by_name() -> None:
    @with_parameters(ROWS)
    def solve(first: int, *, phase: float = 2.0, **parameters: Any) -> int:
        """Solve it.

        Parameters
        ----------
        first
            The first.

        Returns
        -------
        int
            The last.
        """
        return first

    assert str(inspect.signature(solve)) == (
        "(first: 'int', *, phase: 'float' = 2.0, friction=0.3, profile='paraboloid') -> 'int'"
    )
    head, tail = str(solve.__doc__).split("    The first.\n")
    assert head == "Solve it.\n\nParameters\n----------\nfirst\n"
    own, returns = tail.split("\n\n")
    assert returns == "Returns\n-------\nint\n    The last."
    words = " ".join(own.split())
    assert words.startswith("friction coefficient of friction, μ; a number in [0, 10]; default 0.3. profile ")
    lines = own.splitlines()
    assert [line for line in lines if line[0] != " "] == ["friction", "profile"]
    assert {len(line) - len(line.lstrip()) for line in lines} == {0, 4}
    assert 95 < max(map(len, lines)) <= 105
