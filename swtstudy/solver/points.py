"""Points of parameters and their solution, as named arrays."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import partial
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from swtstudy.vocabulary.arrays import Columns, FloatArray, IntArray, Shape
from swtstudy.vocabulary.parameters import DISPLACEMENTS, Control

if TYPE_CHECKING:
    from swtstudy.loads.loop import Loop
    from swtstudy.profiles.table import AnyProfile

#: Values that points have unless they are given.
_UNLESS_GIVEN = {
    "walker_exponent": 0.5,
    "normal_sensitivity": 0.0,
    "bulk_strain_share": 1.0,
    **dict.fromkeys(("bulk_stress_amplitude", "bulk_stress_mean", "bulk_stress_phase"), 0.0),
}
#: Arrays of shape (0,) are not given.
_not_given = partial(np.empty, 0)


@dataclass(frozen=True)
class Points(Columns):
    """A batch of n parameter points that share one profile family and control (eq. 20).

    Attributes
    ----------
    profile
        Name of the profile, a key of `swtstudy.vocabulary.choices.FAMILIES`, or the table of one.
    poisson_ratio, friction, normal_amplitude, tangential_amplitude, phase
        Shape (n,), as in `swtstudy.vocabulary.parameters.PARAMETERS`; the phase in rad. The amplitudes are
        forces where `control` says so.
    p, q
        Shape (n,), integers: ω2/ω1 = p/q in lowest terms.
    shape
        Shape parameters κ_i of the profile, each of shape (n,).
    control
        The prescribed motion: displacements or forces.
    path
        The loop that the load runs through; None for the two harmonic oscillations.
    criterion
        The criterion whose largest value is s, a key of `swtstudy.vocabulary.choices.CRITERIA`.
    walker_exponent
        Shape (n,), of SWT; 1/2 unless given.
    normal_sensitivity
        Shape (n,), of the criteria of shear; 0 unless given.
    bulk_stress_amplitude, bulk_stress_mean, bulk_stress_phase
        Shape (n,), as in `swtstudy.vocabulary.parameters.PARAMETERS`; 0 unless given.
    bulk_strain_share
        Shape (n,), as there; 1 unless given, and 0 where the stick zone is not to be shifted.
    """

    profile: AnyProfile
    poisson_ratio: FloatArray
    friction: FloatArray
    normal_amplitude: FloatArray
    p: IntArray
    q: IntArray
    tangential_amplitude: FloatArray
    phase: FloatArray
    shape: Shape = field(default_factory=dict)
    control: Control = DISPLACEMENTS
    path: Loop | None = None
    criterion: str = "swt"
    walker_exponent: FloatArray = field(default_factory=_not_given)
    normal_sensitivity: FloatArray = field(default_factory=_not_given)
    bulk_stress_amplitude: FloatArray = field(default_factory=_not_given)
    bulk_stress_mean: FloatArray = field(default_factory=_not_given)
    bulk_stress_phase: FloatArray = field(default_factory=_not_given)
    bulk_strain_share: FloatArray = field(default_factory=_not_given)

    def __post_init__(self) -> None:
        for name, value in _UNLESS_GIVEN.items():
            if not getattr(self, name).size:
                object.__setattr__(self, name, np.full(len(self), value))

    def __len__(self) -> int:
        return len(self.phase)


class Solution(NamedTuple):
    """The solution of a batch of points, each array of shape (n,).

    Attributes
    ----------
    s
        SWT/SWT0 (eqs. 10, 19), –.
    s_error
        Estimated absolute error of s, –.
    critical_x
        Position of the critical point on the surface, signed, in a_H = √(R δ0); NaN where s is 0: nothing is
        in tension then, or nothing moves, and no point is critical.
    critical_angle
        Angle of the critical plane's normal against the x axis, degrees in (-90, 90]; NaN where s is 0.
    regime
        Index into `REGIMES`.
    s_surface
        s over the circle on the surface through the critical point and all planes: s itself where the line
        y = 0 is enough, NaN where the critical point is at the edge r = b of a truncated paraboloid, –.
    """

    s: FloatArray
    s_error: FloatArray
    critical_x: FloatArray
    critical_angle: FloatArray
    regime: NDArray[np.int8]
    s_surface: FloatArray
