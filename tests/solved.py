"""Points one by one, and their values as the package tells them: what `scenes` draws, solved as a study."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Any, NamedTuple, Self

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

import swtstudy
from swtstudy import Study
from swtstudy.points.solve import solve_grid

Array = NDArray[np.float64]

#: Names of the numbers of a regime, as results have them.
REGIMES = ("stick", "partial_slip", "gross_slip", "lift_off", "not_finite", "no_equilibrium")

#: Numbers of the status of a point.
COMPUTED, FAILED, MISSING = range(3)

#: More than this is asked of no study.
LEAST_RTOL = 1e-7

#: What points have unless it is given.
_UNLESS_GIVEN = {
    "walker_exponent": 0.5,
    "normal_sensitivity": 0.0,
    "bulk_stress_amplitude": 0.0,
    "bulk_stress_mean": 0.0,
    "bulk_stress_phase": 0.0,
    # What the values are compared with knows no shift of the stick zone.
    "bulk_strain_share": 0.0,
}
_BULK = ("bulk_stress_amplitude", "bulk_stress_mean", "bulk_stress_phase")


def _not_given() -> Array:
    return np.empty(0)


class Control(NamedTuple):
    """Whether a force is prescribed in either direction, instead of a displacement."""

    normal_force: bool = False
    tangential_force: bool = False


DISPLACEMENTS = Control()


@dataclass(frozen=True)
class Points:
    """n points of one profile and control, by the names of the parameters; ω2/ω1 = p/q.

    Arrays have the shape (n,); the amplitudes are those of forces where `control` says so.
    """

    profile: Any
    poisson_ratio: Array
    friction: Array
    normal_amplitude: Array
    p: NDArray[np.int64]
    q: NDArray[np.int64]
    tangential_amplitude: Array
    phase: Array
    shape: dict[str, Array] = field(default_factory=dict)
    control: Control = DISPLACEMENTS
    path: Any = None
    criterion: str = "swt"
    walker_exponent: Array = field(default_factory=_not_given)
    normal_sensitivity: Array = field(default_factory=_not_given)
    bulk_stress_amplitude: Array = field(default_factory=_not_given)
    bulk_stress_mean: Array = field(default_factory=_not_given)
    bulk_stress_phase: Array = field(default_factory=_not_given)
    bulk_strain_share: Array = field(default_factory=_not_given)

    def __post_init__(self) -> None:
        for name, value in _UNLESS_GIVEN.items():
            if not getattr(self, name).size:
                object.__setattr__(self, name, np.full(len(self), value))

    def __len__(self) -> int:
        return len(self.phase)

    def __getitem__(self, index: ArrayLike) -> Self:
        """The points at an index, repetitions allowed."""
        index = np.asarray(index)
        columns = {name: value[index] for name, value in vars(self).items() if isinstance(value, np.ndarray)}
        return replace(self, **columns, shape={name: value[index] for name, value in self.shape.items()})


@dataclass(frozen=True)
class Solution:
    """What results say of n points, arrays of shape (n,); the regime is a number of `REGIMES`."""

    s: Array
    s_error: Array
    critical_x: Array
    critical_angle: Array
    regime: NDArray[np.int8]
    s_surface: Array


def columns_of(batch: Points) -> dict[str, list[Any]]:
    """The values of a batch by the names of the parameters, of which each point has one."""
    forces = (
        "force_" if batch.control.normal_force else "",
        "force_" if batch.control.tangential_force else "",
    )
    found = {
        "poisson_ratio": batch.poisson_ratio,
        "friction": batch.friction,
        f"normal_{forces[0]}amplitude": batch.normal_amplitude,
        f"tangential_{forces[1]}amplitude": batch.tangential_amplitude,
        **batch.shape,
    }
    if batch.path is None:
        found["phase"] = batch.phase
    if batch.criterion == "swt":
        if (batch.walker_exponent != _UNLESS_GIVEN["walker_exponent"]).any():
            found["walker_exponent"] = batch.walker_exponent
    else:
        found["normal_sensitivity"] = batch.normal_sensitivity
    bulk = [name for name in _BULK if getattr(batch, name).any()]
    if batch.path is not None:
        bulk = [name for name in bulk if name != "bulk_stress_phase"]
    elif bulk == ["bulk_stress_mean", "bulk_stress_phase"] or bulk == ["bulk_stress_phase"]:
        bulk.remove("bulk_stress_phase")
    found |= {name: getattr(batch, name) for name in bulk}
    columns: dict[str, list[Any]] = {name: np.asarray(values).tolist() for name, values in found.items()}
    if batch.path is None:
        columns["frequency_ratio"] = [f"{p}/{q}" for p, q in zip(batch.p, batch.q, strict=True)]
    return columns


def results_of(
    batch: Points, rtol: float = 1e-4, quantities: Sequence[str] = (), distance: float | None = None
) -> xr.Dataset:
    """Results at the points of a batch, along the dimension sample, with means if a distance is given."""
    fixed: dict[str, Any] = {} if batch.criterion == "swt" else {"criterion": batch.criterion}
    if distance is not None:
        fixed["critical_distance"] = distance
    if batch.bulk_stress_amplitude.any():
        fixed["stick_zone_shift"] = "none"
    columns = columns_of(batch)
    rtol = max(rtol, LEAST_RTOL)
    if batch.path is None and isinstance(batch.profile, str):
        lines = [f"{name} = {value!r}" for name, value in {"profile": batch.profile, **fixed}.items()]
        sample = [f"{name} = {values}" for name, values in columns.items()]
        head = ['title = "t"', f"rtol = {rtol!r}", f"quantities = {list(quantities)}"]
        study = Study.from_text("\n".join([*head, "[fixed]", *lines, "[sample.points]", *sample]))
        return solve_grid(study.grid, rtol, study.asked)
    if batch.path is not None:
        fixed["load"] = batch.path
    each = []
    for k in range(len(batch)):
        own = {name: values[k] for name, values in columns.items()}
        found = swtstudy.solve(rtol=rtol, profile=batch.profile, **fixed, **own, quantities=quantities)
        each.append(found.reset_coords(drop=True))
    return xr.concat(each, "sample")


def solve_points(batch: Points, rtol: float = 1e-4) -> Solution:
    """s of every point, as `swtstudy.solve` and a study tell it."""
    found = results_of(batch, rtol)
    return Solution(**{name: found[name].values for name in Solution.__dataclass_fields__})
