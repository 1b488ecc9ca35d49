"""Blocks of stationary loads, run one after the other again and again: Miner's sum of their damage."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from swtstudy.points.values import index_at
from swtstudy.vocabulary.mistakes import Mistake, Report, literal, nearest, plain_number
from swtstudy.vocabulary.wording import number_words, numbers_words

if TYPE_CHECKING:
    import xarray as xr

    from swtstudy.points.values import Value

#: In names of what is made of a life, in the place of that.
REPETITIONS, SHARE, LIFE = "repetitions", "damage_share", "cycles"
#: What is before these in names, and whose criterion that is in words.
CRITERIA = {"": "", "FS_": " by Fatemi and Socie"}
#: What is allowed as a number of rounds.
ROUNDS = "a positive number of rounds"


@dataclass(frozen=True)
class Block:
    """Rounds of one load within a sequence.

    Attributes
    ----------
    load
        Name of the load.
    rounds
        How many in each repetition of the sequence.
    """

    load: str
    rounds: float


def checked_blocks(rounds: Mapping[str, object], loads: Sequence[Value]) -> tuple[Block, ...]:
    """Blocks of some rounds of each of the loads, by their names.

    Raises
    ------
    StudyError
        A ValueError with every mistake in them; also if one of the loads is in no block.
    """
    known = list(map(str, loads))
    report = Report()
    if not isinstance(rounds, Mapping):
        report("blocks", literal(rounds), f"rounds by the name of each load: {', '.join(known)}")
        report.refuse()
    report += [Mistake("blocks", literal(n), nearest(str(n), known, {})) for n in rounds if n not in known]
    for name, number in rounds.items():
        report += wrong_rounds(number, f"blocks.{name}")
    if left := [name for name in known if name not in rounds]:
        found = f"no rounds of {', '.join(map(literal, left))}"
        report("blocks", found, "rounds of each load, or none of these loads")
    report.refuse()
    return tuple(Block(name, plain_number(number)) for name, number in rounds.items())


def wrong_rounds(rounds: object, key: str) -> list[Mistake]:
    """Return the mistake in a number of rounds."""
    sound = 0.0 < plain_number(rounds) < np.inf
    return [] if sound else [Mistake(key, literal(rounds), ROUNDS)]


def lives_in(names: Sequence[str]) -> Iterator[tuple[str, str, str]]:
    """The lives among data variables, and the names of what blocks make of each."""
    for name in names:
        start, life, end = name.partition(LIFE)
        if life and start in CRITERIA and end[:1] in ("", "_"):
            yield name, f"{start}{REPETITIONS}{end}", f"{start}{SHARE}{end}"


def miner(
    dataset: xr.Dataset, blocks: Sequence[Block], loads: Sequence[Value]
) -> dict[str, tuple[Any, Any, dict[str, Any]]]:
    """Repetitions of a sequence to a crack, and the share of each load in its damage, for every life.

    D = Σ n_k / N_k, with n_k rounds of load k in the sequence and N_k rounds of it alone to a crack.

    Parameters
    ----------
    dataset
        Lives of each load, along ``load`` if there are several.
    blocks
        The sequence.
    loads
        The loads in their order.

    Returns
    -------
    dict
        Dimensions, values and attributes by name.
    """
    rounds = np.array([sum(each.rounds for each in blocks if each.load == str(load)) for load in loads])
    found = {}
    for name, repetitions, share in lives_in(list(map(str, dataset.data_vars))):
        life = dataset[name]
        along = "load" if "load" in life.dims else None
        axis = life.dims.index("load") if along else -1
        values = life.values if along else life.values[..., None]
        lengths = [1] * values.ndim
        lengths[axis] = len(rounds)
        damage = rounds.reshape(lengths) / values
        whole = damage.sum(axis=axis, keepdims=True)
        with np.errstate(divide="ignore", invalid="ignore"):  # no damage, no end
            times, of_each = (1.0 / whole).squeeze(axis), damage / whole
        dims = tuple(dim for dim in life.dims if dim != "load")
        where = life.attrs["long_name"].removeprefix("rounds to a crack")
        below = ", ".join(filter(None, ("seq", *(part.strip("_") for part in name.split(LIFE)))))
        words = _words(f"repetitions to a crack{where}", rf"N_\mathrm{{{below}}}", REPEATED)
        found[repetitions] = dims, times, words
        words = _words(f"share of the damage{where}", "D_k/D", SHARED)
        found[share] = life.dims, of_each if along else of_each.squeeze(axis), words
    return found


_NO_CRACK = "no crack"


def sequence_words(dataset: xr.Dataset, blocks: Sequence[Block]) -> str:
    """Say how often a sequence is repeated to a crack, and which load does most of the damage.

    By each criterion that has lives, without means over a critical distance, at the worst place; empty if
    there are none.
    """
    rounds = ", ".join(f"{number_words(each.rounds)} of {each.load}" for each in blocks)
    known = {start: by for start, by in CRITERIA.items() if f"{start}{REPETITIONS}" in dataset}
    several = [
        _to_a_crack(dataset[f"{start}{REPETITIONS}"], dataset[f"{start}{SHARE}"], by)
        for start, by in known.items()
    ]
    if not several or not rounds:
        return ""
    return f"{rounds}{':' if several[0].startswith(_NO_CRACK) else ','} {'; '.join(several)}"


def _to_a_crack(times: xr.DataArray, shares: xr.DataArray, by: str) -> str:
    """One life in `sequence_words`; points of other criteria do not have it."""
    if "criterion" in times.dims:
        times = times.dropna("criterion", how="all")
        shares = shares.sel(criterion=times.criterion)
    known = times.values[np.isfinite(times.values)]
    if not known.size:
        return f"{_NO_CRACK}{by}"
    ends = dict.fromkeys(numbers_words((known.min(), known.max()), 2))
    lost = times.size - known.size
    words = f"repeated {' to '.join(ends)} times to a crack{by}"
    words += f", unknown at {lost} of {times.size} points" if lost else ""
    share = shares.isel(index_at(times, int(np.nanargmin(times.values))))
    if not share.ndim:
        return words
    most = share[int(share.values.argmax())]
    return f"{words}; {most.coords['load'].item()} does {float(most):.0%} of the damage"


#: What is said of both.
REPEATED = (
    "repetitions of the sequence of blocks to the initiation of a crack, by Miner's sum of their damage, "
    "each at its own worst place: where these differ, the life is longer"
)
SHARED = "share of a load's rounds in the damage of a repetition of the sequence of blocks"


def _words(name: str, symbol: str, comment: str) -> dict[str, Any]:
    return {"long_name": name, "units": "1", "symbol": symbol, "comment": comment}
