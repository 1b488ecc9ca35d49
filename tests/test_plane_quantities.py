"""Quantities of plane contacts, and what results say of them."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from scenes import PLANE_NAMES, plane_points

import swtstudy
from swtstudy.mechanics.control.force import unit_half_load
from swtstudy.mechanics.stress import work
from swtstudy.mechanics.stress.scene import scene_of

Array = NDArray[np.float64]


def slip_work(pull: float, count: int = 4000) -> float:
    """Work per cycle by the local slip of Cattaneo and Mindlin's contact, over μP_0 · μδ0.

    From +Q to −Q the shear in the slip zone turns from μp to −μp, and q − q_before is twice that of a
    contact that moves for the first time by Q: ∮ = 2 ∫ 2 μp · slip dx over one side, twice, one way and back.
    """
    c = np.sqrt(1.0 - pull)
    # Slip is what the displacements by the change of the shear lack to those of the stick zone:
    # u′ = −(2/π) ∫ q ds/(x − s), of √(a² − s²): −2 x within, −2 (x − √(x² − a²)) beyond; the pressure is ½ √.
    x = c + (1.0 - c) * (np.arange(count) + 0.5) / count
    gradient = -2.0 * (0.5 * np.sqrt(x * x - c * c))  # times μ: what remains of both, of a change by 1
    slip = 2.0 * np.cumsum(gradient) * (1.0 - c) / count
    pressure = 0.5 * np.sqrt(1.0 - x * x)
    one_way = 2.0 * float((np.abs(slip) * pressure).sum()) * (1.0 - c) / count
    return 2.0 * one_way / (0.25 * np.pi)


def of(function: str, batch):  # type: ignore[no-untyped-def]
    return getattr(work, function)(scene_of(batch), unit_half_load(batch.profile, batch.shape, len(batch)))


@pytest.mark.parametrize("pull", [0.3, 0.6, 0.9])
def test_dissipated_work(pull: float) -> None:
    found, error = of("dissipated_work", plane_points("cylinder", 0.3, 0.4, 0.0, pull))
    assert found[0] == pytest.approx(slip_work(pull), rel=1e-3)
    assert error[0] < 1e-5 * found[0]
    if pull == 0.6:
        assert found[0] == pytest.approx(0.0420060 / (0.25 * np.pi), rel=1e-5)
