"""The paraboloid (eq. 6) and the cylinder with superimposed waviness, z = kξ, k = 2π/λ.

Of the paraboloid g = ξ² + (π/2) h z H₀(z), of the cylinder N/N_0 = ξ² + 2 h z J₁(z).
"""

from __future__ import annotations

from functools import cached_property, lru_cache

import numpy as np

from swtstudy.mechanics.indenter.base import Primitives, Profile, TablePrimitives, Tables
from swtstudy.mechanics.indenter.plane import MEAN_LOAD, PlaneProfile, StripTablePrimitives
from swtstudy.mechanics.indenter.struve import struve_functions
from swtstudy.mechanics.numerics.arrays import SAME, RowTable, align
from swtstudy.mechanics.points import BoolArray, FloatArray, Floats, IndexArray, IntArray, Shape

#: Chebyshev nodes of the tables for each digit, and so many more per rad of kξ, and of that for each digit.
#: Half of the first: 4e-6 at rtol 1e-5, no faster; twice: 2e-10. Of the second: 6e-8; no third one: 3e-8.
NODES_PER_DIGIT, NODES_PER_RADIAN, NODES_PER_RADIAN_AND_DIGIT = 2.2, 0.55, 0.025
#: Cells of tables up to the largest radius of a smooth profile, and for each rad of kξ. As first guesses half
#: or twice: 5e-14; of mixed control half of the first or quarter of the second: 4e-9 at rtol 1e-6, half of
#: the second: 3e-10, twice: 3e-8, no slower.
CELLS, CELLS_PER_RADIAN = 64, 8
#: Step of kξ in rad between levels of roughness, which are solved apart. Half: 27 % slower; twice: no faster.
ROUGHNESS_STEP = 16.0
#: Level beyond which the waves are left out: h/δ0 of some 1e-5.
ROUGHEST = 32


class WavyParaboloid(Profile):
    """n paraboloids with waviness.

    Parameters
    ----------
    largest_depth
        Shape (n,), δ0.
    waviness_amplitude
        Shape (n,): h/δ0.
    wavelength
        Shape (n,): λ/√(hR).
    """

    def __init__(
        self, largest_depth: FloatArray, waviness_amplitude: FloatArray, wavelength: FloatArray
    ) -> None:
        super().__init__(largest_depth)
        self.waviness_amplitude, self.wavelength = waviness_amplitude, wavelength
        self.wave_number = _wave_number(waviness_amplitude, wavelength)
        self.reach = _upper_radius(largest_depth, waviness_amplitude, self.wave_number)
        # Of the batch's roughness, not of its roughest point: a point's value must not depend on others.
        shape = {"waviness_amplitude": waviness_amplitude, "wavelength": wavelength}
        level = self.roughness(largest_depth, **shape).max(initial=0)
        self.phase = ROUGHNESS_STEP * float(level)
        #: Those whose tables of first guesses these share, and which of them each one is.
        self._origin: WavyParaboloid | None = None
        self._row = np.arange(len(largest_depth))

    @classmethod
    def roughness(cls, largest_depth: FloatArray, **shape: FloatArray) -> IntArray:
        amplitude, wavelength = shape["waviness_amplitude"], shape["wavelength"]
        wave_number = _wave_number(amplitude, wavelength)
        reach = _upper_radius(largest_depth, amplitude, wave_number)
        level = np.minimum(wave_number * reach / ROUGHNESS_STEP, ROUGHEST + 1.0)
        return np.ceil(level).astype(np.int64)

    @classmethod
    def resolved(cls, largest_depth: FloatArray, **shape: FloatArray) -> tuple[Shape, FloatArray]:
        # Waves too short to follow are left out. They change the slope f′ by h k sin kx, and s, which is
        # quadratic in the stress, by twice that; as much again for what they do to the contact.
        amplitude = shape["waviness_amplitude"]
        short = cls.roughness(largest_depth, **shape) > ROUGHEST
        slope = 2.0 * np.pi * np.sqrt(amplitude) / shape["wavelength"]
        return shape | {"waviness_amplitude": np.where(short, 0.0, amplitude)}, np.where(
            short, 4.0 * slope, 0.0
        )

    @classmethod
    def compact(cls, largest_depth: Floats, **shape: FloatArray) -> BoolArray:
        h, wavelength = shape["waviness_amplitude"], shape["wavelength"]
        return (h == 0.0) | (wavelength >= cls.smallest_wavelength(largest_depth, h, wavelength))

    @classmethod
    def too_small(cls, largest_depth: float, **shape: float) -> tuple[str, float] | None:
        if cls.compact(largest_depth, **{name: np.array([value]) for name, value in shape.items()}):
            return None
        h, wavelength = (np.array(shape[name]) for name in ("waviness_amplitude", "wavelength"))
        return "wavelength", float(cls.smallest_wavelength(largest_depth, h, wavelength))

    @classmethod
    def smallest_wavelength(cls, largest_depth: Floats, h: FloatArray, wavelength: FloatArray) -> FloatArray:
        """Smallest λ/√(hR) with a compact contact up to a depth, over the phases that waves λ have there."""
        phase = largest_phase(largest_depth, h, wavelength)
        # g′ ∝ 2z + (π/2) (4π² hR/λ²) A(z) with z = kξ and A = H₀ + z (2/π − H₁).
        return np.sqrt(np.pi**3 * np.maximum(np.interp(phase, *_steepest_falls()), 0.0))

    def take(self, index: IndexArray) -> WavyParaboloid:
        names = ("largest_depth", "waviness_amplitude", "wavelength", "wave_number", "reach", "_row")
        taken = self._with_rows_of(names, index)
        taken._origin = self._origin or self
        return taken

    def extra_nodes(self, digits: float) -> int:
        return int((NODES_PER_RADIAN + NODES_PER_RADIAN_AND_DIGIT * digits) * self.phase)

    def tables(self) -> Tables:
        shape = np.stack([self.largest_depth, self.waviness_amplitude, self.wavelength], axis=1)
        _, first, number = np.unique(shape, axis=0, return_index=True, return_inverse=True)
        return Tables(self.take(first), number.reshape(-1), self._even_cells)

    @property
    def _even_cells(self) -> int:
        return CELLS + int(CELLS_PER_RADIAN * self.phase)

    @property
    def feature_length(self) -> FloatArray:
        with np.errstate(divide="ignore"):
            return 2.0 * np.pi / self.wave_number

    def depth(self, radius: FloatArray) -> FloatArray:
        return self._with_slope(radius)[0]

    def _with_slope(self, radius: FloatArray) -> tuple[FloatArray, FloatArray]:
        """g and g′ = 2ξ + (π/2) h k [H₀ + z (2/π − H₁)]."""
        h, k = align(self.waviness_amplitude, radius), align(self.wave_number, radius)
        z = k * radius
        struve = struve_functions(z)
        return radius * radius + (0.5 * np.pi) * h * z * struve[0], self._slope(radius, struve)

    def _slope(self, radius: FloatArray, struve: tuple[FloatArray, FloatArray]) -> FloatArray:
        h, k = align(self.waviness_amplitude, radius), align(self.wave_number, radius)
        zeroth, first = struve
        wave = (0.5 * np.pi) * h
        return 2.0 * radius + wave * k * (zeroth + k * radius * (2.0 / np.pi - first))

    def radius(self, depth: FloatArray) -> FloatArray:
        depth = np.maximum(depth, 0.0)
        guess = self._interpolated(np.sqrt(depth), (self._origin or self)._guesses)
        # To the last digit: at a turning point an error of r is an error of its root in time.
        for _ in range(2):
            value, slope = self._with_slope(guess)
            error = value - depth
            step = np.divide(error, slope, out=np.zeros_like(error), where=slope > SAME)
            guess = np.maximum(guess - step, 0.0)
        return guess

    def _interpolated(self, at: FloatArray, table: RowTable) -> FloatArray:
        """Values at (n, …) in a table with one row for each of the profiles that these were taken from."""
        return table.interpolated(align(self._row, at), at)

    @cached_property
    def _guesses(self) -> RowTable:
        """Radii over √g, whose both ends are straight."""
        radius = self.reach[:, None] * np.linspace(0.0, 1.0, self._even_cells)
        return RowTable(np.sqrt(np.maximum(self.depth(radius), 0.0)), radius)

    def weighted_slope(self, radius: FloatArray) -> FloatArray:
        return radius * self._with_slope(radius)[1]

    def depth_and_weighted_slope(self, radius: FloatArray) -> tuple[FloatArray, FloatArray]:
        depth, slope = self._with_slope(radius)
        return depth, radius * slope

    def half_load(self, radius: FloatArray) -> FloatArray:
        return self._half_load(radius, struve_functions(align(self.wave_number, radius) * radius))

    def half_load_and_weighted_slope(self, radius: FloatArray) -> tuple[FloatArray, FloatArray]:
        struve = struve_functions(align(self.wave_number, radius) * radius)
        return self._half_load(radius, struve), radius * self._slope(radius, struve)

    def _half_load(self, radius: FloatArray, struve: tuple[FloatArray, FloatArray]) -> FloatArray:
        # ∫ ξ g′ dξ = ξ g − ∫ g dξ, and ∫ z H₀ dz = z H₁.
        h, k = align(self.waviness_amplitude, radius), align(self.wave_number, radius)
        z = k * radius
        zeroth, first = struve
        wave = z * z * zeroth - z * first
        scale = np.divide(0.5 * np.pi * h, k, out=np.zeros_like(k), where=k > 0.0)
        return (2.0 / 3.0) * radius**3 + scale * wave

    def _rise_at_half_load(self, half_load: FloatArray) -> FloatArray:
        return self._interpolated(np.cbrt(half_load), (self._origin or self)._guesses_by_load)

    @cached_property
    def _guesses_by_load(self) -> RowTable:
        """The radii of `_guesses` over the cubic root of `half_load`, which is nearly straight."""
        radius = self._guesses.value
        return RowTable(np.cbrt(np.maximum(self.half_load(radius), 0.0)), radius)

    def primitives(self, position: FloatArray, digits: float) -> Primitives:
        largest = self.radius(self.largest_depth)
        nodes = int(NODES_PER_DIGIT * digits) + self.extra_nodes(digits)
        return TablePrimitives(self, position, nodes, nodes, largest)


def largest_phase(largest_depth: Floats, h: FloatArray, wavelength: FloatArray) -> Floats:
    """Phase kξ of waves that is reached up to a depth, and half a wave more."""
    with np.errstate(divide="ignore", over="ignore"):  # too short for a float: all phases are reached
        return 2.0 * np.pi * np.sqrt(largest_depth) / (wavelength * np.sqrt(h)) + np.pi


@lru_cache
def _steepest_falls() -> tuple[FloatArray, FloatArray]:
    """Phases kξ, and the greatest −A/z up to each: a grid of shapes asks for thousands."""
    # The first minimum of A/z, near 4.7, is the deepest.
    z = np.linspace(1e-3, 8.0, 2001)
    zeroth, first = struve_functions(z)
    return z, np.maximum.accumulate(-(zeroth / z + 2.0 / np.pi - first))


def _wave_number(amplitude: FloatArray, wavelength: FloatArray) -> FloatArray:
    """k of h and λ/√(hR); 0 without waves."""
    length = wavelength * np.sqrt(amplitude)
    return np.divide(2.0 * np.pi, length, out=np.zeros_like(length), where=length > 0.0)


def _upper_radius(depth: FloatArray, amplitude: FloatArray, wave_number: FloatArray) -> FloatArray:
    """A radius at which g surely exceeds ``depth``."""
    radius = np.sqrt(depth)
    for _ in range(3):
        # |H₀| < 0.8, and its part of g cannot make up for a wavelength.
        radius = np.sqrt(depth + 0.5 * np.pi * amplitude * np.minimum(0.8 * wave_number * radius, 1e6))
    return radius


class WavyCylinder(PlaneProfile, WavyParaboloid):
    """n cylinders with waviness; parameters and tables of first guesses as of the paraboloid."""

    def _with_slope(self, radius: FloatArray) -> tuple[FloatArray, FloatArray]:
        """N/N_0 and its slope 2ξ + 2 h k z J₀."""
        from scipy.special import j0, j1  # as long to import as all else, and few need it

        h, k = align(self.waviness_amplitude, radius), align(self.wave_number, radius)
        z = k * radius
        return radius * radius + 2.0 * h * z * j1(z), 2.0 * radius + 2.0 * h * k * z * j0(z)

    def weighted_slope(self, radius: FloatArray) -> FloatArray:
        return MEAN_LOAD * radius * self._with_slope(radius)[1]

    def depth_and_weighted_slope(self, radius: FloatArray) -> tuple[FloatArray, FloatArray]:
        depth, slope = self._with_slope(radius)
        return depth, MEAN_LOAD * radius * slope

    def depth_over_radius(self, radius: FloatArray) -> FloatArray:
        from scipy.special import j0

        h, k = align(self.waviness_amplitude, radius), align(self.wave_number, radius)
        return 0.5 * radius * radius + 2.0 * h * (1.0 - j0(k * radius))

    @classmethod
    def smallest_wavelength(cls, largest_depth: Floats, h: FloatArray, wavelength: FloatArray) -> FloatArray:
        phase = largest_phase(largest_depth, h, wavelength)
        # N′ ∝ 1 + (4π² hR/λ²) J₀(z).
        return 2.0 * np.pi * np.sqrt(np.maximum(np.interp(phase, *_deepest_troughs()), 0.0))

    def primitives(self, position: FloatArray, digits: float) -> Primitives:
        nodes = int(NODES_PER_DIGIT * digits) + self.extra_nodes(digits)
        return StripTablePrimitives(self, position, nodes, self.radius(self.largest_depth))


@lru_cache
def _deepest_troughs() -> tuple[FloatArray, FloatArray]:
    """Phases kξ, and the greatest −J₀ up to each, that at its first minimum near 3.8."""
    from scipy.special import j0

    z = np.linspace(1e-3, 8.0, 2001)
    return z, np.maximum.accumulate(-j0(z))
