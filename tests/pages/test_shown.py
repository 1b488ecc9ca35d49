"""What the README, the pages and the help show is run as it stands, and does what they say."""

import ast
import contextlib
import io
import operator
import re
import shutil
import sys
from itertools import pairwise
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
import shown
import stand_in
from folders import RESULTS, ROOT
from solved import REGIMES

import swtstudy
from swtstudy import Study, open_results

PYTHON = [page for page in shown.PAGES if any(b.language == "python" for b in shown.blocks_of(page))]
SHELL = [page for page in shown.PAGES if any(b.language == "sh" for b in shown.blocks_of(page))]
TOML = [block for page in shown.PAGES for block in shown.blocks_of(page) if block.language == "toml"]
IN_PROSE = [command for page in shown.PAGES for command in shown.commands_in_prose(page)]
IN_HELP = [part for line in shown.commands_in_help() for part in shown.commands_of(line)]
#: Each once. What makes a file comes before what needs it, and what is short before what is longer.
COMMANDS = sorted({*IN_PROSE, *IN_HELP}, key=lambda command: (" new " not in command, len(command), command))
#: Names of the package, such as swtstudy.solve, as far as the dots go.
NAMES = sorted(
    {
        re.match(r"swtstudy\.([\w.]*\w)", call)[1]
        for page in shown.PAGES
        for call in shown.calls_in_prose(page)
    }
)
#: Blocks that the build of the pages makes of files; CI builds them, and their files are tested elsewhere.
BUILT = {"{include}", "{literalinclude}", "{figure}", "{toctree}", "{eval-rst}"}
BOX = "swtstudy audit studies/audit/parameter_box.toml"
#: A hundred points of an audit are some ten seconds, a thousand with dense looks an hour; 25 reports minutes.
FEWER = {
    "swtstudy audit figure3 --points 100": "swtstudy audit figure3 --points 2",
    "swtstudy audit figure3 figure4 --points 100": "swtstudy audit figure3 figure4 --points 2",
    "swtstudy audit figure3 --dense": "swtstudy audit figure3 --dense --points 2",
    BOX: f"{BOX} --points 2",
    "swtstudy report results/*.nc -o site/": "swtstudy report results/loops.nc results/a.nc -o site/",
}


@pytest.fixture(scope="module")
def fresh(tmp_path_factory):
    """A copy of what a clone has beside the package, up to date, and the README's rig.toml."""
    folder = tmp_path_factory.mktemp("clone")
    for name in ("results", "studies"):
        shutil.copytree(ROOT / name, folder / name, ignore=shutil.ignore_patterns("__pycache__"))
    for study in sorted((folder / "studies").glob("*.toml")):
        counting = stand_in.Counting()
        swtstudy.run(Study.from_toml(study), folder / "results" / f"{study.stem}.nc", solver=counting)
        assert not counting.points, f"results/{study.stem}.nc is to be made anew"
    (rig,) = (block for block in TOML if block.page.name == "README.md")
    (folder / "rig.toml").write_text(rig.text)
    return folder


@pytest.fixture(scope="module")
def clone(fresh, tmp_path_factory):
    """Such a copy in which commands leave what they make, with archives to merge and files of examples."""
    folder = shutil.copytree(fresh, tmp_path_factory.mktemp("commands") / "clone")
    for name in "ab":
        shutil.copy2(folder / "results" / "figure3.nc", folder / "results" / f"{name}.nc")
    shutil.copy2(folder / "results" / "contour.nc", folder / "merged.nc")
    (folder / "mine").mkdir()  # the quick start's, whose blocks of shell make it
    shutil.copy2(folder / "results" / "figure3.nc", folder / "mine" / "figure3.nc")
    rows = "".join(f"{r / 10},{max(r / 10 - 0.3, 0.0) ** 2}\n" for r in range(25))
    (folder / "worn.csv").write_text(f"radius,height\n{rows}")
    (folder / "stresses.csv").write_text("step,xx,yy,zz,yz,xz,xy\n0,0,0,0,0,0,0\n1,200,0,0,0,0,50\n")
    (folder / "tests.csv").write_text("tangential_force_amplitude,life\n30,2e10\n60,1e8\n")
    return folder


@pytest.fixture
def slurm(monkeypatch):
    """dask_jobqueue without a queue: its cluster is one of threads in this process."""
    distributed = pytest.importorskip("distributed")
    made = []

    class SLURMCluster(distributed.LocalCluster):
        def __init__(self, *, cores: int, processes: int, memory: str, walltime: str):
            assert cores % processes == 0
            assert re.fullmatch(r"\d+GB", memory)
            assert re.fullmatch(r"\d\d:\d\d:\d\d", walltime)
            made.append(self)
            super().__init__(n_workers=0, processes=False, dashboard_address=":0")

        def scale(self, n: int = 0, *, jobs: int = 0):
            super().scale(n or min(jobs, 2))

    module = ModuleType("dask_jobqueue")
    module.SLURMCluster = SLURMCluster
    monkeypatch.setitem(sys.modules, "dask_jobqueue", module)
    yield made
    if made:
        distributed.default_client().close()
    for cluster in made:
        cluster.close()


@pytest.mark.pages
@pytest.mark.filterwarnings("default")  # the cluster has its own
@pytest.mark.parametrize("page", PYTHON, ids=lambda page: page.name)
def test_python_blocks_of_a_page(page, fresh, tmp_path, monkeypatch, slurm):
    shutil.copytree(fresh, tmp_path, dirs_exist_ok=True)
    monkeypatch.chdir(tmp_path)
    names: dict[str, object] = {"__name__": "page"}
    printed = io.StringIO()
    for block in shown.blocks_of(page):
        if block.language == "text":
            lines = [line.rstrip() for line in printed.getvalue().splitlines()]
            assert lines == block.text.splitlines(), f"{block} is not what is printed"
        if block.language == "python":
            if "hvplot" in block.text:
                pytest.importorskip("hvplot")
            if "dask_jobqueue" in block.text:
                # All but some phases: or there is nothing to do for the cluster.
                archive = tmp_path / "results" / "figure4.nc"
                open_results(archive).isel(phase=slice(20, None)).to_netcdf(archive)
            with contextlib.redirect_stdout(io.StringIO()) as printed:
                exec(compile("\n" * block.line + block.text, str(page), "exec"), names)
            for dims in re.findall(r"# dims: (\(.*\))", block.text):
                assert names["ds"].s.dims == ast.literal_eval(dims)
    if page.name == "cluster.md":
        assert slurm
        phases = len(Study.from_toml("figure4").grid.axes["phase"])
        assert names["ds"].sizes == {"normal_amplitude": 2, "frequency_ratio": 5, "phase": phases}
        assert np.isfinite(names["ds"].s).all()
        assert re.search(r" [1-9]\d* of \d+ distinct points computed", names["ds"].history.splitlines()[0])


@pytest.mark.pages
@pytest.mark.parametrize("page", SHELL, ids=lambda page: page.name)
def test_shell_blocks_of_a_page(page, fresh, tmp_path, monkeypatch):
    shutil.copytree(fresh / "studies", tmp_path / "studies")
    monkeypatch.chdir(tmp_path)
    for block in shown.blocks_of(page):
        if block.language == "sh":
            for command in shown.commands_of(block.text):
                shown.run_command(command)
            for file in re.findall(r"\w+/\w+\.(?:nc|png)", block.lead + block.text):
                assert (tmp_path / file).is_file(), file
    for call in shown.calls_in_prose(page):
        if call.endswith(")") and "..." not in call:
            assert eval(call, {"swtstudy": swtstudy}) is not None


@pytest.mark.pages
@pytest.mark.parametrize("block", TOML, ids=str)
def test_blocks_of_studies(block, tmp_path):
    study = Study.from_text(block.text, folder=tmp_path)
    ds = swtstudy.run(study, tmp_path / "study.nc", workers=1)
    refused = ds.regime == REGIMES.index("no_equilibrium")
    assert (np.isfinite(ds.s) != refused).all()
    assert bool(refused.any()) == ("no_equilibrium" in block.lead)
    assert set(study.grid.axes) <= set(ds.dims)


@pytest.mark.parametrize("name", NAMES)
def test_names_in_prose(name):
    assert operator.attrgetter(name)(swtstudy)


@pytest.mark.pages
@pytest.mark.parametrize("command", COMMANDS)
def test_commands_in_prose_and_help(command, clone, monkeypatch):
    monkeypatch.chdir(clone)
    # Whichever of the commands on mine.toml came before.
    Path("mine.toml").unlink(missing_ok=True)
    if "mine.toml" in command:
        shown.run_command("swtstudy new mine")
    shown.run_command(FEWER.get(command, command))
    for kept in (RESULTS).glob("*.md"):  # swtstudy check and audit write some of them anew
        found = clone / "results" / kept.name
        if command in FEWER:
            shutil.copy(kept, found)
        assert found.read_text("utf-8") == kept.read_text("utf-8"), kept


def test_every_kind_of_block_has_a_rule():
    kinds = {block.language for page in shown.PAGES for block in shown.blocks_of(page)}
    assert kinds <= {"python", "text", "sh", "toml", *BUILT}, "say here how this kind is run"


def test_a_block_of_text_is_what_the_block_before_it_prints():
    for page in shown.PAGES:
        for before, block in pairwise([None, *shown.blocks_of(page)]):
            assert block.language != "text" or (before and before.language == "python"), block


@pytest.mark.parametrize("name", ["README.md", "CONTRIBUTING.md"])
def test_links_lead_somewhere(name):
    for link in re.findall(r"\]\((?!https?://)([^)]+)", (ROOT / name).read_text(encoding="utf-8")):
        file, _, section = link.partition("#")
        page = ROOT / (file or name)
        assert page.is_file(), link
        assert not section or section in sections_of(page), link


def sections_of(page):
    """The anchors of the headings of a page."""
    headings = re.findall(r"^#+ (.*)$", page.read_text(encoding="utf-8"), re.MULTILINE)
    return {re.sub(r"[^\w -]", "", heading.lower()).replace(" ", "-") for heading in headings}


def test_every_version_of_python_that_is_claimed_is_tested():
    claimed = re.findall(r"Python :: (3\.\d+)", (ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    workflow = (ROOT / ".github" / "workflows" / "ci.yml").read_text(encoding="utf-8")
    assert ast.literal_eval(re.search(r"python: (\[.*\])", workflow)[1]) == claimed
    assert "- run: .ci/run\n" in workflow


def test_blocks_that_show_files_show_files_that_are_there():
    for page in shown.PAGES:
        text = page.read_text(encoding="utf-8")
        for file in re.findall(
            r"^```\{(?:literal)?include\} (?!(?:../)?generated/)(\S+)", text, re.MULTILINE
        ):
            assert (page.parent / file).is_file(), f"{page}: {file}"


def test_every_name_of_the_package_has_its_place_in_the_reference():
    pages = "".join(page.read_text(encoding="utf-8") for page in (ROOT / "docs" / "api").glob("*.md"))
    told = set(re.findall(r"^\.\. auto\w+:: (\S+)$", pages, re.MULTILINE))
    assert {*swtstudy.__all__, "SwtAccessor"} - {"__version__"} <= told
