"""What is said of a sequence of blocks: how often it is repeated, and which load does the damage."""

import numpy as np
import pytest
import xarray as xr
from told import sayings

from swtstudy.study.units.life import Block
from swtstudy.study.units.results import sequence_words

NAN, INF = np.nan, np.inf
BLOCKS = (Block("start-up", 10.0), Block("running", 1e3), Block("start-up", 5.5))
ROUNDS = "10 of start-up, 1000 of running, 5.5 of start-up"
LOADS = {"load": ["start-up", "running"]}
#: Shares of two loads at two points.
SHARES = xr.DataArray([[0.25, 0.75], [0.9, 0.1]], LOADS, ("friction", "load"))


def at_points(*values: float) -> xr.DataArray:
    return xr.DataArray([*values], dims="friction")


WORDS = sayings(r"""
dict(s=at_points(1.0, 2.0))
dict(repetitions=at_points(20.0, 100.0), damage_share=SHARES)
» 10 of start-up, 1000 of running, 5.5 of start-up, repeated 20 to 100 times to a crack; running does 75% of
    the damage at friction = 0
dict(repetitions=at_points(100.0, 20.0), damage_share=SHARES)
» 10 of start-up, 1000 of running, 5.5 of start-up, repeated 20 to 100 times to a crack; start-up does 90% of
    the damage at friction = 1
dict(repetitions=at_points(NAN, 20.0), damage_share=SHARES)
» 10 of start-up, 1000 of running, 5.5 of start-up, repeated 20 times to a crack, unknown at 1 of 2 points;
    start-up does 90% of the damage at friction = 1
dict(repetitions=at_points(20.0, INF), damage_share=SHARES[:, 0].drop_vars("load"))
» 10 of start-up, 1000 of running, 5.5 of start-up, repeated 20 times to a crack, unknown at 1 of 2 points
dict(repetitions=at_points(INF, NAN), damage_share=SHARES)
» 10 of start-up, 1000 of running, 5.5 of start-up: no crack
dict(repetitions=at_points(INF, NAN), damage_share=SHARES, FS_repetitions=at_points(30.0, 40.0),
    FS_damage_share=SHARES)
» 10 of start-up, 1000 of running, 5.5 of start-up: no crack; repeated 30 to 40 times to a crack by Fatemi and
    Socie; running does 75% of the damage at friction = 0
dict(FS_repetitions=at_points(INF, INF), FS_damage_share=SHARES)
» 10 of start-up, 1000 of running, 5.5 of start-up: no crack by Fatemi and Socie
dict(repetitions=at_points(20.0, 30.0), damage_share=SHARES[:, 0].drop_vars("load"),
    repetitions_volume=at_points(4e3, INF))
» 10 of start-up, 1000 of running, 5.5 of start-up, repeated 20 to 30 times to a crack (worst point), 4000
    (mean over a volume)
""")


@pytest.mark.parametrize(("variables", "words"), WORDS)
def test_words_on_a_sequence(variables: str, words: list[str]) -> None:
    found = xr.Dataset(eval(variables))
    assert sequence_words(found, BLOCKS) == "".join(words)
    assert sequence_words(found, ()) == ""


def test_each_criterion_has_its_own_points() -> None:
    criteria = {"criterion": ["findley", "swt", "fatemi_socie"]}
    values = np.array([[NAN, 20.0, NAN], [NAN, 30.0, NAN]])
    times = xr.DataArray(values, criteria, ("friction", "criterion"))
    shares = SHARES.expand_dims(criterion=criteria["criterion"], axis=1)
    found = xr.Dataset({"repetitions": times, "damage_share": shares})
    words = "repeated 20 to 30 times to a crack; running does 75% of the damage at friction = 0"
    assert sequence_words(found, BLOCKS) == f"{ROUNDS}, {words}"


def test_many_blocks_are_counted() -> None:
    found = xr.Dataset({"repetitions": at_points(20.0), "damage_share": SHARES[:1, 0].drop_vars("load")})
    blocks = [Block(f"rig {k}", 1.0) for k in range(1, 8)]
    assert sequence_words(found, blocks) == "7, the first of rig 1, repeated 20 times to a crack"
    assert sequence_words(found, blocks[:6]).startswith("1 of rig 1, 1 of rig 2, 1 of rig 3, 1 of rig 4")
