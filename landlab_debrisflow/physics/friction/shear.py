"""Terms shared by friction laws: cohesion and friction, velocity of shear, lower bounds of divisors.

With a basal slip ratio s the flow slides at v_b = s v, as a block does; the rest of the mean velocity, (1 - s) v, is by
shear.
"""

import math

import numpy as np

from ...core.constants import THINNEST
from ..contracts import BasalState

SLOWEST = 1e-9
"""Least velocity of shear in the drag, three centimetres a year [m s-1]. The drag over speed of a fluid with a yield
stress, or of one that thins under shear, goes to infinity at rest; with this bound a body that starts reaches its speed
in a few kicks."""

STEEPEST = math.tan(math.radians(89.0))
"""Largest coefficient of friction [-]."""


def strength(cohesion, friction_angle, state: BasalState, out) -> None:
    """Write c + sigma' tan(phi) [Pa] into `out`, shape (n,) (Coulomb; Terzaghi's effective stress).

    `cohesion` is c [Pa], `friction_angle` is phi [rad], each (n,) or (1,); sigma' is that of `state` [Pa]. The angle of
    dilatancy of `state`, if there is one, is added to phi.
    """
    np.multiply(friction_coefficient(friction_angle, state), state.stress.effective_normal, out=out)
    out += cohesion


def friction_coefficient(friction_angle, state: BasalState):
    """Return tan(phi), or tan(phi + psi) of debris that dilates by the angle psi (Iverson & George, 2014, eq. 4.16).

    `friction_angle` is phi [rad], (n,) or (1,); `state` may have tan(psi), of shape (n,) [-].
    """
    grains, dilatancy = np.tan(friction_angle), state.dilatancy
    if dilatancy is None:
        return grains
    whole = 1.0 - grains * dilatancy  # of the tangent of a sum
    return np.clip((grains + dilatancy) / np.maximum(whole, 1.0 / STEEPEST), 0.0, STEEPEST)


def shearing(state: BasalState):
    """Return the velocity of shear (1 - s) v [m s-1] and its ratio to thickness [s-1], each (n,) and > 0.

    v is the speed of `state`, s the basal slip ratio [-] of its material.
    """
    velocity = np.maximum((1.0 - state.material.basal_slip_ratio) * state.speed, SLOWEST)
    return velocity, velocity / np.maximum(state.thickness, THINNEST)
