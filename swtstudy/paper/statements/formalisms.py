"""Section 3.1: Jäger's algorithm, memory diagrams and springs solve the same contact problem."""

from __future__ import annotations

import numpy as np

from swtstudy.paper.formalisms.jaeger import JaegerContact
from swtstudy.paper.formalisms.memory_diagram import MemoryDiagram
from swtstudy.paper.reference import march_springs
from swtstudy.paper.statements.statement import Finding, Statement
from swtstudy.vocabulary.arrays import FloatArray

#: Random load paths, their corners, and springs across the largest contact.
_PATHS, _CORNERS, _SPRINGS = 20, 40, 401
#: Differences up to here, in units of the largest spring force, are rounding summed along a path.
_ROUNDING = 1e-9


def random_path(seed: int) -> tuple[FloatArray, FloatArray]:
    """Depth and tangential displacement at the corners of a random path; every fourth path lifts off.

    Returns
    -------
    depth, displacement
        Shape (corners,), in δ0 and μE*δ0/G*.
    """
    rng = np.random.default_rng(seed)
    depth = rng.uniform(-0.3 if seed % 4 == 0 else 0.05, 1.6, _CORNERS)
    # From nearly normal to nearly tangential motion.
    displacement = np.cumsum(rng.normal(size=_CORNERS)) * 10.0 ** rng.uniform(-1.0, 0.2)
    depth[0], displacement[0] = 1.0, 0.0
    return depth, displacement


def largest_difference(depth: FloatArray, displacement: FloatArray) -> float:
    """Largest difference of the spring forces of any two formalisms along a path, over the largest force."""
    g = np.linspace(0.0, depth.max(), _SPRINGS)
    _, springs = march_springs(g, depth, displacement, periods=1)
    contacts = JaegerContact(depth[0], displacement[0]), MemoryDiagram(depth[0], displacement[0])
    worst = 0.0
    for corner in range(1, len(depth)):
        found = [springs[corner]]
        for contact in contacts:
            contact.step(depth[corner], displacement[corner])
            found.append(contact.springs(g))
        worst = max(worst, float(np.ptp(found, axis=0).max()))
    return worst / float(np.abs(springs).max())


def formalisms_agree() -> Finding:
    """Compare the three formalisms on random paths of a paraboloid, with gross slip and lift-off."""
    worst = max(largest_difference(*random_path(seed)) for seed in range(_PATHS))
    measured = (
        f"on {_PATHS} random paths of {_CORNERS} corners, with gross slip and lift-off, tangential forces of "
        f"{_SPRINGS} springs differ by up to {worst:.0e} of the largest"
    )
    return Finding(measured, worst <= _ROUNDING)


STATEMENTS = (
    Statement(
        "Section 3.1",
        "Jäger's algorithm, the method of memory diagrams and the MDR are equivalent.",
        "their solutions differ by no more than rounding, 1e-9, on random load paths",
        formalisms_agree,
    ),
)
