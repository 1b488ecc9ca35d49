"""Files of users, read with care, and files that are either complete or absent."""

from __future__ import annotations

import difflib
import errno
import os
import re
import stat
import tempfile
import tomllib
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from functools import cache
from os import PathLike
from pathlib import Path
from typing import Any

#: Larger files, in bytes, are no texts that someone wrote, and no tables: a million points take 60 MB.
LARGEST_TEXT, LARGEST_TABLE = 2**24, 2**28


def read_file(path: str | PathLike[str], largest: int) -> bytes:
    """The content of a regular file; a device or a pipe may never end.

    Raises
    ------
    OSError
        If it cannot be read, is no regular file, or has more bytes than the ``largest``.
    """

    def at_once(name: str, flags: int) -> int:
        return os.open(name, flags | getattr(os, "O_NONBLOCK", 0))  # opening a pipe waits for its writer

    with open(path, "rb", opener=at_once) as file:
        if not stat.S_ISREG(os.fstat(file.fileno()).st_mode):
            raise OSError(None, "not a regular file", str(path))
        content = file.read(largest + 1)
    if len(content) > largest:
        raise OSError(None, f"more than {largest} bytes", str(path))
    return content


def read_text(path: str | PathLike[str], largest: int = LARGEST_TEXT) -> str:
    """The text in a file in UTF-8, with or without a byte order mark; a ValueError if it is none."""
    try:
        return read_file(path, largest).decode("utf-8-sig").replace("\r\n", "\n")
    except UnicodeDecodeError:
        raise ValueError("bytes that are not UTF-8") from None


def reason_of(error: Exception) -> str:
    """Say why a file cannot be read, without its name; for a missing one, the most similar name beside it."""
    if isinstance(error, IsADirectoryError):
        return "a folder"
    if not isinstance(error, FileNotFoundError) or not error.filename:
        return getattr(error, "strerror", None) or str(error)
    path = Path(os.fsdecode(error.filename))
    folder = path.parent.resolve()
    if not folder.is_dir():
        return f"no folder {folder}"
    close = difflib.get_close_matches(path.name, [each.name for each in folder.iterdir()], n=1, cutoff=0.75)
    return f"no such file in the folder {folder}" + "".join(f": did you mean {name!r}?" for name in close)


class TomlError(ValueError):
    """A text that is not TOML.

    Attributes
    ----------
    shown
        The line of the text, and beneath it a caret where reading it failed; empty if that is unknown.
    """

    shown: str = ""


def parse_toml(text: str) -> dict[str, Any]:
    """The tables in a TOML text.

    Raises
    ------
    TomlError
        A ValueError with the reason, and the line.
    """
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        reason = str(error)
    except RecursionError:
        raise TomlError("a syntax error: nested too deeply") from None
    except ValueError:  # tomllib leaves numbers to Python's int, which refuses more than 4,300 digits
        raise TomlError("an integer with too many digits") from None
    lines = text.splitlines() or [""]
    place = re.search(r"line (\d+), column (\d+)", reason)
    row, column = (int(place[1]), int(place[2])) if place else (len(lines), len(lines[-1]) + 1)
    line = lines[row - 1]
    # A key that is there twice has its name; a decimal comma has a way out.
    key = line.partition("=")[0].strip()
    reason = reason.replace("Cannot overwrite a value", f"the key {key!r} twice")
    reason = re.sub(r"^Cannot declare \((.*?),?\) twice", r"the table \1 twice", reason)
    if number := re.search(r"=\s*([+-]?\d+),(\d[\de+-]*)\s*(#|$)", line):
        reason += f"; a decimal comma? Numbers have a decimal point: {number[1]}.{number[2]}"
    elif number := re.search(r"(?<![\w.\"'])[+-]?\.\d+", line):
        reason += f"; numbers have a digit before the decimal point: {number[0].replace('.', '0.')}"
    elif path := re.search(r'"([^"]*\\[^"]*)"', line):
        reason += f"; a path has / in place of \\, or single quotes: '{path[1]}'"
    start = max(0, column - 60)
    mark = " " * (min(column, len(line) + 1) - 1 - start) + "^"
    wrong = TomlError(f"a syntax error: {reason}")
    wrong.shown = f"{row:>4} | {line[start : start + 100]}\n     | {mark}"
    raise wrong


def read_table(module: str, name: str) -> dict[str, dict[str, Any]]:
    """The rows of the table in ``NAME.toml`` beside a module's file; lists in them become tuples."""
    rows = parse_toml(read_text(Path(module).with_name(f"{name}.toml")))
    return {
        each: {key: tuple(value) if isinstance(value, list) else value for key, value in row.items()}
        for each, row in rows.items()
    }


def plain_float(cell: str) -> float:
    """The number in a cell; Python would also read 1_0 as 10.

    Raises
    ------
    ValueError
        If it is none.
    """
    if "_" in cell:
        raise ValueError("not a number")
    return float(cell)


def check_writable(*paths: str | PathLike[str]) -> None:
    """Make sure that files can be written to some paths; their folders are created if needed.

    Raises
    ------
    OSError
        If it cannot be written; the message names the folder.
    """
    for target in map(_target, paths):
        folder = target.parent
        try:
            folder.mkdir(parents=True, exist_ok=True)
            # A name as long as that of an unfinished file.
            tempfile.NamedTemporaryFile(suffix=target.suffix, prefix=f".{target.stem}-", dir=folder).close()
        except OSError as error:
            words = f"cannot write {target.name} into the folder {folder}"
            raise type(error)(f"{words}: {error.strerror}") from error


@contextmanager
def replacing(path: str | PathLike[str], folder: Path | None = None) -> Iterator[Path]:
    """A temporary file that replaces the file at `path` when the block ends without an error.

    The temporary file is in the same folder, or in `folder`, which must be on the same file system. Its data
    is on the disk before it gets its name, so that neither a kill nor a power cut leaves half a file. A link
    stays one: what it points to is replaced.

    Raises
    ------
    OSError
        If it cannot be written, or there is a device or the like; the message names the file.
    """
    target = _target(path)
    if Path(path).is_symlink():
        folder = None  # it may point to another file system
    handle, name = tempfile.mkstemp(target.suffix, f".{target.stem}-", folder or target.parent)
    os.close(handle)
    temporary = Path(name)
    try:
        yield temporary
        mask = os.umask(0)
        os.umask(mask)
        with suppress(OSError):  # a file system without modes
            # mkstemp creates files that only their owner can read.
            temporary.chmod(0o666 & ~mask)
        _sync(temporary)
        os.replace(temporary, target)
    except BaseException as error:
        temporary.unlink(missing_ok=True)
        if isinstance(error, OSError) and error.errno is not None and error.filename in (None, name):
            raise type(error)(error.errno, error.strerror, str(path)) from error
        raise
    _sync(target.parent)


def write_text(path: str | PathLike[str], text: str) -> None:
    """Write a text in UTF-8, in full or not at all; raises as `replacing`."""
    with replacing(path) as temporary:
        temporary.write_text(text, encoding="utf-8")


def _target(path: str | PathLike[str]) -> Path:
    """The file that would be written at a path, through links; an OSError if something else is there."""
    path = Path(path)
    if path.is_dir():
        raise IsADirectoryError(f"{path} is a folder, not a file")
    if path.exists() and not path.is_file():
        raise OSError(f"{path} is not a regular file")
    return Path(os.path.realpath(path)) if path.is_symlink() else path


def unfinished(folder: Path, stem: str) -> list[Path]:
    """The unfinished files that a kill of `replacing` leaves in a folder, with names that match the stem."""
    name = re.compile(rf"\.(?:{stem})-[a-z0-9_]{{8}}(?:\.\w+)?")  # as `tempfile` makes them
    return [path for path in folder.glob(".*") if name.fullmatch(path.name)]


#: Errors of file systems that cannot sync folders.
_NO_FOLDERS = (errno.EINVAL, errno.ENOTSUP, errno.EBADF, errno.ENOSYS)


def _sync(path: Path) -> None:
    is_folder = path.is_dir()
    if os.name == "nt" and is_folder:
        return  # folders cannot be opened there
    # Some file systems sync only what is open for writing, and none of them folders.
    handle = os.open(path, os.O_RDONLY if is_folder else os.O_RDWR)
    try:
        os.fsync(handle)
    except OSError as error:
        if not (is_folder and error.errno in _NO_FOLDERS):
            raise
    finally:
        os.close(handle)


@cache
def _reader(kind: Any) -> Any:
    """pydantic's reader of a type: it takes a millisecond to make one."""
    from pydantic import TypeAdapter

    return TypeAdapter(kind)


def read_json(kind: Any, text: object) -> Any:
    """The value of a type that is written as JSON.

    Raises
    ------
    ValueError
        With the first thing that is wrong in it.
    """
    from pydantic import ValidationError

    try:
        return _reader(kind).validate_json(text, strict=True)
    except ValidationError as error:
        wrong = error.errors()[0]
        raise ValueError(": ".join([*map(str, wrong["loc"]), wrong["msg"]])) from None
