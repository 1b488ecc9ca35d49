"""Equilibrium of prescribed forces: where it is lost, the body slides away or falls apart."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.load.load import Load
from swtstudy.vocabulary.prescribed import Control

#: Excess that is rounding, in the largest normal load: 2e-16 at most for 20,000 sines that just reach T = N.
ROUNDING = 1e-12


def out_of_equilibrium(load: Load, control: Control) -> NDArray[np.bool_]:
    """True where there is no equilibrium at some instant, so that there is no stationary cycle.

    A tangential force needs |T| ≤ N, and a normal force N ≥ 0, both beyond rounding.

    Parameters
    ----------
    load
        n loads in the coordinate of the memory diagram.
    control
        What of them is prescribed as a force.

    Returns
    -------
    Shape (n,).
    """
    least = -ROUNDING * load.largest_normal
    lost = load.least_normal < least if control.normal_force else np.zeros(len(load), dtype=bool)
    if control.tangential_force:
        instants = load.turning_instants()
        # The normal force has none where the bodies are apart.
        normal, tangential = np.maximum(load.normal(instants), 0.0), np.abs(load.tangential(instants))
        lost = lost | ((normal - tangential).min(axis=1) < least)
    return np.asarray(lost)
