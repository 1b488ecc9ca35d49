"""The archive of a study: its labelled values with full provenance."""

from __future__ import annotations

import platform
from datetime import UTC, datetime
from importlib.metadata import version
from typing import TYPE_CHECKING

import xarray as xr

import swtstudy
from swtstudy.labelled import arrays_of, label
from swtstudy.runner.plan import UniquePoints
from swtstudy.runner.values import Values

if TYPE_CHECKING:
    from swtstudy.study.definition import Study

#: Packages whose versions can matter for the numbers or the file.
_PACKAGES = ("numpy", "scipy", "xarray", "netCDF4", "dask")

REFERENCE = "E. Willert, Eng 2024, 5, 333-346, doi:10.3390/eng5010018"


def build(study: Study, points: UniquePoints, values: Values, seconds: float) -> xr.Dataset:
    """The Dataset of a computed study, with its provenance in the global attributes."""
    dataset = label(study.grid, arrays_of(values.at(points.index), points.mirrored))
    return dataset.assign_attrs(provenance(study, seconds))


def provenance(study: Study, seconds: float) -> dict[str, str | float]:
    """Global attributes: what the archive is, and how it was made."""
    now = datetime.now(UTC).isoformat(timespec="seconds")
    versions = [f"python {platform.python_version()}", *(f"{name} {version(name)}" for name in _PACKAGES)]
    attributes: dict[str, str | float] = {
        "Conventions": "CF-1.11",
        "title": study.title,
        "source": f"swtstudy {swtstudy.__version__}",
        "history": f"{now}: computed by swtstudy {swtstudy.__version__}",
        "references": REFERENCE,
        "versions": ", ".join(versions),
        "rtol": study.rtol,
        "wall_time_seconds": round(seconds, 3),
        "study": study.text,
    }
    if study.figure is not None:
        attributes["figure"] = study.figure.to_json()
    return attributes
