"""What the tests of quantities ask for."""

from swtstudy import Study

EVERY = (
    *("dissipation", "stick_radius", "stick_left", "stick_right"),
    *("contact_radius", "force_ratio", "von_mises"),
)
VARIABLES = ("dissipation", "dissipation_error", *EVERY[1:])


def study(
    more: str = "", axes: str = "phase = [0.5, 1.0, 2.0, 4.0]", quantities: tuple[str, ...] = ()
) -> Study:
    """A study that asks for quantities."""
    asked = f"quantities = {list(quantities)}\n" if quantities else ""
    return Study.from_text(f'title = "t"\nrtol = 1e-3\n{asked}{more}[axes]\n{axes}\n')
