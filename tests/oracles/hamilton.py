"""Hamilton's stress fields under a Hertzian contact, at the surface, from ContactMechanics."""

import numpy as np
from numpy.typing import NDArray

from oracles import hertz

Array = NDArray[np.float64]


def hamilton(x: Array, depth: float, nu: float, normal: float, tangential: float) -> tuple[Array, ...]:
    """σ_xx, σ_yy, σ_zz, σ_xz at y = z = 0 by the Hertzian pressure times ``normal`` and the same traction
    in +x times ``tangential``, for the indentation depth in δ0; not at the contact edge.
    """
    a = np.sqrt(depth)
    p0, zero = 2.0 / np.pi * a, np.zeros_like(x)
    fields = []
    for field, factor in ((hertz.pressed, normal), (hertz.dragged, tangential)):
        xx, yy, zz, _, xz, _ = field(x / a, zero, zero, nu)
        fields.append([factor * p0 * component for component in (xx, yy, zz, xz)])
    return tuple(n + t for n, t in zip(*fields, strict=True))
