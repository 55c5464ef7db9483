"""Bases of a flow to ask friction laws about."""

import numpy as np

from landlab_debrisflow.core.parameters import on_nodes
from landlab_debrisflow.physics.contracts import BasalState, BasalStress
from landlab_debrisflow.physics.material import Material

G, DENSITY = 9.81, 1990.0


def base(speed, thickness=2.0, effective_normal_stress=1e4, slip_ratio=0.0):
    """Return a state of as many particles as there are speeds [m s-1]; the rest likewise or one for all."""
    speed, thickness, stress = (
        np.array(values)
        for values in np.broadcast_arrays(
            np.atleast_1d(np.asarray(speed, float)),
            np.asarray(thickness, float),
            np.asarray(effective_normal_stress, float),
        )
    )
    none = np.full(speed.size, np.nan)  # no law of friction may look at these
    return BasalState(
        depth=none,
        thickness=thickness,
        speed=speed,
        density=np.full(speed.size, DENSITY),
        normal_gravity=none,
        stress=BasalStress(stress, none, none),
        eroded_depth=none,
        material=Material(gravity=G, basal_slip_ratio=slip_ratio),
        parameters=None,
        variables=None,
    )


def ask(law, state):
    """Return yield stress [Pa] and drag [Pa s m-1]."""
    out = np.full((2, state.speed.size), np.nan)
    law.basal_resistance(state._replace(parameters=on_nodes(law, {})), *out)
    return out


def resistance(law, speed, **given):
    """Return tau_b [Pa] at some speeds."""
    yield_stress, drag = ask(law, base(speed, **given))
    return yield_stress + drag * speed
