"""What tests of several rooms ask of studies and archives as a user does: by calls, files and commands."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
import stand_in
from command import merged

from swtstudy import Study, StudyError, run

#: A sphere of aluminium on its like, in newtons and millimetres; its loads are to follow.
RIG: dict[str, Any] = {"young_modulus": 73.1e3, "poisson_ratio": 0.33, "radius": 50.0, "friction": 0.5}


def refused(words: str, function: Callable[..., Any], *arguments: Any, **given: Any) -> StudyError:
    """The error with which a call is refused, in which the words are found; any without words."""
    with pytest.raises(StudyError, match=words or None) as caught:
        function(*arguments, **given)
    return caught.value


def written(study: Study, folder: Path) -> Study:
    """The study that an archive of it keeps when it is merged."""
    run(study, folder / "kept.nc", workers=1, solver=stand_in.smooth)
    return Study.from_text(merged(folder / "kept.nc").attrs["study"])
