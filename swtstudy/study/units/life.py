"""From SWT or the Fatemi–Socie parameter to load cycles, by strain–life constants, which may scatter."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Annotated, Any, ClassVar, NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from pydantic import ConfigDict, Field
from pydantic.dataclasses import dataclass as checked_dataclass

from swtstudy.study.units.rows import wrong_size
from swtstudy.vocabulary.arrays import FloatArray
from swtstudy.vocabulary.definition import read_numbers
from swtstudy.vocabulary.mistakes import Mistake, Report, literal, nearest, plain_number, refused
from swtstudy.vocabulary.quantities import COUNTED_SIZES

#: Newton steps at most: the logarithm of the relation is convex and monotone, so that they cannot miss; and
#: the last step of a logarithm, whose square is beyond rounding.
_STEPS, _ROUNDING = 60, 1e-9


def not_negative(name: str, values: object) -> FloatArray:
    """Read numbers ≥ 0, or NaN, that a user gave; a StudyError if any is negative."""
    numbers = read_numbers(name, values, "numbers ≥ 0")
    if (numbers < 0.0).any():
        raise refused(name, f"{np.nanmin(numbers):g}", "numbers ≥ 0")
    return numbers


class LifeCurve(NamedTuple):
    """Values of a criterion that a material stands for N cycles: a sum of two powers of 2N.

    Attributes
    ----------
    level, slopes
        Logarithms of the factors of both powers, and their exponents: of shape (2,), or (n, 2) for n draws of
        constants.
    """

    level: FloatArray
    slopes: FloatArray

    def at(self, cycles: ArrayLike) -> FloatArray:
        """The value at N cycles."""
        with np.errstate(divide="ignore", over="ignore"):  # inf cycles at 0, and 0 at inf
            logarithm = np.log(2.0 * not_negative("cycles", cycles))
            return np.asarray(np.exp(self.level + self.slopes * logarithm[..., None]).sum(axis=-1))

    def life(self, value: FloatArray) -> FloatArray:
        """Cycles at values ≥ 0, shape (n,), by Newton steps; the curve's shape is broadcast."""
        with np.errstate(divide="ignore"):
            level = self.level - np.log(value)[..., None]
        # Each term alone gives too short a life: from there Newton's steps only go up.
        x = np.max(-level / self.slopes, axis=-1)
        finite = np.isfinite(x)
        level, slopes = level[finite], np.broadcast_to(self.slopes, level.shape)[finite]
        for _ in range(_STEPS):
            # The larger one of both terms over the value is near 1: nothing overflows.
            terms = np.exp(level + slopes * x[finite][:, None])
            total = terms.sum(axis=-1)
            step = np.log(total) * total / (terms * slopes).sum(axis=-1)
            x[finite] -= step
            if not (np.abs(step) > _ROUNDING).any():
                break
        with np.errstate(over="ignore"):
            return np.asarray(0.5 * np.exp(x))

    def lives(self, value: FloatArray, counted: Sequence[FloatArray] = ()) -> FloatArray:
        """Rounds of the load to the initiation of a crack, see `FatigueConstants.rounds`.

        Parameters
        ----------
        value
            Values ≥ 0 of the criterion, of any shape.
        counted
            Nothing, or the ratios of counted cycles to the value, and their numbers, along two more axes.

        Returns
        -------
        array
            Shape: the draws' shape, then the shape of ``value``.
        """
        of_draws, flat = self.level.shape[:-1], value.reshape(-1)
        of_each = LifeCurve(self.level[..., None, :], self.slopes[..., None, :])
        found = of_each.life(flat)
        if counted:
            shape = (*value.shape, *counted[0].shape[-2:])
            ratio, number = (np.broadcast_to(v, shape).reshape(flat.size, *shape[-2:]) for v in counted)
            known = (ratio > 0.0) & (number > 0.0)
            damage = np.zeros((*of_draws, *known.shape))
            with np.errstate(divide="ignore"):  # no damage at 0, and no life at inf
                damage[..., known] = number[known] / of_each.life((flat[:, None, None] * ratio)[known])
                found = np.where(known.any(axis=(-2, -1)), 1.0 / damage.sum(axis=-1).max(axis=-1), found)
        return found.reshape((*of_draws, *value.shape))

    def rounds(self, name: str, value: Any, *counted: Any) -> Any:
        """See `FatigueConstants.rounds` and, of nothing counted, `cycles`: at a value that has a name."""
        import xarray as xr

        if not isinstance(value, xr.DataArray):
            return self.lives(not_negative(name, value), [np.asarray(each) for each in counted])
        dims = (*value.dims, *COUNTED_SIZES)
        both = [each.broadcast_like(value).transpose(*dims).values for each in counted]
        lives = self.lives(not_negative(name, value.values), both)
        return value.copy(data=lives).rename("cycles").drop_attrs(deep=False)


class _Constants:
    """Strain–life constants, of which the exponents alone are negative; they become plain numbers."""

    def __post_init__(self) -> None:
        report = Report()
        for name, value in vars(self).items():
            report += wrong_size(name, value)
            object.__setattr__(self, name, plain_number(value))
        report.refuse()

    @property
    def curve(self) -> LifeCurve:
        """The curve of lives that they give."""
        return curve_of(vars(self))


@dataclass(frozen=True)
class FatigueConstants(_Constants):
    """Strain–life constants of a material, after Basquin, Coffin and Manson.

    ε_a = (σf′/E) (2N)^b + εf′ (2N)^c

    Attributes
    ----------
    young_modulus, strength
        E and σf′ in the same unit of stress, > 0.
    strength_exponent
        b < 0.
    ductility
        εf′ > 0.
    ductility_exponent
        c < 0.
    """

    young_modulus: float
    strength: float
    strength_exponent: float
    ductility: float
    ductility_exponent: float

    def swt(self, cycles: ArrayLike) -> FloatArray:
        """SWT that a specimen stands for N cycles: (σf′²/E) (2N)^(2b) + σf′ εf′ (2N)^(b+c)."""
        return self.curve.at(cycles)

    def cycles(self, swt: Any) -> Any:
        """Strain cycles N to the initiation of a crack at a given SWT.

        A round of a load may have several: `rounds` counts these.

        The SWT of a contact is taken at its worst point, in a field that falls off within a fraction of the
        contact radius. Such a strictly local criterion gives very conservative lives: better ones come from
        averages over a volume, or from a critical distance (`swtstudy.solve` with critical_distance), whose
        size depends on the material. The SWT parameter also has one fixed sensitivity to the mean stress,
        σ_a(R = −1)/σ_a(R = 0) − 1 = 0.41, which a material need not have.

        Parameters
        ----------
        swt
            SWT in the unit of stress of the constants.

        Returns
        -------
        numpy.ndarray or xarray.DataArray
            Cycles, as ``swt`` is and of its shape; inf where that is 0, NaN where it is NaN or masked.

        Raises
        ------
        StudyError
            A ValueError, if an SWT is negative or no number.

        Examples
        --------
        >>> steel = FatigueConstants(200e3, 1000.0, -0.1, 0.5, -0.6)
        >>> float(steel.cycles(steel.swt(1e5)).round())
        100000.0
        """
        return self.curve.rounds("swt", swt)

    def rounds(self, swt: Any, counted: Any, counted_number: Any) -> Any:
        """Rounds of the load to the initiation of a crack: 1/Σ 1/N(SWT_i) over the strain cycles of a round.

        The place and plane with the largest sum decide.

        Parameters
        ----------
        swt
            SWT as for `cycles`, or a mean of it over a critical distance, whose cycles are taken to have the
            same ratios.
        counted, counted_number
            SWT_i over SWT, and how many cycles have it, along two more axes than ``swt``, places and cycles,
            as results of studies with [material] have them; NaN where there are no more. If there are none
            at all a round counts as one cycle.

        Returns
        -------
        numpy.ndarray or xarray.DataArray
            A DataArray if ``swt`` is one: dimensions go by their names then.

        Examples
        --------
        >>> steel = FatigueConstants(200e3, 1000.0, -0.1, 0.5, -0.6)
        >>> float(steel.rounds(steel.swt(1e5), [[1.0, 0.9]], [[4.0, np.nan]]).round())
        25000.0
        """
        return self.curve.rounds("swt", swt, counted, counted_number)


@dataclass(frozen=True)
class ShearConstants(_Constants):
    """Strain–life constants of a material in torsion.

    γ_a (1 + k σ_n/σ_y) = (τf′/G) (2N)^b + γf′ (2N)^c

    Attributes
    ----------
    shear_modulus, strength
        G and τf′ in the same unit of stress, > 0.
    strength_exponent
        b < 0.
    ductility
        γf′ > 0.
    ductility_exponent
        c < 0.
    """

    shear_modulus: float
    strength: float
    strength_exponent: float
    ductility: float
    ductility_exponent: float

    @classmethod
    def estimated(cls, tensile: FatigueConstants, poisson_ratio: float) -> ShearConstants:
        """Estimate them from tensile constants: τf′ = σf′/√3, γf′ = √3 εf′, and the same exponents."""
        ν, root = plain_number(poisson_ratio), math.sqrt(3.0)
        if not -1.0 < ν <= 0.5:
            raise refused("poisson_ratio", literal(poisson_ratio), "a number in (-1, 0.5]")
        shear_modulus, strength = tensile.young_modulus / (2.0 + 2.0 * ν), tensile.strength / root
        b, c = tensile.strength_exponent, tensile.ductility_exponent
        return cls(shear_modulus, strength, b, root * tensile.ductility, c)

    def parameter(self, cycles: ArrayLike) -> FloatArray:
        """The Fatemi–Socie parameter, a strain, that a specimen stands for N cycles."""
        return self.curve.at(cycles)

    def cycles(self, parameter: Any) -> Any:
        """Cycles N to the initiation of a crack at a given Fatemi–Socie parameter, a strain.

        Parameters
        ----------
        parameter
            γ_a (1 + k σ_n/σ_y): s E* δ0/(a_H G), or what `swtstudy.criterion_of_history` finds, over G.

        Returns
        -------
        numpy.ndarray or xarray.DataArray
            Cycles, as ``parameter`` is and of its shape; inf where that is 0, NaN where it is NaN or masked.

        Raises
        ------
        StudyError
            A ValueError, if a parameter is negative or no number.

        Examples
        --------
        >>> steel = ShearConstants.estimated(FatigueConstants(200e3, 1000.0, -0.1, 0.5, -0.6), 0.3)
        >>> float(steel.cycles(steel.parameter(1e5)).round())
        100000.0
        """
        return self.curve.rounds("parameter", parameter)

    def rounds(self, parameter: Any, counted: Any, counted_number: Any) -> Any:
        """Rounds of the load to the initiation of a crack, as `FatigueConstants.rounds`."""
        return self.curve.rounds("parameter", parameter, counted, counted_number)


def curve_of(values: Mapping[str, Any]) -> LifeCurve:
    """The curve by strain–life constants by name, numbers or n draws: an elastic and a plastic term."""
    b, c = values["strength_exponent"], values["ductility_exponent"]
    strength, ductility = np.log(values["strength"]), np.log(values["ductility"])
    if "shear_modulus" in values:
        columns = strength - np.log(values["shear_modulus"]), ductility, b, c
    else:
        columns = 2.0 * strength - np.log(values["young_modulus"]), strength + ductility, 2.0 * b, b + c
    stacked = np.stack(np.broadcast_arrays(*columns), axis=-1)
    return LifeCurve(stacked[..., :2], stacked[..., 2:])


class Scattered(NamedTuple):
    """A constant that may scatter: whether in torsion, its name in the constants, and its bodies, 0 and 1."""

    torsion: bool
    constant: str
    bodies: tuple[int, ...]


#: Constants that may scatter. The name of a constant in torsion begins with `TORSION`, the name of a constant
#: of one body ends in `_1` or `_2`.
CONSTANTS, TORSION = ("strength", "strength_exponent", "ductility", "ductility_exponent"), "shear_"
SCATTERED = {
    f"{TORSION * torsion}{name}{end}": Scattered(torsion, name, bodies)
    for end, bodies in (("", (0, 1)), ("_1", (0,)), ("_2", (1,)))
    for torsion in (False, True)
    for name in CONSTANTS
}


@dataclass(frozen=True)
class Scatter:
    """Draws of constants of the materials of both bodies.

    Attributes
    ----------
    names
        The constants that scatter, of `SCATTERED`.
    draws
        The values of each, all of one length.
    target
        A life in load cycles, before which the probability of a crack is asked for; 0 for none.
    """

    names: tuple[str, ...]
    draws: tuple[tuple[float, ...], ...]
    target: float = 0.0

    def curve(
        self, constants: FatigueConstants | ShearConstants, body: int, tensile: FatigueConstants | None = None
    ) -> LifeCurve:
        """The curves of a body, 0 or 1, by each draw.

        Shear constants that are estimated from tensile ones scatter in proportion to these.
        """
        values = {name: np.full(len(self.draws[0]), value) for name, value in vars(constants).items()}
        in_torsion = isinstance(constants, ShearConstants) and tensile is None
        for key, draws in zip(self.names, np.array(self.draws), strict=True):
            torsion, name, bodies = SCATTERED[key]
            if torsion == in_torsion and body in bodies:
                ratio = getattr(constants, name) / getattr(tensile, name) if tensile else 1.0
                values[name] = draws * ratio
        return curve_of(values)


_ROUNDS = "a positive number of rounds"


@checked_dataclass(frozen=True, config=ConfigDict(extra="forbid", use_attribute_docstrings=True))
class Block:
    """A block of a sequence that repeats, for Miner's sum: rounds of a load."""

    #: Words for it as a whole, in messages.
    allowed: ClassVar[str] = "[[blocks]] with load and rounds"

    load: Annotated[str, "the name of a load"]
    """Name of a load; of a signal that keeps its cycles all of them in turn."""
    rounds: Annotated[float, _ROUNDS, Field(strict=True, gt=0.0, allow_inf_nan=False)]
    """Number of its rounds in each repetition of the sequence."""


def checked_blocks(rounds: Mapping[str, object], loads: Sequence[object]) -> tuple[Block, ...]:
    """Blocks of some rounds of each of the loads, by their names.

    Raises
    ------
    StudyError
        A ValueError with every mistake in them; also if one of the loads is in no block.
    """
    known, report = list(map(str, loads)), Report()
    if not isinstance(rounds, Mapping):
        raise refused("blocks", literal(rounds), f"rounds by the name of each load: {', '.join(known)}")
    report += [Mistake("blocks", literal(n), nearest(str(n), known, {})) for n in rounds if n not in known]
    for name, number in rounds.items():
        if not 0.0 < plain_number(number) < math.inf:
            report(f"blocks.{name}", literal(number), _ROUNDS)
    if left := [name for name in known if name not in rounds]:
        found = f"no rounds of {', '.join(map(literal, left))}"
        report("blocks", found, "rounds of each load, or none of these loads")
    report.refuse()
    return tuple(Block(name, plain_number(number)) for name, number in rounds.items())
