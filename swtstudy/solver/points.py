"""Points of parameters and their solution, as named arrays; from points to s."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple, Self

import numpy as np
from numpy.typing import NDArray

from swtstudy.vocabulary.arrays import FloatArray, IntArray, Shape
from swtstudy.vocabulary.parameters import DISPLACEMENTS, PARAMETERS, Control

if TYPE_CHECKING:
    from swtstudy.solver.load_path import Loop
    from swtstudy.solver.table import AnyProfile

#: Numbers that points have unless they are given.
_UNLESS_GIVEN = {n: row.default for n, row in PARAMETERS.items() if row.optional and row.kind == "number"}
#: Arrays of shape (0,) are not given.
_not_given = partial(np.empty, 0)


@dataclass(frozen=True)
class Points:
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

    def __getitem__(self, index: Any) -> Self:
        """The points at an index of NumPy's, repetitions allowed."""
        own = {name: value[index] for name, value in vars(self).items() if isinstance(value, np.ndarray)}
        return replace(self, **own, shape={name: value[index] for name, value in self.shape.items()})


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


def solve_points(points: Points, rtol: float = 1e-4) -> Solution:
    """s of every point (eqs. 7–20).

    Parameters
    ----------
    points
        n points of one profile family and control.
    rtol
        Relative accuracy asked for.

    Returns
    -------
    Solution
        Arrays of shape (n,), NaN where the body slides away. The value of a point does not depend on the
        others.

    Raises
    ------
    ArithmeticError
        If a load cycle has more pieces than the solver has room for.
    """
    # The compiler is imported where points are solved.
    from swtstudy.kernel.batch import solve_batch

    found = solve_batch(**arguments_of(points), rtol=rtol)
    own = {name: found[name].copy() for name in Solution._fields}
    return Solution(**own | {"regime": own["regime"].astype(np.int8)})


def arguments_of(points: Points) -> dict[str, Any]:
    """Points as arguments of `swtstudy.kernel.batch.chunks`."""
    given = {name.replace("bulk_stress", "bulk"): value for name, value in vars(points).items()}
    p, q, path, control = (given.pop(name) for name in ("p", "q", "path", "control"))
    return given | {
        "pulled": given.pop("bulk_strain_share"),
        "frequency_ratio": [*map(Fraction, p.tolist(), q.tolist())],
        "loops": None if path is None else [path] * len(points),
        "control": (control.normal_force, control.tangential_force),
    }
