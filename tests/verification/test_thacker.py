"""Water in a parabolic basin (Thacker, 1981): order of the scheme where the ground is curved and the edge moves.

2.25 periods, so that it moves as fast as it ever does; relative errors as benchmarks/flow_measure.py defines them.
"""

from benchmarks.flow_basins import thacker_curved, thacker_planar


def test_a_flat_surface_swings_to_and_fro():
    found = thacker_planar(500)
    # measured .018 of h and .019 of hu: the release starts .8 % narrower than the cap and breathes from there on, while
    # the centre is right to 4e-4 of its way; .0098 with 2000 particles, .0050 with 8000
    assert found.h.l1 < 0.025 and found.hu.l1 < 0.025
    assert found.h.max < 0.03  # no jets at the edge; measured .019
    # momentum of the inner forces is exact, that of the ground goes with where the particles are; measured 4e-4
    assert found.scalars["momentum, error"] < 2e-3
    assert -8e-3 < found.scalars["energy drift"] < 0.0  # measured -3e-3


def test_a_curved_surface_breathes():
    found = thacker_curved(500)
    # measured .030 and .20: the shock viscosity damps what closes, at first order (energy -.18; -.10 at 2000, -.05 at
    # 8000), far more than anything else here
    assert found.h.l1 < 0.04 and found.hu.l1 < 0.25
    assert -0.22 < found.scalars["energy drift"] < 0.0
    assert found.scalars["momentum, error"] < 2e-3  # measured 4e-4: it stays in the middle
