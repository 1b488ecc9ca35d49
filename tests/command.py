"""The command in this process, and what it says of archives."""

import io
import re
from pathlib import Path

import pytest
import xarray as xr
from click.testing import CliRunner, Result

import swtstudy
from swtstudy.cli import main as main


def call(*arguments: object, **options: object) -> Result:
    """What the command does with arguments; options are those of click's ``invoke``, such as color."""
    return CliRunner().invoke(main, list(map(str, arguments)), **options)  # type: ignore[arg-type]


def succeeded(*arguments: object, **options: object) -> Result:
    """The same of a command that has to succeed."""
    done = call(*arguments, **options)
    assert done.exit_code == 0, done.output
    return done


def ends(*arguments: object) -> int:
    """The exit code of the command in the streams that are there."""
    with pytest.raises(SystemExit) as ended:
        main(list(map(str, arguments)))
    return int(ended.value.code or 0)


class Terminal(io.StringIO):
    """A stream that says it is a terminal."""

    def isatty(self) -> bool:
        return True


def shown(columns: int, *arguments: object) -> list[str]:
    """The lines that the command shows on a terminal of so many columns."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("COLUMNS", str(columns))
        patch.setattr("sys.stdout", terminal := Terminal())
        assert ends(*arguments) == 0
    return terminal.getvalue().splitlines()


def saved(archive: object, kind: str = "unfinished") -> int:
    """How many distinct points are beside an archive: of an unfinished run, or "kept" of other studies."""
    found = re.search(rf"^  {kind} +(\d+) distinct points", call("info", archive).output, re.MULTILINE)
    return int(found[1]) if found else 0


def merged(*archives: Path, sparse: bool = False, name: str = "merged.nc") -> xr.Dataset:
    """Archives as one, beside the first of them; a ValueError with the words of the command if it refuses."""
    target = archives[0].with_name(name)
    done = call("merge", *archives, "-o", target, *["--sparse"] * sparse)
    if done.exit_code:
        raise ValueError(done.stderr.removeprefix("Error: ").strip())
    return swtstudy.open_results(target)
