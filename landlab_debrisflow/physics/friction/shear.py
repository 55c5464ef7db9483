"""Terms shared by friction laws: cohesion and friction, velocity of shear, lower bounds of divisors.

With a basal slip ratio s the flow slides at v_b = s v, as a block does; the rest of the mean velocity, (1 - s) v, is by
shear.
"""

import numpy as np

from ..contracts import BasalState

SLOWEST = 1e-9
"""Least velocity of shear in the drag, three centimetres a year [m s-1]. The drag over speed of a fluid with a yield
stress, or of one that thins under shear, goes to infinity at rest; with this bound a body that starts reaches its speed
in a few kicks."""

THINNEST = 1e-6
"""Least thickness in a rate of shear, a grain of clay [m]: no rate divides by 0."""


def strength(cohesion, friction_angle, state: BasalState, out) -> None:
    """Write c + sigma' tan(phi) [Pa] into `out`, shape (n,) (Coulomb; Terzaghi's effective stress).

    `cohesion` is c [Pa], `friction_angle` is phi [rad], each (n,) or (1,); sigma' is that of `state` [Pa].
    """
    np.multiply(np.tan(friction_angle), state.stress.effective_normal, out=out)
    out += cohesion


def shearing(state: BasalState):
    """Return the velocity of shear (1 - s) v [m s-1] and its ratio to thickness [s-1], each (n,) and > 0.

    v is the speed of `state`, s the basal slip ratio [-] of its material.
    """
    velocity = np.maximum((1.0 - state.material.basal_slip_ratio) * state.speed, SLOWEST)
    return velocity, velocity / np.maximum(state.thickness, THINNEST)
