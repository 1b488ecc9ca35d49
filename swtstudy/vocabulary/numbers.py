"""Reading arrays of numbers from users: masked values become NaN, anything but a number is a mistake."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from swtstudy.vocabulary.mistakes import Mistake, StudyError, is_number, literal, plain_number


def read_numbers(key: str, values: object, allowed: str) -> NDArray[np.float64]:
    """Numbers of any shape as floats.

    Parameters
    ----------
    key, allowed
        Name of the values, and what is allowed for them, for messages.
    values
        A number, also a Fraction, or nested sequences or an array of them.

    Returns
    -------
    array
        NaN where a value is masked.

    Raises
    ------
    StudyError
        If there is anything but real numbers, such as text, truth values, complex numbers, times or ragged
        sequences.
    """
    mistake = StudyError([Mistake(key, literal(values), allowed)])
    try:
        array: np.ma.MaskedArray = np.ma.asarray(values)
    except (TypeError, ValueError):
        raise mistake from None
    if array.dtype.kind == "O":
        known = np.ma.filled(array, np.nan)
        if not all(map(is_number, known.flat)):
            raise mistake
        return np.array([plain_number(value) for value in known.flat]).reshape(known.shape)
    if array.dtype.kind not in "iuf":
        raise mistake
    return np.asarray(np.ma.filled(array.astype(float), np.nan))
