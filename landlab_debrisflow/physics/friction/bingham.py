"""Bingham fluid in plane flow, its yield stress with a frictional part."""

import numpy as np

from ...core.jit import kernel
from ...core.parameters import declared, parameter
from ..contracts import BasalState
from .shear import shearing, strength


@declared
class Bingham:
    """v - v_b = (tau_y h_n/(6 mu)) (1 - xi)^2 (2 + xi)/xi, xi = tau_y/tau_b: a plug on a sheared layer.

    Symbols: v mean speed and v_b speed at the base [m s-1]; tau_b basal shear stress, tau_y the yield part of tau_b and
    tau_0, `yield_stress` [Pa]; mu, `viscosity` [Pa s]; h_n slope-normal thickness [m]; xi plug over thickness [-];
    sigma' effective normal stress at the base [Pa]; phi, `basal_friction_angle` [deg].

    tau_y = tau_0 + sigma' tan(phi). Pore pressure enters through sigma' only; with the default phi = 0 it has no
    effect. Solved for tau_b: a cubic, xi^3 - (3 + a) xi + 2 = 0 with a = 6 mu (v - v_b)/(tau_y h_n). Without yield
    stress
    tau_b = 3 mu (v - v_b)/h_n.

    References
    ----------
    Bingham (1922); in plane flow, averaged over the depth, Jiang & LeBlond (1993), Pastor et al. (2004).
    """

    yield_stress: float = parameter("Pa", "tau_0, whatever the normal stress", 500.0, (0.0, None), varies=True)
    viscosity: float = parameter("Pa s", "of the sheared layer: stress beyond yield over shear rate", 50.0,
                                 (1e-6, None), varies=True)  # fmt: skip
    basal_friction_angle: float = parameter(
        "deg", "for the part of the yield stress that grows with effective normal stress", 0.0, (0.0, 89.0), varies=True
    )

    def basal_resistance(self, state: BasalState, yield_stress, drag) -> None:
        """Write `yield_stress`, tau_y [Pa], and `drag`, (tau_b - tau_y)/speed [Pa s m-1], each (n,), from a `state`.

        Parameters
        ----------
        state : BasalState
            Base of the flow under n particles.
        yield_stress : ndarray, shape (n,)
            Written: stress that holds a body at rest, >= 0 [Pa].
        drag : ndarray, shape (n,)
            Written: other resistance over speed, >= 0 [Pa s m-1].
        """
        here = state.parameters
        strength(here.yield_stress, here.basal_friction_angle, state, yield_stress)
        velocity, rate = shearing(state)
        rate *= 6.0 * here.viscosity
        stress_beyond_yield(yield_stress, rate, drag)
        drag /= velocity
        drag *= 1.0 - state.material.basal_slip_ratio


@kernel
def stress_beyond_yield(yield_stress, twice_newtonian, out):
    """Write w = tau_b - tau_y [Pa], from f = 6 mu v/h > 0, twice the stress of a fluid without yield stress [Pa].

    All have shape (n,): `yield_stress` is tau_y [Pa], `twice_newtonian` is f, `out` gets w.

    The cubic in w, w^2 (3 tau_y + 2 w) = f (tau_y + w)^2, has one root > 0 and no cancellation near it: w is
    (f tau_y/3)^(1/2) for small f and (f + tau_y)/2 for large. The start is within 12 % of it for every f;
    Halley's steps leave errors of 1.4e-3, 2e-9, and rounding. Without a test of convergence the loop is vectorised.
    """
    for i in range(out.size):
        t, f = yield_stress[i], twice_newtonian[i]
        w = np.sqrt(f * (t / 3.0 + 0.25 * f))
        for _ in range(3):
            b = t + w
            value = w * w * (3.0 * t + 2.0 * w) - f * b * b
            slope = 2.0 * b * (3.0 * w - f)
            w -= 2.0 * value * slope / (2.0 * slope * slope - value * (6.0 * (b + w) - 2.0 * f))
        out[i] = w
