"""The map of Vingsbo and Söderberg: its border, life and work against closed forms."""

import numpy as np
import pytest
from folders import RESULTS

import swtstudy


@pytest.fixture(scope="module")
def results():
    return swtstudy.open_results(RESULTS / "vingsbo_map.nc")


def test_the_contact_slides_beyond_the_limit_of_cattaneo_and_mindlin(results):
    """u = 3 μ F (2 − ν)/(16 G a) × 2 for two like bodies."""
    shear = 73.1e3 / (2.0 * 1.33)
    force, radius = results.normal_force, results.contact_radius
    limit = 3.0 * 0.5 * force * (2.0 - 0.33) / (16.0 * shear * radius) * 2.0
    slides = results.swt.words("regime") == "gross_slip"
    beyond = (results.tangential_amplitude > limit).transpose(*slides.dims)
    np.testing.assert_array_equal(slides, beyond)
    assert 0.2 < float(beyond.mean()) < 0.8


def test_beyond_it_life_is_constant_and_work_grows_by_the_force_times_the_way(results):
    for force in (50.0, 200.0):
        row = results.sel(normal_force=force)
        slides = row.where(row.swt.words("regime") == "gross_slip", drop=True)
        np.testing.assert_allclose(slides.cycles, slides.cycles[0], rtol=0.02)
        slope = slides.dissipation.diff("tangential_amplitude") / slides.tangential_amplitude.diff(
            "tangential_amplitude"
        )
        np.testing.assert_allclose(slope, 4.0 * 0.5 * force, rtol=1e-3)
