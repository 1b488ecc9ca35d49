"""Criteria: increasing functions f(T, a) of a plane's largest tension and the amplitude of its swing.

They are the Smith–Watson–Topper parameter (eq. 9), Walker's with its exponent, and those of shear by Fatemi
and Socie and by Findley. Both T and a are made of curves over the cycle that are linear in the stress. The
tension is σ_n, and T its maximum. The swing is the normal strain or the shear stress
(`swtstudy.mechanics.planes.swing.Swing`), and a is half the sum of the maxima of the swing and of its
negative. So three maxima over the cycle make the value.

What the searches over places, planes and instants need of a criterion, and all they need:

* `Criterion.swing`: on planes through y the coefficients of the swing, `Swing.in_section`; on any plane its
  tensor, `Swing.tensor`, which is made once, and its curve by that, `Swing.on_plane`;
* `Criterion.curves`, whose maxima count, and `Criterion.of_maxima` or `Criterion.value`, f by these;
* `Criterion.derivatives` and `Criterion.log_derivatives`, for Newton's method over planes, on any plane with
  `Swing.amplitude_jets`; `Criterion.powers`, which say how much of f may be hidden by what is not seen;
* `Criterion.far_field`, f under a bulk stress alone, and `Criterion.needs_tension`;
* its parameters at some places: `Criterion.take`, `Criterion.reshape`, `Criterion.spread`. A scene holds one
  of shape (n,), a history over planes one that can be broadcast to its places.

A new criterion has the words, a swing, a `Criterion.value`, its `Criterion.partials`, from which the
derivatives follow, and a `Criterion.far_field`.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import ClassVar, Self

import numpy as np

from swtstudy.mechanics.numerics.arrays import TINY, TINY_ROOT
from swtstudy.mechanics.planes.swing import NORMAL_STRAIN, SHEAR_STRESS, Swing
from swtstudy.mechanics.points import FloatArray, Points, Rows

#: Values and two derivatives, each of the same shape.
Jet = tuple[FloatArray, FloatArray, FloatArray]


@dataclass(frozen=True)
class Criterion(Rows, ABC):
    """A criterion at places of shape (…).

    Its fields are parameters of that shape, or None for those that it can do without.
    """

    #: As in studies, what a reader calls it, and its symbol in LaTeX.
    name: ClassVar[str]
    words: ClassVar[str]
    symbol: ClassVar[str]
    #: With which power of the stress it goes: with 2 its unit is stress times strain, with 1 stress.
    degree: ClassVar[int]
    #: What swings.
    swing: ClassVar[Swing]
    #: Whether it is 0 on planes that never are in tension.
    needs_tension: ClassVar[bool]

    def reshape(self, *shape: int) -> Self:
        """The same for places of another shape."""
        return self._each(lambda values: values.reshape(shape))

    def spread(self, *shape: int) -> Self:
        """The same for places of a shape that its own can be broadcast to."""
        return self._each(lambda values: np.broadcast_to(values, shape))

    def _each(self, change: Callable[[FloatArray], FloatArray]) -> Self:
        own = {name: change(values) for name, values in vars(self).items() if values is not None}
        return replace(self, **own) if own else self

    @staticmethod
    def curves(tension: FloatArray, swing: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """The curves over the cycle whose maxima make the value."""
        return tension, swing, -swing

    def of_maxima(self, tension: FloatArray, up: FloatArray, down: FloatArray) -> FloatArray:
        """The value of a plane from the maxima of its three `curves`."""
        return self.value(tension, 0.5 * (up + down))

    @abstractmethod
    def value(self, tension: FloatArray, amplitude: FloatArray) -> FloatArray:
        """f(T, a), 0 at least."""

    @abstractmethod
    def partials(self, tension: FloatArray, amplitude: FloatArray) -> tuple[FloatArray, ...]:
        """f_T, f_a, f_TT, f_Ta and f_aa where f > 0."""

    def derivatives(self, tension: Jet, amplitude: Jet) -> tuple[FloatArray, FloatArray]:
        """Slope and curvature of f, or of an increasing function of it, along a way, but for a factor > 0."""
        (f, df, ddf), (g, dg, ddg) = tension, amplitude
        first, second, both_first, mixed, both_second = self.partials(f, g)
        bend = both_first * df * df + 2.0 * mixed * df * dg + both_second * dg * dg
        return first * df + second * dg, bend + first * ddf + second * ddg

    def log_derivatives(self, tension: FloatArray, amplitude: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Derivatives of ln f > −∞ in two directions.

        Parameters
        ----------
        tension, amplitude
            Shape (n, 6): value, first derivatives 1, 2, second derivatives 11, 22, 12.

        Returns
        -------
        slope, stiffness
            Shape (n, 2) and (n, 3): first derivatives, and second ones with the sign changed.
        """
        value = np.maximum(self.value(tension[:, 0], amplitude[:, 0]), TINY)
        partials = self.partials(tension[:, 0], amplitude[:, 0])
        first, second, both_first, mixed, both_second = (
            np.broadcast_to(each / value, value.shape)[:, None] for each in partials
        )
        slope = first * tension[:, 1:3] + second * amplitude[:, 1:3]
        one, two = [1, 2, 1], [1, 2, 2]
        bend = both_first * tension[:, one] * tension[:, two]
        bend += both_second * amplitude[:, one] * amplitude[:, two]
        bend += mixed * (tension[:, one] * amplitude[:, two] + tension[:, two] * amplitude[:, one])
        bend += first * tension[:, 3:] + second * amplitude[:, 3:]
        return slope, slope[:, [0, 1, 0]] * slope[:, [0, 1, 1]] - bend

    def powers(self, tension: FloatArray, amplitude: FloatArray) -> tuple[FloatArray, FloatArray]:
        """With which powers of T and a f > 0 goes there: the derivatives of ln f by their logarithms."""
        value = np.maximum(self.value(tension, amplitude), TINY)
        first, second, *_ = self.partials(tension, amplitude)
        return first * tension / value, second * amplitude / value

    @abstractmethod
    def far_field(
        self, largest: FloatArray, amplitude: FloatArray, poisson_ratio: FloatArray, plane: bool
    ) -> tuple[FloatArray, FloatArray]:
        """The value under a bulk stress along x alone, and 2θ of its plane's normal, rad, each (n,).

        Parameters
        ----------
        largest, amplitude
            Shape (n,): of the bulk stress in E* √(δ0/R).
        poisson_ratio
            Shape (n,); E is (1 − ν²) E*.
        plane
            Whether in plane strain.
        """


#: γ of the Smith–Watson–Topper parameter.
SWT_EXPONENT = 0.5


@dataclass(frozen=True)
class Swt(Criterion):
    """swt, the largest σ_n times the amplitude of ε_n, 0 where the plane never is in tension.

    With Walker's exponent γ it is σ_n^(2 − 2γ) (E ε_n)^(2γ)/E, whose γ = 1/2 is swt.

    Attributes
    ----------
    exponent
        γ in (0, 1); None where it is 1/2 everywhere.
    modulus
        E in the unit of stress over that of strain; None with the exponent.
    """

    exponent: FloatArray | None = None
    modulus: FloatArray | None = None

    name: ClassVar[str] = "swt"
    words: ClassVar[str] = "Smith–Watson–Topper parameter"
    symbol: ClassVar[str] = "swt"
    degree: ClassVar[int] = 2
    swing: ClassVar[Swing] = NORMAL_STRAIN
    needs_tension: ClassVar[bool] = True

    @classmethod
    def of(cls, exponent: FloatArray, modulus: FloatArray) -> Swt:
        """With exponents γ and moduli E of one shape."""
        return cls() if np.all(exponent == SWT_EXPONENT) else cls(exponent, modulus)

    def value(self, tension: FloatArray, amplitude: FloatArray) -> FloatArray:
        tension = np.maximum(tension, 0.0)
        if self.exponent is None or self.modulus is None:
            return np.asarray(tension * amplitude)
        γ, E = self.exponent, self.modulus
        swing = np.maximum(E * amplitude, 0.0)
        return np.asarray(tension ** (2.0 - 2.0 * γ) * swing ** (2.0 * γ) / E)

    def partials(self, tension: FloatArray, amplitude: FloatArray) -> tuple[FloatArray, ...]:
        α, β = self.powers(tension, amplitude)
        T, a, f = tension, np.maximum(amplitude, TINY_ROOT), self.value(tension, amplitude)
        return α * f / T, β * f / a, α * (α - 1.0) * f / T**2, α * β * f / (T * a), β * (β - 1.0) * f / a**2

    def derivatives(self, tension: Jet, amplitude: Jet) -> tuple[FloatArray, FloatArray]:
        (f, df, ddf), (g, dg, ddg) = tension, amplitude
        if self.exponent is None:
            return df * g + f * dg, ddf * g + 2.0 * df * dg + f * ddg
        # σ_n times a power κ of ε_n has its maxima there, too: f g^κ, over g^(κ − 1).
        κ = self.exponent / (1.0 - self.exponent)
        g = np.maximum(g, TINY_ROOT)
        slope = df * g + κ * f * dg
        return slope, ddf * g + κ * (2.0 * df * dg + f * ((κ - 1.0) * dg * dg / g + ddg))

    def log_derivatives(self, tension: FloatArray, amplitude: FloatArray) -> tuple[FloatArray, FloatArray]:
        f, g = (jet[:, 1:] / jet[:, :1] for jet in (tension, amplitude))
        # Of ln f the second derivative is f″/f − (f′/f)².
        square = [a[:, [0, 1, 0]] * a[:, [0, 1, 1]] for a in (f, g)]
        if self.exponent is None:
            return f[:, :2] + g[:, :2], square[0] + square[1] - f[:, 2:] - g[:, 2:]
        β = 2.0 * self.exponent[:, None]
        α = 2.0 - β
        slope = α * f[:, :2] + β * g[:, :2]
        return slope, α * (square[0] - f[:, 2:]) + β * (square[1] - g[:, 2:])

    def powers(self, tension: FloatArray, amplitude: FloatArray) -> tuple[FloatArray, FloatArray]:
        β = np.asarray(2.0 * SWT_EXPONENT if self.exponent is None else 2.0 * self.exponent)
        return np.asarray(2.0 - β), β

    def far_field(
        self, largest: FloatArray, amplitude: FloatArray, poisson_ratio: FloatArray, plane: bool
    ) -> tuple[FloatArray, FloatArray]:
        """On the x-normal."""
        if not plane:
            amplitude = amplitude / (1.0 - poisson_ratio**2)
        return self.value(largest, amplitude), np.zeros_like(largest)


#: γ = 1/2.
SWT = Swt()


@dataclass(frozen=True)
class ShearCriterion(Criterion):
    """An amplitude of the shear stress, raised by the largest σ_n.

    Attributes
    ----------
    sensitivity
        How much by.
    """

    sensitivity: FloatArray

    degree: ClassVar[int] = 1
    swing: ClassVar[Swing] = SHEAR_STRESS
    needs_tension: ClassVar[bool] = False


@dataclass(frozen=True)
class FatemiSocie(ShearCriterion):
    """γ_a G (1 + κ σ_n⁺), γ_a G being the amplitude of τ; κ over the unit of the stress."""

    name: ClassVar[str] = "fatemi_socie"
    words: ClassVar[str] = "Fatemi–Socie parameter"
    symbol: ClassVar[str] = r"\mathrm{FS}"

    def value(self, tension: FloatArray, amplitude: FloatArray) -> FloatArray:
        return np.asarray(amplitude * (1.0 + self.sensitivity * np.maximum(tension, 0.0)))

    def partials(self, tension: FloatArray, amplitude: FloatArray) -> tuple[FloatArray, ...]:
        slope = self.sensitivity * (tension > 0.0)
        zero = np.zeros_like(tension)
        return amplitude * slope, 1.0 + slope * tension, zero, slope + zero, zero

    def far_field(
        self, largest: FloatArray, amplitude: FloatArray, poisson_ratio: FloatArray, plane: bool
    ) -> tuple[FloatArray, FloatArray]:
        # sin 2θ (1 + m + m cos 2θ) is largest where its derivative, a quadratic form of the cosine, vanishes.
        m = 0.5 * self.sensitivity * np.maximum(largest, 0.0)
        cosine = 2.0 * m / (1.0 + m + np.sqrt((1.0 + m) ** 2 + 8.0 * m**2))
        tension, swing = 0.5 * largest * (1.0 + cosine), 0.5 * amplitude * np.sqrt(1.0 - cosine**2)
        return self.value(tension, swing), np.arccos(cosine)


@dataclass(frozen=True)
class Findley(ShearCriterion):
    """τ_a + k max σ_n, and 0 where that is negative."""

    name: ClassVar[str] = "findley"
    words: ClassVar[str] = "Findley stress"
    symbol: ClassVar[str] = "f"

    def value(self, tension: FloatArray, amplitude: FloatArray) -> FloatArray:
        return np.maximum(amplitude + self.sensitivity * tension, 0.0)

    def partials(self, tension: FloatArray, amplitude: FloatArray) -> tuple[FloatArray, ...]:
        zero = np.zeros_like(tension)
        return self.sensitivity + zero, 1.0 + zero, zero, zero, zero

    def far_field(
        self, largest: FloatArray, amplitude: FloatArray, poisson_ratio: FloatArray, plane: bool
    ) -> tuple[FloatArray, FloatArray]:
        pull = self.sensitivity * largest
        return 0.5 * (pull + np.hypot(amplitude, pull)), np.arctan2(amplitude, pull)


#: What makes the criterion of points, by its name.
CRITERIA: dict[str, Callable[[Points], Criterion]] = {
    Swt.name: lambda points: Swt.of(points.walker_exponent, 1.0 - points.poisson_ratio**2),
    FatemiSocie.name: lambda points: FatemiSocie(points.normal_sensitivity),
    Findley.name: lambda points: Findley(points.normal_sensitivity),
}


def criterion_of(points: Points) -> Criterion:
    """The criterion of n points, shape (n,)."""
    return CRITERIA[points.criterion](points)
