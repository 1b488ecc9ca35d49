"""The elastic constants of the two bodies, and how similar they are."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Moduli:
    """Young's moduli and Poisson ratios of the two bodies, E in any unit of stress."""

    young: tuple[float, float]
    poisson: tuple[float, float]

    @property
    def alike(self) -> bool:
        """True if the two bodies are elastically the same."""
        return self.young[0] == self.young[1] and self.poisson[0] == self.poisson[1]

    @property
    def shear(self) -> tuple[float, float]:
        """Shear moduli G = E/(2 + 2ν)."""
        one, two = (e / (2.0 + 2.0 * nu) for e, nu in zip(self.young, self.poisson, strict=True))
        return one, two

    @property
    def normal(self) -> float:
        """The modulus E* (eq. 2)."""
        return 1.0 / sum((1.0 - nu) / (2.0 * g) for g, nu in zip(self.shear, self.poisson, strict=True))

    @property
    def tangential(self) -> float:
        """The modulus G* with 2 − ν; eq. 2 is printed with 1 − 2ν, with which eq. 21 would not hold."""
        return 1.0 / sum((2.0 - nu) / (4.0 * g) for g, nu in zip(self.shear, self.poisson, strict=True))

    @property
    def mismatch(self) -> float:
        """Dundurs' β, 0 for bodies that are similar after eq. 1.

        β = ½ [(1 − 2ν1)/G1 − (1 − 2ν2)/G2] / [(1 − ν1)/G1 + (1 − ν2)/G2]. Pressure p then drags tangential
        tractions of the order β p along, which the uncoupled solution leaves out; friction bears μ p.

        Examples
        --------
        >>> Moduli((210e3, 210e3), (0.3, 0.3)).mismatch
        0.0
        >>> round(Moduli((210e3, 70e3), (0.3, 0.33)).mismatch, 3)
        -0.117
        """
        unlike = [(1.0 - 2.0 * nu) / g for g, nu in zip(self.shear, self.poisson, strict=True)]
        return (unlike[0] - unlike[1]) * self.normal / 4.0

    def swt_share(self, body: int) -> float:
        """SWT of a body over that of the half-space with E*, under the same stress: (1 − ν²) E*/E.

        The solver's half-space has E = (1 − ν²) E*; of two equal bodies each has half of its SWT.
        """
        return (1.0 - self.poisson[body] ** 2) * self.normal / self.young[body]
