"""A cap runs down a channel that bends: curvature must neither take nor give energy."""

from validation.cases.basins import curved_channel


def test_a_bend_does_no_work():
    found, _ = curved_channel(500)
    # measured -2.3e-3 of the kinetic energy, -5e-4 with 8000 particles: the shock viscosity. Through half a circle
    # at up to 29 m/s and over banks as steep as 45 degrees.
    assert -4e-3 < found.scalars["energy drift over kinetic energy"] < 1e-4
    assert abs(found.scalars["mean way along the bend [deg]"] - 130.0) < 1.0  # measured 130.2
    assert found.scalars["fastest [m/s]"] < 31.0  # 29.4, 29.7, 29.5: no particle is shot out
