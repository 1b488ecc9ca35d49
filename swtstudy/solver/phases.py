"""Phases of two harmonic loads (7), (8) that give the same s: ω2/ω1 = p/q in lowest terms."""

from __future__ import annotations

import numpy as np

from swtstudy.vocabulary.arrays import BoolArray, FloatArray, IntArray

#: Turns that a phase is off a multiple of its period by rounding.
ROUNDING = 1e-12


def fold_phase(phase: FloatArray, p: IntArray, q: IntArray) -> tuple[FloatArray, BoolArray]:
    """Fold ψ into one symmetry period of s(ψ): 2π/p for even q, π/p for odd q.

    Shifting time by π/ω2 flips u and mirrors x.

    Parameters
    ----------
    phase
        Shape (n,), rad.
    p, q
        Shape (n,), ω2/ω1 = p/q in lowest terms.

    Returns
    -------
    folded, mirrored
        The equivalent phase in [0, period), and whether x and the plane's angle change sign with it.
    """
    folded, is_odd = _folded(phase, np.where(q % 2 == 0, 2.0, 1.0) * np.pi / p)
    return folded, (q % 2 == 1) & is_odd


def fold_bulk_phase(
    phase: FloatArray, moves: BoolArray, mirrored: BoolArray, both_ways: BoolArray
) -> tuple[FloatArray, BoolArray]:
    """Fold ψ_B of bulk stresses that oscillate with the tangential load, once ψ is folded.

    Mirroring x leaves a bulk stress as it is, but the shift of time by π/ω2 that flips u flips its
    oscillation, too.

    Parameters
    ----------
    phase
        Shape (n,), rad.
    moves
        Shape (n,): whether the bulk stress oscillates; elsewhere it has no phase.
    mirrored
        Shape (n,): where `fold_phase` mirrors x.
    both_ways
        Shape (n,): whether that shift of time leaves ψ as it is, so that ψ_B + π mirrors x.

    Returns
    -------
    folded, mirrored
        The equivalent ψ_B in [0, π) or [0, 2π), and whether x is mirrored by both folds together.
    """
    phase = phase + np.where(mirrored, np.pi, 0.0)
    folded, is_odd = _folded(phase, np.where(both_ways, 1.0, 2.0) * np.pi)
    return np.where(moves, folded, 0.0), mirrored ^ (moves & both_ways & is_odd)


def _folded(phase: FloatArray, period: FloatArray) -> tuple[FloatArray, BoolArray]:
    """Phases in [0, period), and whether they were an odd number of periods away."""
    turns = np.floor(phase / period + ROUNDING)
    return np.maximum(phase - turns * period, 0.0), turns % 2 == 1
