"""Signatures and docstrings of functions that take parameters by name."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from inspect import Parameter as Argument
from inspect import cleandoc, signature
from textwrap import fill, indent
from typing import Any, TypeVar

from swtstudy.vocabulary.parameters import Parameter

Function = TypeVar("Function", bound=Callable[..., Any])


def with_arguments(arguments: Iterable[Argument]) -> Callable[[Function], Function]:
    """Decorate a function with ``**names``: its signature shows these arguments instead."""

    def decorate(function: Function) -> Function:
        own = signature(function)
        named = [each for each in own.parameters.values() if each.kind is not Argument.VAR_KEYWORD]
        new = [
            each.replace(annotation=Argument.empty) for each in arguments if each.name not in own.parameters
        ]
        function.__signature__ = own.replace(parameters=[*named, *new])  # type: ignore[attr-defined]
        return function

    return decorate


def with_parameters(rows: Iterable[Parameter]) -> Callable[[Function], Function]:
    """Decorate a function with ``**parameters``: its signature and its docstring list these parameters."""

    def decorate(function: Function) -> Function:
        own = [row for row in rows if row.name not in signature(function).parameters]
        arguments = [Argument(row.name, Argument.KEYWORD_ONLY, default=row.default) for row in own]
        lines = (f"{row.name}\n{indent(fill(row.explained, 101), 4 * ' ')}" for row in own)
        head, heading, tail = cleandoc(function.__doc__ or "").partition("\n\nReturns\n")
        function.__doc__ = "\n".join([head, *lines]) + heading + tail
        return with_arguments(arguments)(function)

    return decorate
