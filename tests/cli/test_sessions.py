"""Commands one after the other, and all that they print, as in data/sessions.txt."""

import re
import shlex
import warnings
from functools import partial
from pathlib import Path

import pytest
import real
import stand_in
from command import call
from folders import DATA, sections
from kept import Kept
from real import CONTACT

from swtstudy import Study, run

#: The tests look at what is written, not at the layout of figures.
pytestmark = pytest.mark.usefixtures("unwrapped")

LINE = 'title = "A line"\nrtol = 1e-3\n[axes]\nfriction = {numbers}\n'
ASKED = """title = "Asked"
rtol = 1e-3
quantities = ["dissipation"]
[axes]
friction = [0.1, 0.2]
critical_distance = [0.1, 0.25]
"""
FAILING = """title = "Failing"
[axes]
friction = [0.1, 0.2]
phase = {start = 0, stop = 1, num = 6}
[figure]
x = "friction"
hue = "phase"
"""
PANELS = """title = "In panels"
[axes]
phase = {start = 0, stop = "2*pi", num = 9}
friction = [0.3, 0.7]
normal_amplitude = [0, 0.5, 0.9]
[figure]
x = "phase"
panels = "friction"
hue = "normal_amplitude"
"""
UNITS = f"""title = "With units"
{real.UNITS}[fixed]
young_modulus = 115e3
poisson_ratio = 0.32
radius = 0.025
friction = 0.5
normal_force = 250
[axes]
tangential_force_amplitude = [60, 150]
"""
RIG = f"{CONTACT}normal_force = 200\n[axes]\ntangential_force_amplitude = [20, 60]\n"
SAMPLE = 'title = "A sample"\nrtol = 1e-3\n[sample.points]\nfriction = [0.1, 0.2]\nphase = [0, 1]\n'
#: The files that are there at the begin of each session.
FILES = {
    "line.toml": LINE.format(numbers="[0.1, 0.2, 0.3]"),
    "other.toml": LINE.format(numbers="[0.2, 0.4]"),
    "fine.toml": LINE.format(numbers="[0.1, 0.2]").replace("1e-3", "1e-4"),
    "asked.toml": ASKED,
    "more.toml": ASKED.replace('"dissipation"', '"dissipation", "contact_radius"'),
    "failing.toml": FAILING,
    "few.toml": FAILING.replace("num = 6", "num = 5").partition("[figure]")[0],
    "panels.toml": PANELS,
    "units.toml": UNITS,
    "figure.toml": LINE.format(numbers="[0.3]").replace("A line", "Mine") + '[figure]\nx = "friction"\n',
    "coarse.toml": LINE.format(numbers="[0.4, 0.3]").replace("1e-3", "1e-2") + "phase = [0]\n",
    "findley.toml": LINE.format(numbers="[0.1]")
    + '[fixed]\ncriterion = "findley"\nnormal_sensitivity = 0.3\n',
    "nearer.toml": LINE.format(numbers="[0.1]") + "critical_distance = [0.2]\n",
    "nearest.toml": LINE.format(numbers="[0.1]") + "critical_distance = [0.1]\n",
    "forces.toml": 'title = "Forces"\n[axes]\ntangential_force_amplitude = [0.2]\n',
    "rig.toml": RIG,
    "soft.toml": RIG.replace("350", "300").replace("0.409", "0.5"),
    "sample.toml": SAMPLE,
    "longer.toml": SAMPLE.replace("[0, 1]", "[1, 3]"),
    "unlike.toml": SAMPLE.replace("phase", "poisson_ratio").replace("1]", "0.5]"),
    "bad.toml": LINE.format(numbers="[-1, 0.2]"),
}
SESSIONS = sections("sessions.txt")

#: What differs from run to run, and what stands in its place.
VARYING = {
    r"\d+\.\d s\b": "1.0 s",
    r"\(\S+ ms a point": "(1 ms a point",
    r"\(python .*\)": "(versions)",
    r"\d{4}-\d\d-\d\dT[\d:+]+": "now",
    r"solver version \d+": "solver version 1",
    # Equal lines of one second are one.
    r"(  history .*\n)\1+": r"\1",
}


def printed(line: str) -> str:
    """What a command prints: errors behind an exclamation mark, then an exit code that is not 0."""
    if line.startswith("cp "):
        one, other = map(Path, line.split()[1:])
        other.write_bytes(one.read_bytes())
        return ""
    with warnings.catch_warnings():
        warnings.simplefilter("always")
        done = call(*shlex.split(line), prog_name="swtstudy")
    text, errors = done.stdout, done.stderr.replace(str(Path.cwd()), "HERE")
    for varying, said in VARYING.items():
        text = re.sub(varying, said, text)
    if line.endswith("-h") and line != "-h":
        text = text[text.find("  Examples:") :]
    text += "".join(f"! {each}".rstrip() + "\n" for each in errors.splitlines())
    return text + (f"({done.exit_code})\n" if done.exit_code else "")


def replayed(session: str) -> str:
    """A session once more, by its lines that begin with a dollar."""
    lines = [line.removeprefix("$ ") for line in session.splitlines() if line.startswith("$ ")]
    return "".join(f"$ {line}\n{printed(line)}" for line in lines)


@pytest.mark.parametrize("name", SESSIONS)
def test_a_session_prints_what_it_printed(
    kept: Kept, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "80")
    monkeypatch.setattr(stand_in.QUANTITIES, stand_in.asked)
    for file, text in FILES.items():
        Path(file).write_text(text)
    failing = name.startswith("failing")
    monkeypatch.setattr(stand_in.SOLVER, partial(stand_in.fail_at, 0.2) if failing else stand_in.smooth)
    if name == "unfinished":
        wide = Study.from_text(LINE.format(numbers="{start = 0.1, stop = 0.9, num = 400}"))
        with pytest.raises(KeyboardInterrupt):
            run(wide, "line.nc", workers=1, solver=stand_in.Interrupting(192))
    if name == "outdated":
        run(Study.from_toml("line.toml"), "line.nc")
        monkeypatch.setattr("swtstudy.archive.run.SOLVER_VERSION", "0")
    kept.text(DATA / "sessions.txt", SESSIONS[name].rstrip(), replayed(SESSIONS[name]).rstrip())
