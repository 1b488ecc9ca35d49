"""What swings on a plane: a functional of the stress, linear in it, whose amplitude over the cycle counts.

On the planes through y, whose normal lies at the angle θ from x towards z, it is A + B cos 2θ + C sin 2θ. On
any plane it is made of a tensor that follows from the stress. Where it is a vector in the plane, as the shear
stress is, its curve is that along the line in which it swings most: the largest chord of its path.
"""

from __future__ import annotations

from abc import ABC, abstractmethod

from swtstudy.mechanics.planes.hooke import strain_history
from swtstudy.mechanics.planes.weights import apply_jets, normal_weights
from swtstudy.mechanics.points import FloatArray


class Swing(ABC):
    """A functional of the stress on a plane."""

    @abstractmethod
    def in_section(self, tension: FloatArray, yy: FloatArray, poisson_ratio: FloatArray) -> FloatArray:
        """A, B, C from those of σ_n, shape (3, …), and σ_yy, (…); a strain is by E = (1 − ν²) E*."""

    @abstractmethod
    def tensor(
        self, stress: FloatArray, poisson_ratio: float | FloatArray, young_modulus: float = 1.0
    ) -> FloatArray:
        """The tensor of which it is made, from the stress, both of shape (…, 6)."""

    @abstractmethod
    def on_plane(self, tensor: FloatArray, normal: FloatArray) -> FloatArray:
        """Its curves, (…, T), on one plane, (…, 3), of each of some histories of its tensor, (…, T, 6)."""

    @abstractmethod
    def amplitudes(
        self,
        stress: FloatArray,
        normals: FloatArray,
        tension: FloatArray,
        poisson_ratio: float,
        young_modulus: float,
    ) -> FloatArray:
        """Its amplitudes, (…, k), on k planes, (k, 3), for a look at many.

        From histories of the stress, (…, T, 6), and σ_n on these planes, (…, T, k), which is written over.
        """

    @abstractmethod
    def amplitude_jets(self, jets: FloatArray, change: FloatArray) -> FloatArray:
        """Its amplitude and two derivatives, (n, 6), by `jet_weights` of n planes.

        From half the differences, (n, 6), of its tensor between the two extremes.
        """

    @abstractmethod
    def curve_jets(
        self, jets: FloatArray, normal: FloatArray, tangent: FloatArray, tensor: FloatArray
    ) -> FloatArray:
        """Its curves `on_plane` and their two derivatives, (n, T, 6), by `jet_weights` of n planes.

        The planes have normals (n, 3) and two tangents each, (n, 2, 3). Of a vector the line stays as it is.
        """


class NormalStrain(Swing):
    """ε_n."""

    def in_section(self, tension: FloatArray, yy: FloatArray, poisson_ratio: FloatArray) -> FloatArray:
        ν = poisson_ratio
        strain = tension / (1.0 - ν)
        strain[0] -= (ν / (1.0 - ν * ν)) * (2.0 * tension[0] + yy)
        return strain

    def tensor(
        self, stress: FloatArray, poisson_ratio: float | FloatArray, young_modulus: float = 1.0
    ) -> FloatArray:
        return strain_history(stress, poisson_ratio, young_modulus)

    def on_plane(self, tensor: FloatArray, normal: FloatArray) -> FloatArray:
        return (tensor @ normal_weights(normal)[..., None])[..., 0]

    def amplitudes(
        self,
        stress: FloatArray,
        normals: FloatArray,
        tension: FloatArray,
        poisson_ratio: float,
        young_modulus: float,
    ) -> FloatArray:
        # ε_n = (1 + ν)/E · (σ_n − ν/(1 + ν) tr σ): the trace is the same for every plane.
        tension -= (poisson_ratio / (1.0 + poisson_ratio)) * stress[..., :3].sum(axis=-1, keepdims=True)
        modulus = young_modulus / (1.0 + poisson_ratio)
        return 0.5 * (tension.max(axis=-2) / modulus - tension.min(axis=-2) / modulus)

    def amplitude_jets(self, jets: FloatArray, change: FloatArray) -> FloatArray:
        return apply_jets(jets, change)

    def curve_jets(
        self, jets: FloatArray, normal: FloatArray, tangent: FloatArray, tensor: FloatArray
    ) -> FloatArray:
        return apply_jets(jets, tensor)


NORMAL_STRAIN = NormalStrain()
