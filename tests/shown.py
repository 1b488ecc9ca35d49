"""What the pages show: blocks of code and commands, found in Markdown, and how each kind is run."""

import os
import re
import shlex
import subprocess
import sys
import tomllib
from pathlib import Path
from typing import NamedTuple

from command import call, main
from folders import ROOT

#: What the README and the pages say; the generated parts of the pages are made by running.
PAGES = sorted(
    [
        ROOT / "README.md",
        ROOT / "CONTRIBUTING.md",
        *(page for part in (".", "theory", "api") for page in (ROOT / "docs" / part).glob("*.md")),
    ]
)

_FENCE = re.compile(r"^```(\S*)[^\n]*\n(.*?)^```$", re.MULTILINE | re.DOTALL)
_CODE = re.compile(r"`([^`\n]+(?:\n[^`\n]+)?)`")
#: Programs that prepare a place for the package or read it: continuous integration runs them, as they stand.
_INSTALLERS = ("python3 -m venv", "pip install", "python -m pytest", "sphinx-build")
#: Commands in prose that are run; a placeholder in capitals stands for something that is not there.
_RUN = ("swtstudy ", "python studies/", "pip install", "sphinx-build", "eval ")
_PLACEHOLDER = re.compile(r"\b[A-Z]{2,}\b|host:")
#: Parts that are made by running, see docs/build_steps/generate.py.
_MADE = re.compile(r"<!-- (\w+) -->.*<!-- end of \1 -->", re.DOTALL)


class Block(NamedTuple):
    """A block of code: its page, its place there, its language, what it says, and the lines before it."""

    page: Path
    line: int
    language: str
    text: str
    lead: str

    def __str__(self) -> str:
        return f"{self.page.relative_to(ROOT)}:{self.line}"


def text_of(page: Path) -> str:
    """What is written on a page, with empty lines for what is made by running."""
    return _MADE.sub(lambda made: "\n" * made[0].count("\n"), page.read_text(encoding="utf-8"))


def blocks_of(page: Path) -> list[Block]:
    """The blocks of a page, in its order."""
    text = text_of(page)
    return [
        Block(page, 1 + text[: found.start()].count("\n"), found[1], found[2], _lead(text[: found.start()]))
        for found in _FENCE.finditer(text)
    ]


def _lead(text: str) -> str:
    return text.rstrip().rpartition("\n\n")[2]


def code_in_prose(page: Path) -> list[str]:
    """The code between the words of a page."""
    prose = _FENCE.sub("", text_of(page))
    return [" ".join(found[1].split()) for found in _CODE.finditer(prose)]


def commands_in_prose(page: Path) -> list[str]:
    """Whole commands between the words of a page, such as `swtstudy run --all`."""
    codes = code_in_prose(page)
    return [code for code in codes if code.startswith(_RUN) and not _PLACEHOLDER.search(code)]


def calls_in_prose(page: Path) -> list[str]:
    """Names of the package between the words of a page, or calls."""
    return [code for code in code_in_prose(page) if code.startswith("swtstudy.")]


def commands_in_help() -> list[str]:
    """The examples of every command's help, which a page shows, too."""
    epilogs = [main.epilog, *(command.epilog for command in main.commands.values())]
    lines = [line.strip() for epilog in epilogs if epilog for line in epilog.splitlines()]
    return [line for line in lines if line.startswith("swtstudy ") and not _PLACEHOLDER.search(line)]


def commands_of(text: str) -> list[str]:
    """The single commands of a block of shell, or of a line."""
    lines = text.replace("\\\n", " ").splitlines()
    parts = [part.strip() for line in lines for part in re.split(r"(?:^| )#", line)[0].split("&&")]
    return [part.replace(".venv/bin/", "") for part in parts if part]


def run_command(command: str) -> str:
    """Run a command in the working directory: its output. Installers are looked up in the CI instead."""
    if command.startswith(_INSTALLERS):
        _check_installer(command)
        return ""
    if command.startswith("eval "):
        there = {**os.environ, "PATH": f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"}
        done = subprocess.run(
            ["bash", "-c", f"set -e; {command}; complete -p swtstudy"],
            env=there,
            check=True,
            capture_output=True,
            text=True,
        )
        return done.stdout
    words = shlex.split(command)
    if words[0] == "swtstudy":
        result = call(*words[1:])
        mentioned = len(words) == 2 and "Missing argument" in result.output
        assert result.exit_code == 0 or mentioned, f"{command}: {result.output}"
        return result.output
    if command.startswith("python studies/"):
        assert script_of(command) in scripts(), command
        return ""  # test_scripts.py runs them all
    raise AssertionError(f"no way to run {command!r}")


def scripts() -> list[Path]:
    """What may be run of the folder of studies: files, or folders with a __main__.py."""
    files = sorted((ROOT / "studies").rglob("*.py"))
    runnable = [file for file in files if '__name__ == "__main__"' in file.read_text(encoding="utf-8")]
    return [file.parent if file.name == "__main__.py" else file for file in runnable]


def script_of(command: str) -> Path:
    """The script that a command runs."""
    return ROOT / shlex.split(command)[1]


def _check_installer(command: str) -> None:
    """An installer's command is one of the CI's, up to options and a choice of the extras."""
    words = _essential(command)
    files = [ROOT / ".ci" / name for name in ("run", "slow")]
    ci = [_essential(each) for file in files for each in commands_of(file.read_text(encoding="utf-8"))]
    if words[0] == "pip":
        *words, target = words
        folder, _, extras = target.rstrip("]").partition("[")
        known = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["optional-dependencies"]
        assert folder == ".", f"{command}: not of this folder"
        assert set(filter(None, extras.split(","))) <= set(known), command
        ci = [each[:-1] for each in ci]
    assert words in ci, f"{command}: not in .ci"


def _essential(command: str) -> list[str]:
    return [word for word in shlex.split(command) if not word.startswith("-") or word == "-m"]
