"""A criterion: an increasing function f(T, a) of a plane's largest tension and the amplitude of its swing.

Both are made of curves over the cycle that are linear in the stress. The tension is σ_n, and T its maximum.
The swing is the normal strain or the shear stress (`swtstudy.mechanics.planes.swing.Swing`), and a is half
the sum of the maxima of the swing and of its negative. So three maxima over the cycle make the value.

What the searches over places, planes and instants need of a criterion, and all they need:

* `Criterion.swing`: on planes through y the coefficients of the swing, `Swing.in_section`; on any plane its
  tensor, `Swing.tensor`, which is made once, and its curve by that, `Swing.on_plane`;
* `Criterion.curves`, whose maxima count, and `Criterion.of_maxima` or `Criterion.value`, f by these;
* `Criterion.derivatives` and `Criterion.log_derivatives`, for Newton's method over planes, on any plane with
  `Swing.amplitude_jets`; `Criterion.powers`, which say how much of f may be hidden by what is not seen;
* `Criterion.far_field`, f under a bulk stress alone; `Criterion.needs_tension`, and
  `Criterion.knows_sharp_edge`: whether it is known where f has no bound;
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

from swtstudy.mechanics.planes.swing import Swing
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.rows import Rows

#: Values and two derivatives, each of the same shape.
Jet = tuple[FloatArray, FloatArray, FloatArray]
#: Values below this have no logarithm.
NO_VALUE = 1e-300


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
    #: Whether `swtstudy.mechanics.line.singular_edge` is right for it.
    knows_sharp_edge: ClassVar[bool]

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
        value = np.maximum(self.value(tension[:, 0], amplitude[:, 0]), NO_VALUE)
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
        value = np.maximum(self.value(tension, amplitude), NO_VALUE)
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
