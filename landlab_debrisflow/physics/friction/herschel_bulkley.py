"""Herschel-Bulkley fluid in plane flow, its yield stress with a frictional part."""

import numpy as np

from ...core.jit import inner, kernel
from ...core.parameters import declared, parameter
from ..contracts import BasalState
from .shear import shearing, strength

STEPS = 2
"""Number of steps of Halley's method: the first leaves an error of 2e-5, the second only rounding."""

NO_STRESS = 1e-37
"""Negligible stress whose logarithm exists in single precision [Pa]."""


@declared
class HerschelBulkley:
    """v - v_b = h_n (w/K)^(1/n) n q (2 n + 1 - n q)/((n + 1)(2 n + 1)): a plug on a sheared layer.

    Symbols: v mean speed and v_b speed at the base [m s-1]; h_n slope-normal thickness [m]; tau_b basal shear stress,
    tau_y its yield part and tau_0, `yield_stress` [Pa]; w = tau_b - tau_y [Pa]; K, `consistency` [Pa s^n]; n,
    `flow_index` [-]; q = w/tau_b [-]; sigma' effective normal stress at the base [Pa];
    phi, `basal_friction_angle` [deg]; u(z) velocity [m s-1] at height z [m] above the bed.

    The layer has tau = tau_y + K (du/dz)^n. The equation is solved for w = tau_b - tau_y; q = w/tau_b is the sheared
    fraction of the thickness. tau_y = tau_0 + sigma' tan(phi). Pore pressure enters through sigma' only; with the
    default phi = 0 it has no effect. n = 1 is Bingham; without yield stress tau_b = K ((2 n + 1)(v - v_b)/(n h_n))^n.

    References
    ----------
    Herschel & Bulkley (1926); in plane flow Coussot (1994), Huang & Garcia (1998).
    """

    yield_stress: float = parameter("Pa", "tau_0, whatever the normal stress", 500.0, (0.0, None), varies=True)
    consistency: float = parameter(
        "Pa s^n", "stress beyond yield at a shear rate of 1 per second", 150.0, (1e-6, None), varies=True
    )
    flow_index: float = parameter(
        "-", "n: < 1 thins under shear, 1 is Bingham; about 1/3 for muds (Coussot)", 1.0 / 3.0, (0.1, 2.0), varies=True
    )
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
        n = here.flow_index
        rate *= (n + 1.0) * (2.0 * n + 1.0) / n
        np.log(rate, out=rate)
        rate *= n
        rate += np.log(here.consistency)
        stress_beyond_yield(yield_stress, rate, n, drag)
        drag /= velocity
        drag *= 1.0 - state.material.basal_slip_ratio


def stress_beyond_yield(yield_stress, log_stress, index, out) -> None:
    """Write w > 0 with w (q (2 n + 1 - n q))^n = A, q = w/(tau_y + w) [Pa].

    The logarithm of the left side is concave in log(w), its slope falls from 1 + n to 1. The start joins the roots for
    small and large w, (A tau_y^n/(2 n + 1)^n)^(1/(1 + n)) and A/(n + 1)^n, as the sum of their powers of
    1/2 + 1/n, fitted: it is within 10 % of w, and single precision is enough for it. Logarithms and exponentials are
    those of numpy, which computes several at once.

    Parameters
    ----------
    yield_stress, log_stress : ndarray, shape (n,)
        tau_y [Pa] and log(A), A in Pa.
    index : ndarray, shape (n,) or (1,)
        n [-]
    out : ndarray, shape (n,)
        Written: w [Pa].
    """
    n, log_one, log_two, log_w, log_rate = np.empty((5, out.size))
    # a number becomes an array, too, so that rounding is the same
    n[:], log_one[:], log_two[:] = index, np.log(index + 1.0), np.log(2.0 * index + 1.0)
    gap = np.log(np.maximum(yield_stress, NO_STRESS).astype(np.float32))
    _gap(log_stress, n, log_one, log_two, log_w, gap)
    tail = np.exp(-abs(gap))
    tail += np.float32(1.0)
    np.log(tail, out=tail)
    _join(n, gap, tail, log_w)
    np.exp(log_w, out=out)
    _rate(yield_stress, n, out, log_rate)
    np.log(log_rate, out=log_rate)
    _improve(yield_stress, log_stress, n, log_w, log_rate, out)


@kernel
def _gap(log_stress, index, log_one, log_two, log_large, gap):
    """Write the logarithm of the large root; turn log(tau_y) into (1/2 + 1/n) log(small root / large root), in place.

    All have shape (n,). `log_stress` is log(A), A in Pa; `index` is n [-]; `log_one` is log(n + 1), `log_two`
    log(2 n + 1). `gap` comes in as log(tau_y), tau_y in Pa.
    """
    for i in range(index.size):
        n = index[i]
        log_large[i] = log_stress[i] - n * log_one[i]
        small = (log_stress[i] + n * (gap[i] - log_two[i])) / (1.0 + n)
        gap[i] = (0.5 + 1.0 / n) * (small - log_large[i])


@kernel
def _join(index, gap, tail, log_root):
    """Turn the logarithm of the large root into that of the start, in place.

    `log_root` comes in as the logarithm of the large root [Pa]; `index` is n [-], `gap` is as `_gap` leaves it, `tail`
    is log(1 + exp(-|gap|)), all of shape (n,).
    """
    for i in range(index.size):
        log_root[i] += (max(gap[i], 0.0) + tail[i]) / (0.5 + 1.0 / index[i])


@kernel
def _rate(yield_stress, index, w, out):
    """Write q (2 n + 1 - n q) [-] into `out`, q = w/(tau_y + w); tau_y and w in Pa, `index` is n [-], each (n,)."""
    for i in range(out.size):
        q = w[i] / (yield_stress[i] + w[i])
        out[i] = q * (2.0 * index[i] + 1.0 - index[i] * q)


@kernel
def _improve(yield_stress, log_stress, index, log_start, log_rate, w):
    """Solve log(w) + n log(rate) = log(A) by Halley's method, in place; derivatives are with respect to log(w).

    All have shape (n,): tau_y [Pa], log(A), n [-], the logarithms of w at the start and of its rate, as `_rate` writes
    it, and w [Pa], which is changed. A step of 2 z is taken as w (1 + z)/(1 - z), and the logarithms follow by that of
    the ratio.
    """
    for i in range(w.size):
        n, beyond, log_w, log_r = index[i], w[i], log_start[i], log_rate[i]
        part = 1.0 / (yield_stress[i] + beyond)
        q, plug = beyond * part, yield_stress[i] * part
        below = 2.0 * n + 1.0 - n * q
        for _ in range(STEPS):
            inverse = 1.0 / below
            above = plug * (below - n * q)
            value = log_w + n * log_r - log_stress[i]
            slope = 1.0 + n * above * inverse
            bend = n * (n * above * inverse - (4.0 * n * plug + 1.0)) * inverse * q * plug
            z = -value * slope / (2.0 * slope * slope - value * bend)
            beyond *= (1.0 + z) / (1.0 - z)
            log_w += _twice_artanh(z)
            rate = q * below
            part = 1.0 / (yield_stress[i] + beyond)
            q, plug = beyond * part, yield_stress[i] * part
            below = 2.0 * n + 1.0 - n * q
            log_r += _twice_artanh((q * below - rate) / (q * below + rate))
        w[i] = beyond


@inner
def _twice_artanh(z):
    """Return log((1 + z)/(1 - z)), to rounding for |z| <= 0.05."""
    s = z * z
    return 2.0 * z * (1.0 + s * (1 / 3 + s * (1 / 5 + s * (1 / 7 + s / 9))))
