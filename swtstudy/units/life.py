"""From SWT to cycles: the SWT–life relation of the strain–life constants."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from swtstudy.mistakes import Mistake, StudyError, literal, plain_number
from swtstudy.numbers import read_numbers

#: Newton steps: the logarithm of the relation is convex and monotone, so that they cannot miss.
_STEPS = 60


@dataclass(frozen=True)
class FatigueConstants:
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

    def __post_init__(self) -> None:
        mistakes = []
        for name, value in vars(self).items():
            sign = -1.0 if name.endswith("exponent") else 1.0
            if not 0.0 < sign * plain_number(value) < np.inf:
                allowed = "a negative number" if sign < 0.0 else "a positive number"
                mistakes.append(Mistake(name, literal(value), allowed))
        if mistakes:
            raise StudyError(mistakes)

    def swt(self, cycles: ArrayLike) -> NDArray[np.float64]:
        """SWT that a specimen stands for N cycles: (σf′²/E) (2N)^(2b) + σf′ εf′ (2N)^(b+c)."""
        reversals = 2.0 * _not_negative("cycles", cycles)
        b, c = self.strength_exponent, self.ductility_exponent
        elastic = self.strength**2 / self.young_modulus * reversals ** (2.0 * b)
        return np.asarray(elastic + self.strength * self.ductility * reversals ** (b + c))

    def cycles(self, swt: ArrayLike) -> NDArray[np.float64]:
        """Cycles N to the initiation of a crack at a given SWT.

        The SWT of a contact is that of its worst point, in a field that falls off within a fraction of the
        contact radius. Such a strictly local criterion gives very conservative lives: better ones come from
        averages over a volume, or from a critical distance (`swtstudy.nonlocal_swt`), whose size depends on
        the material. The SWT parameter also has one fixed sensitivity to the mean stress, about 0.29, which
        a material need not have.

        Parameters
        ----------
        swt
            SWT in the unit of stress of the constants.

        Returns
        -------
        cycles
            Of the shape of ``swt``; inf where that is 0, NaN where it is NaN or masked.

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
        swt = _not_negative("swt", swt)
        elastic, plastic = self.strength**2 / self.young_modulus, self.strength * self.ductility
        slopes = np.array([2.0 * self.strength_exponent, self.strength_exponent + self.ductility_exponent])
        with np.errstate(divide="ignore"):
            target = np.log(swt)
            level = np.log(np.array([elastic, plastic]))
        # Each term alone gives too short a life: from there Newton's steps only go up.
        x = np.max((target[..., None] - level) / slopes, axis=-1)
        known = np.isfinite(x)
        for _ in range(_STEPS):
            terms = np.exp(level + slopes * np.where(known, x, 0.0)[..., None])
            total = terms.sum(axis=-1)
            step = (np.log(total) - np.where(known, target, 0.0)) * total / (terms * slopes).sum(axis=-1)
            x = np.where(known, x - step, x)
        return np.asarray(0.5 * np.exp(x))


def _not_negative(name: str, values: ArrayLike) -> NDArray[np.float64]:
    numbers = read_numbers(name, values, "numbers ≥ 0")
    if (numbers < 0.0).any():
        raise StudyError([Mistake(name, f"{np.nanmin(numbers):g}", "numbers ≥ 0")])
    return numbers
