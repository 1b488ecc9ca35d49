"""The numbers that the README and the pages say are those of the files in results."""

import csv
import re
import tomllib
from decimal import Decimal

import numpy as np
import shown
import xarray as xr
from folders import RESULTS, ROOT, STUDIES
from solved import REGIMES
from words import SAID

from swtstudy import Study, open_results, solve
from swtstudy.kernel.circle import SAFE_POISSON_RATIO
from swtstudy.kernel.point import NEAREST, TEARS

PAGES = {
    str(page.relative_to(ROOT)): " ".join(page.read_text(encoding="utf-8").split()) for page in shown.PAGES
}
NUMBER = r"(\d[\d,]*(?:\.\d+)?(?:e[+-]?\d+)?)"


class AtMost(float):
    """A value that is rounded up where it is said."""


def says(phrase: str, *values: float) -> None:
    """Hold a ``phrase``, with a number for each {}, against values as it rounds them, wherever it stands."""
    pattern = re.compile(NUMBER.join(map(re.escape, phrase.split("{}"))))
    found = [(page, each) for page, text in PAGES.items() for each in pattern.finditer(text)]
    assert found, f"{phrase!r} stands nowhere"
    for page, each in found:
        for word, value in zip(each.groups(), values, strict=True):
            shown_as = Decimal(word.replace(",", ""))
            unit = 10.0 ** shown_as.as_tuple().exponent
            away = float(shown_as) - value
            low, high = (0.0, unit) if isinstance(value, AtMost) else (-0.5 * unit, 0.5 * unit)
            message = f"{page}: {phrase!r}: {word}, found {value:.4g}"
            assert low - 1e-9 * unit <= away <= high + 1e-9 * unit, message


def lines(name: str) -> list[str]:
    return (RESULTS / name).read_text(encoding="utf-8").splitlines()


def tables(name: str) -> list[list[list[str]]]:
    """The tables of a Markdown file: rows of cells, the head among them."""
    found: list[list[list[str]]] = [[]]
    for line in lines(name):
        if not line.startswith("|"):
            found.append([])
        elif not line.startswith("|---"):
            found[-1].append([cell.strip() for cell in line.strip("|").split("|")])
    return [table for table in found if table]


def numbers(name: str, phrase: str) -> list[float]:
    """The numbers in the first line of a file that has the phrase, at its {}."""
    pattern = re.compile(r"\s*" + r"\s*".join(map(re.escape, phrase.split())).replace(r"\{\}", NUMBER))
    found = next(found for line in lines(name) if (found := pattern.search(line)))
    return [float(word.replace(",", "")) for word in found.groups()]


def test_suite() -> None:
    values, _ = numbers("suite.txt", "all: {} values in {} s")
    seconds, each = numbers("suite.txt", "processor time: {} s, {} ms a value")
    says("{} values at rtol 1e-4 with their archives, take {} s of processor time", values, seconds)
    says("(`python studies/checks/suite.py`): {} ms a value", each)
    archives = [open_results(RESULTS / f"figure{number}.nc") for number in range(3, 9)]
    assert sum(archive.s.size for archive in archives) == values


def test_plane_cost() -> None:
    (coarse,), (fine,) = (numbers("plane_cost.txt", f"rtol {rtol}: {{}}, ") for rtol in ("0.0001", "1e-06"))
    assert max(coarse, fine) <= 1.1
    says("A cylinder's value costs {} of the paraboloid's under the same forces, at 1e-6 {}", coarse, fine)


def test_scaling() -> None:
    points, rtol, q, p, memory, start = tables("scaling.md")
    cost = [dict(zip(*table, strict=True)) for table in (points, q, p)]
    alone, many, quarter = float(cost[0]["1"]), float(cost[0]["4096"]), float(cost[1]["4"])
    says("A point of Table 1 takes {} ms alone and {} ms among {}:", alone, many, 4096)
    powers = [float(line.split()[-1].rstrip(".")) for line in lines("scaling.md") if "power" in line]
    says("Ten times the accuracy costs {} times the time (the power {} of", 10 ** powers[1], powers[1])
    assert rtol[0][0] == "1/rtol"
    long = [1e-3 * float(each) for each in (cost[1]["32"], cost[1]["64"], cost[2]["64"])]
    says("{} ms at ω2/ω1 = 1/4, {} s at 1/32, {} s at 1/64, and {} s at 64", quarter, *long)
    says("grows like the power {} of q and {} of p", powers[2], powers[3])
    gigabytes = {row[0]: 1e-3 * float(row[1]) for row in memory[1:]}
    said = "{} points in a call take {} GB, two at ω2/ω1 = 32 take {} GB"
    says(said, 4096, gigabytes["4096, 1, 1"], gigabytes["2, 32, 1"])
    seconds = {row[0]: float(row[1]) for row in start[1:]}
    named = ("import swtstudy", "import swtstudy and the first value", "swtstudy --help")
    said = "`import swtstudy` takes {} s, with the first value {} s, `swtstudy --help` {} s"
    says(said, *(seconds[name] for name in named))


def test_accuracy() -> None:
    # After it there may be one of the points that miss s_error.
    table, *_ = tables("accuracy.md")
    (count,) = numbers("accuracy.md", "at {} random points a profile")
    says("At {} random points a profile", count)
    says("python studies/accuracy.py {}", count)
    of = {rtol: [row[2:] for row in table if row[1] == rtol] for rtol in ("1e-04", "1e-06", "1e-07")}
    largest = {rtol: AtMost(max(float(row[2]) for row in rows)) for rtol, rows in of.items()}
    median = AtMost(max(float(row[0]) for row in of["1e-04"]))
    said = "the error at rtol 1e-4 is {} at most and {} in the median, at 1e-6 {} at most"
    says(said, largest["1e-04"], median, largest["1e-06"])
    missed = {rtol: np.mean([float(row[3].rstrip("%")) for row in rows]) for rtol, rows in of.items()}
    assert missed["1e-04"] == missed["1e-06"] == 0
    says("At 1e-7, where rounding begins to show, it is {} at most and", largest["1e-07"])
    says("exceeds s_error at {} %", missed["1e-07"])


def test_chart() -> None:
    with (RESULTS / "accuracy_speed.csv").open(encoding="utf-8") as file:
        samples = [row for row in csv.DictReader(file) if row["scene"] != "Table 1"]

    def at(method: str, resolution: str, column: str = "relative error") -> list[float]:
        chosen = [row for row in samples if method in row["method"] and row["resolution"] == resolution]
        assert len(chosen) == len({row["scene"] for row in samples}) >= 3
        return [float(row[column]) for row in chosen]

    grid = [100 * error for error in at("fixed grids", "480 instants")]
    peers = [100 * error for error in at("half-space", "512² grid") + at("plane loop", "2° planes")]
    says("{} instants on fixed grids still miss s by {} to {} %", 480, min(grid), max(grid))
    said = "half-space and plane search at {} uniform instants by {} to {} %"
    says(said, 64, min(peers), max(peers))
    assert max(at("batches of 64", "rtol 1e-04")) < 1e-5
    seconds = [1e3 * each for each in at("batches of 64", "rtol 1e-04", "seconds a value")]
    said = "this solver asked for 1e-4 stays below 1e-5 there, in {} to {} ms a value"
    says(said, min(seconds), max(seconds))
    (table,) = tables("accuracy_speed.md")
    away = [abs(float(row[-1])) for row in table[1:]]
    says("a textbook grid of its own confirms it to {} to {}", min(away), max(away))


def test_models() -> None:
    paper, rig, varying = (
        {row[0]: [float(cell.rstrip(" %")) for cell in row[2:]] for row in table[1:-1]}
        for table in tables("models.md")
    )
    (count,) = numbers("models.md", "({} points each)")
    says("at {} random points of three scenes", count)
    moved, bulk = rig["stick zone not moved"], rig["without bulk stress"]
    assert rig["closed form, mean load"][1] < 1e-4
    says("SWT is {} % too low in the median and {} % at most", moved[0], moved[2])
    says("If the bulk stress is left out, SWT is {} % too low in the median", bulk[0])
    median, _, low, high = varying["closed form, mean load"]
    said = "The closed form is {} % off in the median, and between {} % too low and {} % too high"
    says(said, median, low, high)
    median, _, low, _ = paper["closed form, mean load"]
    says("The closed form is {} % off in the median, and up to {} % too low", median, low)
    median, _, low, high = paper["tangential extremes only"]
    assert high == 0.0
    says("it misses {} % in the median, {} % at most", median, low)
    median, _, low, _ = paper["plane fixed along x"]
    says("A plane fixed along x misses {} % in the median, but {} % at most", median, low)
    line, circle = (paper[name][2] for name in ("line: s", "circle: s_surface"))
    says("The line y = 0 misses {} % at most", line)
    says("`s_surface` costs little more and misses {} %", circle)
    means = [each["nonlocal mean"][0] for each in (paper, rig, varying)]
    says("it is {} to {} % below the largest SWT in the median", min(means), max(means))


def test_field() -> None:
    table = {row[0].split(" (")[0]: row[1:] for row in tables("field_speed.md")[0]}
    ours, hamilton = (float(table[name][0]) for name in ("this package", "Hamilton's closed form"))
    says(
        "The field takes about {} µs per point and instant, a third of the time of Hamilton's closed form",
        ours,
    )
    assert ours < hamilton / 3.0
    says("equals that form to {} p0", float(table["Hamilton's closed form"][1]))
    (refined,) = numbers("field_speed.md", "to rounding {} µs a point")
    says("to rounding, takes {} µs a point", refined)
    plain, low = numbers("field_speed.md", "281 planes takes {} µs (up to {} % low")
    says("search of 281 planes takes {} µs, and its values are up to {} % too low", plain, low)


def test_audit() -> None:
    found = xr.open_dataset(RESULTS / "audit_parameter_box.nc").load()
    names = found.verdict.attrs["flag_meanings"].split()
    looked = found.verdict != names.index("not_finite")
    off = found.isel(sample=np.flatnonzero(found.verdict == names.index("symmetry_line")))
    assert set(np.unique(found.verdict)) == {names.index(n) for n in ("none", "symmetry_line", "not_finite")}
    angle = np.degrees(np.arctan2(abs(off.body_y), abs(off.body_x)))
    says("solved {} random points of the parameter box", found.sizes["sample"])
    says("ν ≤ {} ({} points looked at)", 0.4, int((looked & (found.poisson_ratio <= 0.4)).sum()))
    assert (off.poisson_ratio > 0.4).all()
    said = "ν > {} ({} points): at {} of them it is on the surface off the line, {}° to {}° along the circle"
    high = int((looked & (found.poisson_ratio > 0.4)).sum())
    says(said, 0.4, high, off.sizes["sample"], float(angle.min()), float(angle.max()))
    says("swt is up to {} % higher", 100 * float(off.excess.max()))
    says("If ν > {} `s_surface` includes that circle", SAFE_POISSON_RATIO)
    known, is_off = found.s_surface / found.s - 1 > 1e-3, found.verdict == names.index("symmetry_line")
    says("It was greater at {} of these {} points", int((known & is_off).sum()), off.sizes["sample"])
    assert not (known & ~is_off).any()
    low = found.isel(sample=np.flatnonzero(found.remainder > 1e-3))
    said = "The body exceeds it at {} points by more than 0.1 %, by up to {} %"
    says(said, low.sizes["sample"], 100 * float(low.remainder.max()))
    other = np.abs(np.hypot(low.body_x, low.body_y) / abs(low.critical_x) - 1.0) > 1e-3
    says("at {} of them the maximum is on another circle", int(other.sum()))
    says("At the {} audited points it missed none", int(looked.sum()))


def test_overlooked() -> None:
    (table,) = tables("overlooked.md")
    assert all(row[2] == row[4] == "0" for row in table[1:])
    points = sum(int(row[1]) for row in table[1:])
    says("none in {} random points", points)
    says("{} random points a dense grid found no value above s by more than s_error", points)


def test_audit_of_bulk_stress() -> None:
    name = "audit_bulk_stress_box.md"
    (points,) = numbers(name, "{} points, each solved")
    says("there were {} more random points", points)
    enough = numbers(name, "the surface line is enough at {} of {} points")
    assert enough[0] == enough[1]
    says("the line is enough at {} of {} points", *enough)
    above = "The solver's s_surface is more than 0.1% above s at {} points: {} of the {} at which"
    says("greater than s at {} of the {} points at which the line is not enough", *numbers(name, above)[1:])
    said = "The body's maximum exceeds s_surface at {} points, by up to {}%"
    says("may be too low, at {} points by up to {} %", *numbers(name, said))
    found = xr.load_dataset(RESULTS / "audit_bulk_stress_box.nc")
    low, beneath = found.remainder > 1e-3, found.body_z > 1e-6
    says("at {} of them the maximum is beneath the surface", int((low & beneath).sum()))
    says("at the others, by up to {} %, another", 100.0 * float(found.remainder.where(low & ~beneath).max()))


def test_audit_of_criteria() -> None:
    found = xr.load_dataset(RESULTS / "audit_criteria_box.nc")
    misses = found.s_body > 1.001 * found.s
    inside = (found.friction >= 0.3) & (found.poisson_ratio >= 0.1) & (found.tangential_amplitude >= 0.1)
    points = found.sizes["sample"]
    says("[shear criteria](shear.md) there were {} random points", points)
    assert not (misses & inside).any()
    says("the line was enough at {} of these {} points", *2 * [int(inside.sum())])
    says("it was not at {} of {} points", int(misses.sum()), int((~inside).sum()))
    says("s being too low by up to a factor of {}", float((found.s_body / found.s).max()))
    low, beneath = found.remainder > 1e-3, found.body_z > 1e-6
    says("`s_surface` is too low at {} of these points", int(low.sum()))
    most = 100.0 * float(found.remainder.where(low & ~beneath).max())
    counts = int((low & beneath).sum()), int((low & ~beneath).sum())
    says("The maximum is beneath the surface at {}, and on it at {}, by up to {} %", *counts, most)
    ((_, *rows),) = tables("criteria.md")
    assert {row[3] for row in rows} == {"0"}
    says("of {} random points none was lower by more than s_error", sum(int(row[2]) for row in rows))


def test_stability() -> None:
    names = ("stability", "stability_small_motion", "stability_friction", "stability_thin_annulus")
    walks = {name: open_results(RESULTS / f"{name}.nc") for name in names}
    lost = {name: walk.regime == REGIMES.index("not_finite") for name, walk in walks.items()}
    for name, walk in walks.items():
        assert (np.isnan(walk.s) == lost[name]).all()
        elsewhere = (
            lost[name].sel(profile=lost[name].profile != "truncated_paraboloid")
            if lost[name].any()
            else lost[name]
        )
        assert not elsewhere.any()
    count, gone = sum(walk.s.size for walk in walks.values()), sum(int(each.sum()) for each in lost.values())
    said = "They have {} points: {} have a number, and {}, all of truncated paraboloids, the flag"
    says(said, count, count - gone, gone)
    ends = {
        "tangential_amplitude": "the tangential amplitude from {} to {}",
        "friction": "μ from {} to {}",
        "flat_radius": "b/a_H from {} to {}",
    }
    for (axis, phrase), name in zip(ends.items(), names[1:], strict=True):
        says(phrase + ("," if axis != "flat_radius" else "."), *walks[name][axis].values[[0, -1]])
    says("δA/δ0 through 1 to {},", float(walks["stability"].normal_amplitude.max()))
    small = walks["stability_small_motion"]
    relative = small.s_error / small.s
    worst = relative.where(relative == relative.max(), drop=True)
    rounded = small.tangential_amplitude.where((relative > 1.0001e-4).any("normal_amplitude"))
    said = "but where rounding shows: at tangential amplitudes up to {}, {} at {}."
    says(said, float(rounded.max()), float(relative.max()), float(worst.tangential_amplitude[0]))
    others = [walks[name].s_error / walks[name].s for name in names if name != "stability_small_motion"]
    assert max(float(each.max()) for each in others) < 1.0001e-4


def test_lateral_slip() -> None:
    rows = np.array([line.split() for line in lines("lateral_slip.txt")[5:]], dtype=float)
    steel, soft = (rows[rows[:, 0] == ν] for ν in (0.3, 0.5))
    changes = [float(np.abs(each[:, 4:]).max()) for each in (steel, soft)]
    says("slip at ν = 0.3 is up to {}° off the traction", steel[:, 2].max())
    says("Lateral tractions of up to {} μ p0", steel[:, 3].max())
    says("They change s by at most {} % at ν = 0.3 and by at most {} % at ν = 0.5", *changes)
    says("at ν = 0.3 they change s by at most {} %", changes[0])
    says("at most {} % of s at ν = 0.3, {} % at ν = 0.5", *changes)


def test_thresholds() -> None:
    text = lines("thresholds_35NCD16.txt")
    breaks = [number for number, line in enumerate(text) if not line]
    first, second, third = text[2 : breaks[0]], text[breaks[0] + 3 : breaks[1]], text[breaks[1] + 3 :]
    rows = {line.split()[0]: line.split()[1:] for line in first}
    tests = {
        name: [float(v) if v != "-" else 0.0 for v in row]
        for name, row in rows.items()
        if name[:2] in ("PF", "FF")
    }
    assert len(tests) == 16
    says("meet those of all sixteen tests within {} %", 1)
    assert max(abs(row[4] - 1.0) for row in tests.values()) < 0.01
    in_place = {line.split()[0]: float(line.split()[1]) for line in third if line.startswith("FF")}
    assert [*in_place] == [name for name, row in tests.items() if row[5] > 0.0]
    low = [100.0 * (1.0 - value / tests[name][-5]) for name, value in in_place.items()]
    says("of these six is lower by {} to {} % at the surface", min(low), max(low))
    mean, scatter = ([float(v) for v in rows[name]] for name in ("mean", "scatter"))
    said = "At the surface they are at {} on average, with a scatter of {} %"
    says(said, mean[-5], 100.0 * scatter[0])
    says("beneath the edge the average is {}, with a scatter of {} %", mean[-3], 100.0 * scatter[2])
    says("is {} of the published one on average", mean[2])
    peaks = [float(value) for value in next(line for line in second if line.startswith("mean")).split()[1:]]
    says(
        "it falls from {} of the yield strength on average at the surface to {} at 20 µm", peaks[0], peaks[-1]
    )
    sizes = [row[0] for row in tests.values()]
    says("half-widths from {} to {} mm", min(sizes), max(sizes))


def test_polygons() -> None:
    (table, _) = tables("loads.md")
    counts = [int(cell.removeprefix("k = ")) for cell in table[0][1:]]
    worst = {k: max(float(row[1 + j]) for row in table[1:]) / k**2 for j, k in enumerate(counts)}
    assert all(each < 3.0 / k for k, each in worst.items())
    said = "by up to {} % with {} points and by up to {} % with {} points"
    says(said, 100 * worst[32], 32, 100 * worst[512], 512)


def test_lives() -> None:
    rows = [line.split() for line in lines("physical.txt") if re.match(r"\s*\d+°", line)]
    worst, mean = (np.array([float(row[column]) for row in rows]) for column in (2, 3))
    says("the best phase gives six times the life of the worst")
    assert round(worst.max() / worst.min()) == 6
    times = mean / worst
    said = "averaged over a radius of {} µm they are about {} to {} times as long there"
    tens = round(times.min(), -1), round(times.max(), -1)
    says(said, 50, *tens)
    says("lives in the [example](units.md#a-worked-example) are {} to {} times as long", *tens)


def test_checks() -> None:
    kills = [numbers("kills.txt", phrase)[0] for phrase in ("{} kills, each", "{} kills around")]
    says("[{} kills of a run and {} of the archive's write]", *kills)
    flips, other = (numbers("flips.txt", phrase)[0] for phrase in ("{} flips of", "{} other values"))
    assert numbers("flips.txt", "{} a crash") == [0]
    says(
        "of [{} flips of a byte](../results/flips.txt) in the index of HDF5, which has none, {}", flips, other
    )
    assert any("and never a saved one" in line for line in lines("kills.txt"))
    assert any("the whole old archive or the whole new one" in line for line in lines("kills.txt"))
    (megabytes,) = next(
        [float(line.split()[5])] for line in lines("million.txt") if line.startswith("1000000 ")
    )
    says("take {} GB; and the runner's", 1e-3 * megabytes)
    says("of {} µs a point", *numbers("overhead.txt", "the runner takes {} µs of processor time"))


def test_statements() -> None:
    said = "over all of the paper's studies {} % of the points slide as a whole once a cycle"
    says(said, *numbers("statements.md", "gross slip {}%"))
    assert solve(rtol=1e-2).regime == REGIMES.index("partial_slip")  # Table 1's own point
    falls, curves = numbers("statements.md", "| s falls on {} of {} random curves")
    (most,) = numbers("statements.md", f"| s falls on {falls:g} of {curves:g} random curves, by up to {{}}%")
    says("s falls with it on {} of {} random curves, by up to {} %", falls, curves, most)
    says("{} of them in gross slip", *numbers("statements.md", "in gross slip s falls on {} of"))


def test_extremes() -> None:
    """What the curves of the studies miss of their extremes, in all that is drawn and measured."""
    rows = [line.split() for line in lines("extremes.txt") if re.match(r"(figure|other)", line)]
    assert [row[0] for row in rows] == [*(f"figure{number}" for number in range(3, 9)), "other_frequencies"]
    for name, axis, points, missed, *_ in rows:
        study = Study.from_toml(STUDIES / f"{name}.toml")
        assert len(study.grid.axes[axis]) == int(points), name
        assert float(missed) <= 1e-3, name
    says(
        "[miss their extremes](../results/extremes.txt) by {} % at most",
        AtMost(max(100 * float(row[3]) for row in rows)),
    )


def test_best_load() -> None:
    (table,) = tables("best_load.md")
    change = {(row[0], row[1]): abs(float(row[5].split()[0])) for row in table[1:]}
    of = {(row[0], row[1]): float(row[2]) for row in table[1:]}
    assert of["1/2", "best"] == of["1/2", "worst"]
    says("At ω2/ω1 = 1/2 the best one takes {} % off s", change["1/2", "best"])
    says("the worst, which is as large, adds {} %", change["1/2", "worst"])
    says("At 1 the best takes off {} %, and the worst adds {} %", change["1", "best"], change["1", "worst"])
    assert change["3/2", "best"] == change["2", "best"] == 0.0
    says("none helps, and the worst adds {} and {} %", change["3/2", "worst"], change["2", "worst"])


def test_limits() -> None:
    says("contacts with \\|β\\|/μ above {} are warned of, above {} refused", 0.06, SAID["similar"]["default"])
    says("(exit code {}, `--retry-failed`)", 3)
    says("never on an oblique plane ({} % of s left aside)", 0.1)
    says("slide with μ ≥ {}", TEARS)
    says("a table whose packed values are larger than {} MB", 1.2)
    says("is nearer to b than {} of the face or of the ring beside it", NEAREST)


def test_versions() -> None:
    with (ROOT / "pyproject.toml").open("rb") as file:
        given = tomllib.load(file)["project"]["dependencies"]
    lowest = dict(each.partition(",")[0].split(">=") for each in given)
    (said,) = re.findall(r"run together, on Python 3.11: (.*?\d)\. ", PAGES["docs/develop.md"])
    tested = dict(each.split() for each in said.split(", "))
    assert tested.keys() == lowest.keys()
    for name, version in lowest.items():
        assert f"{tested[name]}.".startswith(f"{version}."), name


def test_the_first_screen() -> None:
    figure4 = open_results(RESULTS / "figure4.nc")
    factor = float(figure4.swt.extrema("phase").ratio.max())
    says("The phase alone changes s by a factor of {}.", factor)
    seconds = numbers("suite.txt", "figure3: {} values, archive after {} s")
    says("{} values in {} s on two cores", *seconds)
    text = (RESULTS / "statements.md").read_text(encoding="utf-8")
    statements = map(int, re.findall(r"\*\*(\d+) statements: (\d+) hold, (\d+) do not", text)[0])
    says(
        "`swtstudy check` compares {} statements of the paper with computed values: {} agree, {} do not",
        *statements,
    )
    alone, *_, many = tables("scaling.md")[0][1][1:]
    said = "The point of Table 1 takes {} ms alone and {} ms in a batch of {}"
    says(said, float(alone), float(many), 4096)
    error = max(float(row[4]) for row in tables("accuracy.md")[0] if row[1] == "1e-04")
    says("With the default tolerance the error was at most {} at random points", AtMost(error))
