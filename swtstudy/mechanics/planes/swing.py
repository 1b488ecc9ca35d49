"""The swing of a plane: a functional of the stress, linear in it, whose amplitude over the cycle counts.

On the planes through y, whose normal lies at the angle θ from x towards z, it is A + B cos 2θ + C sin 2θ. On
any plane it is made of a tensor that follows from the stress. Where it is a vector in the plane, as the shear
stress is, its curve is that along the line in which it swings most: the largest chord of its path.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import ClassVar

import numpy as np

from swtstudy.mechanics.numerics.arrays import SAME, TINY_ROOT
from swtstudy.mechanics.planes.weights import (
    apply_jets,
    bilinear_weights,
    normal_weights,
    squared,
    strain_history,
    tangent_basis,
)
from swtstudy.mechanics.points import FloatArray, Floats

#: Lines in the plane of which a look at many planes takes the one with the largest swing, and from which the
#: largest chord is looked for: 2 and 0.5 % of it may be missed.
COARSE_LINES, LINES = 8, 16


class Swing(ABC):
    """A functional of the stress on a plane."""

    #: As a variable, what a reader calls it, and its symbol in LaTeX.
    name: ClassVar[str]
    words: ClassVar[str]
    symbol: ClassVar[str]
    #: Whether it goes with one over E.
    is_strain: ClassVar[bool]

    @abstractmethod
    def in_section(self, tension: FloatArray, yy: FloatArray, poisson_ratio: FloatArray) -> FloatArray:
        """A, B, C from those of σ_n, shape (3, …), and σ_yy, (…); a strain is by E = (1 − ν²) E*."""

    @abstractmethod
    def tensor(self, stress: FloatArray, poisson_ratio: Floats, young_modulus: Floats = 1.0) -> FloatArray:
        """The tensor of which it is made, from the stress, both of shape (…, 6)."""

    @abstractmethod
    def on_plane(self, tensor: FloatArray, normal: FloatArray) -> FloatArray:
        """Its curves, (…, T), on one plane, (…, 3), of each of some histories of its tensor, (…, T, 6)."""

    @abstractmethod
    def on_planes(
        self, stress: FloatArray, normal: FloatArray, tension: FloatArray, ν: float, like: FloatArray
    ) -> FloatArray:
        """Its curves with E = 1, (m, k, T), of m histories, (m, T, 6), on k planes each, (m, k, 3).

        From σ_n there. Of a vector along the line in which it swings most in histories ``like``.
        """

    @abstractmethod
    def amplitudes(
        self, stress: FloatArray, normals: FloatArray, tension: FloatArray, ν: float, E: float
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

    name: ClassVar[str] = "normal_strain"
    words: ClassVar[str] = "strain normal to the plane"
    symbol: ClassVar[str] = r"\varepsilon_n"
    is_strain: ClassVar[bool] = True

    def on_planes(
        self, stress: FloatArray, normal: FloatArray, tension: FloatArray, ν: float, like: FloatArray
    ) -> FloatArray:
        trace = stress[..., 0] + stress[..., 1] + stress[..., 2]
        return (1.0 + ν) * tension - ν * trace[:, None]

    def in_section(self, tension: FloatArray, yy: FloatArray, poisson_ratio: FloatArray) -> FloatArray:
        ν = poisson_ratio
        strain = tension / (1.0 - ν)
        strain[0] -= (ν / (1.0 - ν * ν)) * (2.0 * tension[0] + yy)
        return strain

    def tensor(self, stress: FloatArray, poisson_ratio: Floats, young_modulus: Floats = 1.0) -> FloatArray:
        return strain_history(stress, poisson_ratio, young_modulus)

    def on_plane(self, tensor: FloatArray, normal: FloatArray) -> FloatArray:
        return (tensor @ normal_weights(normal)[..., None])[..., 0]

    def amplitudes(
        self, stress: FloatArray, normals: FloatArray, tension: FloatArray, ν: float, E: float
    ) -> FloatArray:
        # ε_n = (1 + ν)/E · (σ_n − ν/(1 + ν) tr σ): the trace is the same for every plane.
        tension -= (ν / (1.0 + ν)) * stress[..., :3].sum(axis=-1, keepdims=True)
        modulus = E / (1.0 + ν)
        return 0.5 * (tension.max(axis=-2) / modulus - tension.min(axis=-2) / modulus)

    def amplitude_jets(self, jets: FloatArray, change: FloatArray) -> FloatArray:
        return apply_jets(jets, change)

    def curve_jets(
        self, jets: FloatArray, normal: FloatArray, tangent: FloatArray, tensor: FloatArray
    ) -> FloatArray:
        return apply_jets(jets, tensor)


class ShearStress(Swing):
    """τ: in the section a number; on other planes a vector, of which the largest chord of its path counts."""

    name: ClassVar[str] = "shear_stress"
    words: ClassVar[str] = "shear stress on the plane"
    symbol: ClassVar[str] = r"\tau"
    is_strain: ClassVar[bool] = False

    def in_section(self, tension: FloatArray, yy: FloatArray, poisson_ratio: FloatArray) -> FloatArray:
        _, b, c = tension
        return np.stack([np.zeros_like(b), c, -b])

    def tensor(self, stress: FloatArray, poisson_ratio: Floats, young_modulus: Floats = 1.0) -> FloatArray:
        return stress

    def on_plane(self, tensor: FloatArray, normal: FloatArray) -> FloatArray:
        shape = tensor.shape[:-1]
        tensor, normal = tensor.reshape(-1, *tensor.shape[-2:]), normal.reshape(-1, 3)
        return _along_chord(tensor, normal, tensor).reshape(shape)

    def on_planes(
        self, stress: FloatArray, normal: FloatArray, tension: FloatArray, ν: float, like: FloatArray
    ) -> FloatArray:
        several = [_along_chord(stress, own, like) for own in normal.swapaxes(0, 1)]
        return np.stack(several, axis=1)

    def amplitudes(
        self, stress: FloatArray, normals: FloatArray, tension: FloatArray, ν: float, E: float
    ) -> FloatArray:
        first, second = tangent_basis(normals).swapaxes(0, 1)
        highest = np.zeros_like(tension[..., 0, :])
        for turn in np.pi / COARSE_LINES * np.arange(COARSE_LINES):
            line = (np.cos(turn) * first + np.sin(turn) * second).astype(normals.dtype)
            np.matmul(stress, bilinear_weights(normals, line).T.astype(stress.dtype), out=tension)
            np.maximum(highest, 0.5 * (tension.max(axis=-2) - tension.min(axis=-2)), out=highest)
        return highest

    def amplitude_jets(self, jets: FloatArray, change: FloatArray) -> FloatArray:
        # The square of a is nᵀ Δ² n − (nᵀ Δ n)².
        normal, whole = apply_jets(jets, change), apply_jets(jets, squared(change))
        square = whole - 2.0 * normal[:, :1] * normal
        # Where nothing swings it has a tip.
        least = TINY_ROOT**2 + SAME**2 * (change * change).sum(axis=1)
        square[:, 0] = np.maximum(whole[:, 0] - normal[:, 0] ** 2, least)
        one, two = [1, 2, 1], [1, 2, 2]
        square[:, 3:] -= 2.0 * normal[:, one] * normal[:, two]
        a = np.sqrt(square[:, :1])
        first = square[:, 1:3] / (2.0 * a)
        bend = square[:, 3:] / (2.0 * a) - first[:, [0, 1, 0]] * first[:, [0, 1, 1]] / a
        return np.concatenate([a, first, bend], axis=1)

    def curve_jets(
        self, jets: FloatArray, normal: FloatArray, tangent: FloatArray, tensor: FloatArray
    ) -> FloatArray:
        first, second = tangent[:, 0], tangent[:, 1]
        path = tensor @ bilinear_weights(normal[:, None], tangent).swapaxes(1, 2)
        chord = _chord(path)
        p, q = chord[:, :1], chord[:, 1:]
        line = p * first + q * second
        here, square = bilinear_weights(line, normal), normal_weights(normal)
        along = [bilinear_weights(normal, each) for each in (first, second)]
        # On a great circle along t the line m turns with the plane by −(m·t) n.
        weights = [
            here,
            bilinear_weights(line, first) - p * square,
            bilinear_weights(line, second) - q * square,
            -3.0 * p * along[0] - here,
            -3.0 * q * along[1] - here,
            -1.5 * (p * along[1] + q * along[0]),
        ]
        return apply_jets(np.stack(weights, axis=-1), tensor)


def _along_chord(stress: FloatArray, normal: FloatArray, like: FloatArray) -> FloatArray:
    """τ of n histories, (n, T, 6), on one plane each, along the largest chord of others there, (n, T)."""
    weights = bilinear_weights(normal[:, None], tangent_basis(normal)).swapaxes(1, 2)
    path = stress @ weights
    chord = _chord(path if like is stress else like @ weights)
    return (path @ chord[..., None])[..., 0]


def _chord(path: FloatArray) -> FloatArray:
    """Directions, (n, 2), of the largest chords of paths of points in the plane, (n, T, 2)."""
    turns = np.pi / LINES * np.arange(LINES)
    along = path @ np.stack([np.cos(turns), np.sin(turns)])
    row = np.arange(len(path))[:, None]
    chords = path[row, along.argmax(axis=1)] - path[row, along.argmin(axis=1)]
    length = np.hypot(chords[..., 0], chords[..., 1])
    best = length.argmax(axis=1)
    chord, length = chords[row[:, 0], best], length[row[:, 0], best]
    return np.where((length > TINY_ROOT)[:, None], chord / np.maximum(length, TINY_ROOT)[:, None], [1.0, 0.0])


SHEAR_STRESS = ShearStress()
NORMAL_STRAIN = NormalStrain()
