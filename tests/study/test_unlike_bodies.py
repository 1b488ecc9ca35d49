"""Bodies that differ elastically: what counts is Dundurs' β over the friction."""

import pytest
from told import refused

import swtstudy

#: Steel on aluminium, and 52100 steel on Ti-6Al-4V: Young's moduli and Poisson ratios.
PAIRS = {
    "aluminium": {"young_modulus": (210e3, 71e3), "poisson_ratio": (0.3, 0.33)},
    "titanium": {"young_modulus": (210e3, 113.8e3), "poisson_ratio": (0.29, 0.31)},
}
LOADS = {"radius": 50.0, "normal_force": 200.0, "tangential_force_amplitude": 40.0}


@pytest.mark.parametrize("friction", [0.5, 0.8])
@pytest.mark.parametrize("name", PAIRS)
def test_usual_pairs_are_warned_of_with_their_number(name: str, friction: float) -> None:
    with pytest.warns(UserWarning, match="Dundurs") as told:
        contact = swtstudy.physical(**PAIRS[name], **LOADS, friction=friction)
    beta = contact.moduli.mismatch
    words = f"Dundurs' β = {beta:.3g} is {abs(beta) / friction:.2g} times the friction {friction:g}"
    assert words in str(told[0].message)
    assert (contact.solve(1e-2).SWT > 0.0).all()


def test_low_friction_is_refused_and_similar_accepts_it() -> None:
    given = PAIRS["aluminium"] | LOADS
    words = r"0\.38 times the friction 0\.3; allowed: .*similar = 0\.39 accepts"
    refused(words, swtstudy.physical, **given, friction=[0.3, 0.6])
    with pytest.warns(UserWarning, match="0.38 times the friction 0.3"):
        swtstudy.physical(**given, friction=[0.3, 0.6], similar=0.39)
