"""Types of arrays."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]
BoolArray = NDArray[np.bool_]
#: Numbers of points, columns and the like.
IndexArray = NDArray[np.intp]
#: Shape parameters of n profiles of a family, by name.
Shape = dict[str, FloatArray]
