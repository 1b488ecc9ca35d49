"""The pictures of the paper's profiles."""

from pathlib import Path

from swtstudy.figures.definitions import draw_profile

#: Shapes at which each is drawn.
SHAPES = {
    "paraboloid": {},
    "rounded_punch": {"flat_radius": 0.5},
    "truncated_paraboloid": {"flat_radius": 0.5},
    "wavy_paraboloid": {"waviness_amplitude": 0.05, "wavelength": 5.0},
}


def draw_profiles(folder: Path) -> None:
    """Draw them, each as profile_NAME.svg."""
    for name, shape in SHAPES.items():
        draw_profile(profile=name, **shape).savefig(folder / f"profile_{name}.svg")
