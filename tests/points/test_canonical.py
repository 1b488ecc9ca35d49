from dataclasses import fields

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.lib.recfunctions import unstructured_to_structured
from oracles.profiles import INDENTERS

from swtstudy.mechanics.points import Points
from swtstudy.points.canonical import (
    COLUMNS,
    LOAD_COLUMNS,
    NAMES,
    NUMBERS,
    RATIO_COLUMNS,
    ROW,
    SHARED_COLUMNS,
    code_of,
    describe_point,
    group_rows,
    points_from,
    value_of,
)
from swtstudy.points.reading import read_grid
from swtstudy.points.unique import block_ends, loads, unique_points, weights
from swtstudy.runner.chunk import chunks
from swtstudy.vocabulary.choices import FAMILIES, Family
from swtstudy.vocabulary.parameters import PAIRS, PARAMETERS


def grid_of(fixed=None, **axes):
    grid, mistakes = read_grid(fixed or {}, axes)
    assert not mistakes, mistakes
    return grid


def count(fixed=None, **axes):
    return len(unique_points(grid_of(fixed, **axes)).table)


def test_values_are_told_apart_by_twelve_digits():
    one, _ = grid_of({"friction": 0.2}).canonical()
    other, _ = grid_of({"friction": 0.1 + 0.1 + 1e-16}).canonical()
    third, _ = grid_of({"friction": 0.2 + 1e-9}).canonical()
    assert (one == other).all()
    assert (one != third).any()


def test_the_columns_are_the_rows_of_the_table_of_parameters():
    of_load = "load_cost", "load", "p", "q", "normal_amplitude", "tangential_amplitude", "phase"
    assert ("control", *of_load) == LOAD_COLUMNS
    shapes = ("flat_radius", "flat_half_width", "waviness_amplitude", "wavelength", "exponent")
    # Blocks are cut along this order, and the last digits of a value depend on its block.
    extra = ("bulk_stress_amplitude", "bulk_stress_mean", "bulk_stress_phase", "walker_exponent")
    extra = (*extra, "normal_sensitivity")
    assert ("profile", "criterion", *LOAD_COLUMNS, *shapes, "friction", "poisson_ratio", *extra) == COLUMNS
    assert {*COLUMNS} - {"control", "load_cost", "p", "q"} == {*PARAMETERS} - {"frequency_ratio", *PAIRS}
    table, _ = grid_of({"profile": "rounded_punch", "flat_radius": 0.5, "frequency_ratio": "3/2"}).canonical()
    assert describe_point(table[0], {}) == (
        "profile=rounded_punch, flat_radius=0.5, frequency_ratio=3/2, normal_amplitude=0.75, "
        "tangential_amplitude=0.833333, phase=0, friction=0.3, poisson_ratio=0.3"
    )


def test_a_point_of_the_solver_has_every_column_under_its_name():
    assert {one.name for one in fields(Points)} == {
        "profile",
        "shape",
        "control",
        "path",
        "criterion",
        *RATIO_COLUMNS,
        *NUMBERS,
    }
    for family in FAMILIES.values():
        table = np.array([tuple(2.0 + np.arange(len(COLUMNS)))], ROW)
        table["profile"], table["criterion"] = code_of(family.name), code_of("findley", "criterion")
        table["control"] = table["load"] = 0.0
        points = points_from(table, {})
        assert points.profile == family.name
        assert (*points.shape,) == family.shape
        for name in (*RATIO_COLUMNS, *NUMBERS, *family.shape):
            values = points.shape[name] if name in points.shape else getattr(points, name)
            assert values == [COLUMNS.index(name) + 2]
        words = dict(part.split("=") for part in describe_point(table[0], {}).split(", "))
        assert {*words} == {"profile", "criterion", "frequency_ratio", *NUMBERS, *family.shape}


def test_a_profile_keeps_its_number():
    """Parts of archives that were written before count on these."""
    first = ("paraboloid", "rounded_punch", "truncated_paraboloid", "wavy_paraboloid")
    assert first == NAMES[:4]
    assert [code_of(name) for name in first] == [0.0, 1.0, 2.0, 3.0]
    assert {value_of(code_of(name), {}) for name in FAMILIES} == {*FAMILIES} == {*NAMES}


PHASES = [i * np.pi / 72 for i in range(145)]  # 2.5° steps over 0…2π


@pytest.mark.parametrize(
    ("ratio", "distinct"), [("1/4", 144), ("1/2", 144), ("1", 72), ("3/2", 48), ("2", 36), ("3", 24)]
)
def test_symmetric_phases_are_one_point(ratio, distinct):
    assert count({"frequency_ratio": ratio}, phase=PHASES) == distinct


@given(st.integers(1, 12), st.integers(1, 12), st.integers(-20, 20), st.integers(-20, 20), st.integers(1, 36))
def test_the_phase_folds_whatever_its_rounding_error(p, q, numerator, turns, denominator):
    ratio = np.float64(p) / q
    p, q = int(p // np.gcd(p, q)), int(q // np.gcd(p, q))
    phase = np.pi * numerator / denominator
    period = (2 if q % 2 == 0 else 1) * np.pi / p
    first, mirrored = grid_of({"frequency_ratio": ratio, "phase": phase}).canonical()
    second, mirrored_again = grid_of({"frequency_ratio": ratio, "phase": phase + turns * period}).canonical()
    assert (first == second).all()
    assert (mirrored[0] ^ mirrored_again[0]) == (q % 2 == 1 and turns % 2 == 1)
    assert 0 <= first["phase"][0] < period


@pytest.mark.parametrize("indenter", [one for one in INDENTERS if FAMILIES[one.profile].plain], ids=str)
def test_a_plain_shape_is_the_paraboloid(indenter):
    name, value = FAMILIES[indenter.profile].plain
    plain, _ = grid_of({"profile": indenter.profile, **indenter.shape, name: value}).canonical()
    assert (plain == grid_of().canonical()[0]).all()
    near = PARAMETERS[name].lower + 1e-9 if value == PARAMETERS[name].lower else value * (1 + 1e-9)
    other, _ = grid_of({"profile": indenter.profile, **indenter.shape, name: near}).canonical()
    assert other[name][0] == near
    # Whatever else the shape has.
    axes = {other: [length, 1.1 * length] for other, length in indenter.shape.items() if other != name}
    assert count({"profile": indenter.profile, name: value}, **axes) == 1


def test_a_plain_value_may_be_any(monkeypatch):
    """As the exponent 2 of a power law would be."""
    family = Family("rounded_punch", ("flat_radius",), plain=("flat_radius", 0.5))
    monkeypatch.setitem(FAMILIES, "rounded_punch", family)
    profiles = ["paraboloid", "rounded_punch"]
    table = unique_points(grid_of(profile=profiles, flat_radius=[0, 0.5, 1])).table
    found = table[["profile", "flat_radius"]].tolist()
    assert found == [(code_of("paraboloid"), 0), *((code_of("rounded_punch"), b) for b in (0, 1))]


def test_what_does_not_matter_makes_no_new_point():
    profiles = ["paraboloid", "rounded_punch", "truncated_paraboloid"]
    assert count(profile=profiles, flat_radius=[0, 0.5]) == 3  # b = 0 is the paraboloid
    wavy = {"profile": "wavy_paraboloid", "waviness_amplitude": 0}
    assert count(wavy, wavelength=[5, 6]) == 1
    assert count({"normal_amplitude": 0}, phase=[0, 1], frequency_ratio=[1, 2, "1/2"]) == 1


def test_groups_are_the_distinct_rows():
    table = np.random.default_rng(0).integers(0, 3, (500, 4)).astype(float)
    first, group = group_rows(unstructured_to_structured(table))
    assert (table[first][group] == table).all()
    assert len(first) == len(np.unique(table, axis=0))
    assert (table[first] == np.unique(table, axis=0)).all()


def test_slabs_of_a_grid_are_the_grid():
    grid = grid_of(phase=PHASES[:7], profile=["paraboloid", "rounded_punch"], flat_radius=[0.1, 0.2, 0.3])
    whole, mirrored = grid.canonical()
    parts = [grid.canonical(start, min(start + 5, grid.size)) for start in range(0, grid.size, 5)]
    assert (np.concatenate([rows for rows, _ in parts]) == whole).all()
    assert (np.concatenate([flags for _, flags in parts]) == mirrored).all()


def test_a_grid_in_slabs_has_the_points_of_the_whole(monkeypatch):
    grid = grid_of(phase=PHASES[:7], profile=["paraboloid", "rounded_punch"], flat_radius=[0.1, 0.2, 0.3])
    whole = unique_points(grid)
    monkeypatch.setattr("swtstudy.points.unique._SLAB", 5)
    parts = unique_points(grid)
    assert (parts.table == whole.table).all()
    assert (parts.index == whole.index).all()
    assert (parts.mirrored == whole.mirrored).all()


@given(st.integers(0, 100), st.integers(0, 2**36 - 1))
def test_chunks_cover_the_wanted_points_once_in_whole_blocks(size, bits):
    profiles = ["paraboloid", "rounded_punch", "truncated_paraboloid"]
    axes = {"profile": profiles, "flat_radius": [0.1, 0.5], "phase": [0, 1, 2], "friction": [0.1, 0.2, 0.3]}
    points = unique_points(grid_of(**axes))
    table = points.table
    wanted = np.array([bool(bits >> i & 1) for i in range(len(table))])
    cut = list(chunks(points, wanted, lambda: size))
    rows = np.concatenate([chunk.rows for chunk in cut]) if cut else []
    assert (np.sort(rows) == np.flatnonzero(wanted)).all()
    assert all((chunk.table == table[chunk.rows]).all() for chunk in cut)
    block = np.searchsorted(block_ends(table), np.arange(len(table)), "right")
    for chunk in cut:
        assert sum(chunk.lengths) == len(chunk)
        parts = np.split(block[chunk.rows], np.cumsum(chunk.lengths)[:-1])
        assert all(len(set(part)) == 1 for part in parts)
        assert weights(chunk.table).sum() <= size or len(chunk.lengths) == 1
    assert len({chunk.name for chunk in cut}) == len(cut)
    assert loads(table) == 3


def test_blocks_have_one_profile_and_frequency_ratio_and_end_between_loads(monkeypatch):
    monkeypatch.setattr("swtstudy.points.unique._BLOCK_SIZE", 256)
    phases = [i / 10 for i in range(5)]
    axes = {"phase": phases, "friction": [i / 25 for i in range(1, 26)], "frequency_ratio": [1, "1/4"]}
    table = unique_points(grid_of(**axes)).table
    blocks = np.split(table, block_ends(table)[:-1])
    assert all(len(np.unique(block[[*SHARED_COLUMNS]])) == 1 for block in blocks)
    # Two and three loads with a ratio of 1; with 1/4 one, and cuts where that would be too small a block.
    assert [len(block) for block in blocks] == [50, 75, 25, 25, 43, 32]
    assert sum(map(len, blocks)) == len(table)


def test_blocks_of_long_cycles_are_cut_first_and_of_these_the_largest(monkeypatch):
    # 1/4, then 2, the first block of which lacks ten points, then 1: the table has 1, 1/4, 2.
    monkeypatch.setattr("swtstudy.points.unique._BLOCK_SIZE", 256)
    points = unique_points(grid_of(friction=[i / 200 for i in range(1, 101)], frequency_ratio=[1, "1/4", 2]))
    wanted = np.ones(len(points.table), dtype=bool)
    wanted[np.flatnonzero(weights(points.table) == 3)[:10]] = False
    cut = list(chunks(points, wanted, lambda: 1))
    assert [int(weights(chunk.table).sum()) for chunk in cut] == [250, 250, 150, 120, 100, 100]


def test_a_load_that_is_larger_than_a_block_is_cut(monkeypatch):
    monkeypatch.setattr("swtstudy.points.unique._BLOCK_SIZE", 512)
    table = unique_points(grid_of(friction=[i / 100 for i in range(1, 601)])).table
    assert np.diff(block_ends(table), prepend=0).tolist() == [150, 150, 150, 150]


def test_a_split_chunk_is_the_same_points():
    points = unique_points(grid_of(friction=[i / 10 for i in range(1, 71)]))
    (chunk,) = chunks(points, np.ones(70, bool), lambda: 1e9)
    parts = list(chunk.split())
    assert [len(part) for part in parts] == [35, 35]
    assert [part.rows.tolist() for part in parts[1].split()] == [list(range(35, 52)), list(range(52, 70))]
