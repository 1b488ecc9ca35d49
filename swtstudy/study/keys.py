"""Keys of a user's tables: pydantic checks them, messages say what is allowed, the schema describes them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from inspect import signature
from typing import Any, ClassVar, TypeVar, get_args, get_origin

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from swtstudy.vocabulary.mistakes import Mistake, StudyError, literal, nearest, plain
from swtstudy.vocabulary.naming import Function, with_arguments


@dataclass(frozen=True)
class Allowed:
    """Words for what a key may hold, where pydantic's own message would not say it.

    Attributes
    ----------
    words
        The words.
    whole
        Whether the mistakes of its parts are one mistake, that of the key.
    """

    words: str
    whole: bool = False


def key(description: str, default: Any = ..., **limits: Any) -> Any:
    """A key with its description in the schema."""
    return Field(default, description=description, **limits)


class Table(BaseModel):
    """A table of a study file."""

    model_config = ConfigDict(extra="forbid", strict=True, frozen=True)
    #: Words for the table as a whole, in messages.
    allowed: ClassVar[str]


AnyTable = TypeVar("AnyTable", bound=Table)


def read_keys(
    model: type[AnyTable], raw: Mapping[str, Any], source: str = ""
) -> tuple[AnyTable | None, list[Mistake]]:
    """The table with these keys, or every mistake in them."""
    try:
        return model.model_validate({name: plain(value) for name, value in raw.items()}), []
    except ValidationError as error:
        found = {_mistake(model, detail, source) for detail in error.errors(include_url=False)}
        return None, sorted(found, key=lambda mistake: mistake.key)


def sound_keys(model: type[AnyTable], given: Mapping[str, Any]) -> AnyTable:
    """The table with the keys that are not None; a StudyError with every mistake in them."""
    found, mistakes = read_keys(model, {name: value for name, value in given.items() if value is not None})
    if found is None:
        raise StudyError(mistakes)
    return found


def _mistake(model: type[Table], detail: Any, source: str) -> Mistake:
    path = [part for part in detail["loc"] if part not in ("list", "range")]  # pydantic's tags, not keys
    field = model.model_fields.get(str(path[0]))
    levels, inner = _inner(field.annotation) if field else (0, None)
    allowed = ""
    if inner is not None and len(path) == levels:
        allowed = inner.allowed
    elif inner is None or len(path) < levels:
        levels, inner = 0, model
    if not allowed:
        row = inner.model_fields.get(str(path[levels]))
        words = next((each for each in row.metadata if isinstance(each, Allowed)), None) if row else None
        if words is not None and (words.whole or len(path) == levels + 1):
            path, allowed = path[: levels + 1], words.words
    name = "".join(f"[{part}]" if isinstance(part, int) else f".{part}" for part in path)[1:]
    if detail["type"] == "extra_forbidden":
        return Mistake(
            name, f"unknown key {literal(path[-1])}", nearest(str(path[-1]), inner.model_fields), source
        )
    found = "nothing" if detail["type"] == "missing" else literal(detail["input"])
    return Mistake(name, found, allowed or detail["msg"], source)


def _inner(kind: Any) -> tuple[int, type[Table] | None]:
    """The table within the type of a key, and how many keys lead to it."""
    if isinstance(kind, type) and issubclass(kind, Table):
        return 1, kind
    for each in get_args(kind):
        levels, table = _inner(each)
        if table is not None:
            return levels + (get_origin(kind) in (dict, list)), table
    return 0, None


def with_keys(model: type[Table]) -> Callable[[Function], Function]:
    """Decorate a function whose further arguments are the keys of a table: its signature names them."""
    return with_arguments(signature(model).parameters.values())


def place_of(mistake: Mistake) -> str:
    """Where in a file or a list the mistake is."""
    place = ": ".join(part for part in (mistake.source, mistake.key) if part)
    return f" ({place})" if place else ""
