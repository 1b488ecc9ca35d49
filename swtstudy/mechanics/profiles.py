"""STUB: which profiles are admissible."""

from __future__ import annotations


def check_shape(profile: str, shape: dict[str, float], normal_amplitude: float = 0.0) -> str | None:
    """Message if the profile is not admissible for any load, else None."""
    if profile == "wavy_paraboloid" and shape["waviness_amplitude"] > 0 and shape["wavelength"] < 3.54:
        return f"wavelength {shape['wavelength']:g} is below 3.54, the smallest for a compact contact"
    return None
