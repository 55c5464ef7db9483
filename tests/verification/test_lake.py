"""A lake over an uneven floor. Slope-normal equations know no level lake: g sin^3(theta) is left over."""

import pytest

from validation.cases.basins import lake_damped, lake_rough


@pytest.mark.slow
def test_a_damped_lake_becomes_level():
    found = lake_damped(1000)
    # 1 m over waves of 5 cm by 20 m, seven particles long. Measured 5.9 mm and 1.5 mm, 2.6 mm with 4000 particles:
    # noise of the thickness of a disordered lattice, .6 %. The waves themselves would show with 25 mm rms.
    assert found.scalars["surface rms [m]"] < 8e-3
    assert abs(found.scalars["surface mean [m]"]) < 2.2e-3
    # measured .022, .011 before slopes were limited; celerity is 3.1 m/s
    assert found.scalars["largest speed [m/s]"] < 0.03


def test_a_lake_over_a_rough_floor_stays_quiet():
    found = lake_rough(1000)
    # waves of .5 m by 20 m below 2 m, without friction, after 30 s: measured .030 m/s of celerity 4.4 m/s. A quarter
    # wave of g sin^3(theta), .017 m/s2 rms, on its own drives some .02 m/s.
    assert found.scalars["rms speed at the end [m/s]"] < 0.046
    assert found.h.l1 < 0.033  # measured .024
