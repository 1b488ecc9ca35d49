"""From the Fatemi–Socie parameter to cycles."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from swtstudy.units.life import FatigueConstants, at_cycles, check_constants, life, not_negative, rounds
from swtstudy.vocabulary.mistakes import Mistake, StudyError, literal, plain_number


@dataclass(frozen=True)
class ShearConstants:
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

    def __post_init__(self) -> None:
        check_constants(self)

    @classmethod
    def estimated(cls, tensile: FatigueConstants, poisson_ratio: float) -> ShearConstants:
        """From tensile constants, for want of others: τf′ = σf′/√3, γf′ = √3 εf′, and the same exponents."""
        if not -1.0 < plain_number(poisson_ratio) <= 0.5:
            raise StudyError([Mistake("poisson_ratio", literal(poisson_ratio), "a number in (-1, 0.5]")])
        root = math.sqrt(3.0)
        return cls(
            tensile.young_modulus / (2.0 + 2.0 * plain_number(poisson_ratio)),
            tensile.strength / root,
            tensile.strength_exponent,
            root * tensile.ductility,
            tensile.ductility_exponent,
        )

    @property
    def _terms(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Level and slope of both terms over the logarithm of 2N."""
        level = math.log(self.strength / self.shear_modulus), math.log(self.ductility)
        return np.array(level), np.array([self.strength_exponent, self.ductility_exponent])

    def parameter(self, cycles: ArrayLike) -> NDArray[np.float64]:
        """The Fatemi–Socie parameter, a strain, that a specimen stands for N cycles."""
        return at_cycles(*self._terms, cycles)

    def cycles(self, parameter: ArrayLike) -> NDArray[np.float64]:
        """Cycles N to the initiation of a crack at a given Fatemi–Socie parameter, a strain.

        Parameters
        ----------
        parameter
            γ_a (1 + k σ_n/σ_y): s E* δ0/(a_H G), or what `swtstudy.criterion_of_history` finds, over G.

        Returns
        -------
        numpy.ndarray
            Cycles, of the shape of ``parameter``; inf where that is 0, NaN where it is NaN or masked.

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
        return life(*self._terms, not_negative("parameter", parameter))

    def rounds(self, parameter: Any, counted: Any, counted_number: Any) -> Any:
        """Rounds of the load to the initiation of a crack, as `FatigueConstants.rounds`."""
        return rounds(self.cycles, parameter, counted, counted_number, "parameter")
