"""A plain finite-volume scheme of second order: rival of the particles, and reference where nothing is exact.

Depth-averaged flow on a plane (slope-normal form, gravity along it as an acceleration) or over a bed:

    h_t  + (h u)_x + (h v)_y = 0
    hu_t + (h u^2 + g_n h^2/2)_x + (h u v)_y = h g_x - g_n h z_x - (mu g_n h + g v^2/xi) u/|u|        and so for hv

Limited slopes of h, h + z, u and v (monotonised central: van Leer, 1977); hydrostatic reconstruction of the bed
(Audusse et al., 2004), so that a lake stays level; HLL flux with Einfeldt's speeds and the dry-front speeds of Toro
(2001), transverse momentum carried by the mass flux (HLLC); Heun's two stages (SSP, Shu & Osher, 1988) of one step
that keeps h >= 0; friction implicit, never reversing. Written from the papers, for these comparisons only; nothing is
shared with the package. ``python -m validation.cases.dam_breaks`` prints errors and costs.
"""

import math
import time as clock
from dataclasses import dataclass

import numba
import numpy as np

from landlab_debrisflow.exact.flows import GRAVITY

_compiled = numba.njit(cache=True, error_model="numpy")
DRY = 1e-10  # cells thinner than this share of the greatest depth at the start have no velocity


@_compiled
def limited(below, above):
    """Monotonised central slope of two differences: 0 at an extremum, never beyond a neighbour."""
    if below * above <= 0.0:
        return 0.0
    size = min(2.0 * abs(below), 2.0 * abs(above), 0.5 * abs(below + above))
    return math.copysign(size, below)


@_compiled
def _hll(h, u, k, w, g):
    """Flux of mass and of momentum between (h, u) and (k, w), and the fastest wave [m2/s, m3/s2, m/s]."""
    if h <= 0.0 and k <= 0.0:
        return 0.0, 0.0, 0.0
    a, b = math.sqrt(g * h), math.sqrt(g * k)
    if h <= 0.0:
        slow, fast = w - 2.0 * b, w + b
    elif k <= 0.0:
        slow, fast = u - a, u + 2.0 * a
    else:
        between, celerity = 0.5 * (u + w) + a - b, 0.5 * (a + b) + 0.25 * (u - w)
        slow, fast = min(u - a, between - celerity), max(w + b, between + celerity)
    mass, other, momentum = h * u, k * w, h * u * u + 0.5 * g * h * h
    largest = max(abs(slow), abs(fast))
    if slow >= 0.0:
        return mass, momentum, largest
    momentum_other = k * w * w + 0.5 * g * k * k
    if fast <= 0.0:
        return other, momentum_other, largest
    # from the side that moves in, so that a cell gives no more than it has
    return (
        (fast * mass - slow * other + slow * fast * (k - h)) / (fast - slow),
        (fast * momentum - slow * momentum_other + slow * fast * (other - mass)) / (fast - slow),
        largest,
    )


@_compiled
def _line(line, slopes, out, n, dx, g, pull, mu, dry):
    """Fluxes along a line of ``n`` cells between two ghosts at each end; returns the fastest wave.

    ``line`` holds h, u (along), v (across), z and h + z. ``out`` gets, for the face above each cell, the flux of
    mass, of momentum for the cell below and for the one above, of transverse momentum; and the push of the bed.
    """
    h, u, v, level = line[0], line[1], line[2], line[4]
    for i in range(1, n + 3):
        slopes[0, i] = limited(h[i] - h[i - 1], h[i + 1] - h[i])
        slopes[3, i] = limited(level[i] - level[i - 1], level[i + 1] - level[i])
        slopes[1, i] = slopes[2, i] = 0.0
        if min(h[i - 1], h[i], h[i + 1]) > dry:  # a dry cell has no velocity to compare with
            slopes[1, i] = limited(u[i] - u[i - 1], u[i + 1] - u[i])
            slopes[2, i] = limited(v[i] - v[i - 1], v[i + 1] - v[i])
        # z at the edges is h + z less h; its difference pushes on the mean depth of the edges, h[i]
        out[4, i] = g * h[i] * (slopes[0, i] - slopes[3, i])
    fastest = 0.0
    for i in range(1, n + 2):
        j = i + 1
        one, two = h[i] + 0.5 * slopes[0, i], h[j] - 0.5 * slopes[0, j]
        level_one, level_two = level[i] + 0.5 * slopes[3, i], level[j] - 0.5 * slopes[3, j]
        sill = max(level_one - one, level_two - two)
        low, high = min(one, max(0.0, level_one - sill)), min(two, max(0.0, level_two - sill))
        u_one, u_two = u[i] + 0.5 * slopes[1, i], u[j] - 0.5 * slopes[1, j]
        mass, momentum, speed = _hll(low, u_one, high, u_two, g)
        still = u[i] == 0.0 and u[j] == 0.0 and v[i] == 0.0 and v[j] == 0.0
        if still and abs(pull * dx - g * (level[j] - level[i])) <= mu * g * dx:
            mass = 0.0  # friction holds both: no creep by the diffusion of the flux
        out[0, i] = mass
        out[1, i] = momentum + 0.5 * g * (one * one - low * low)
        out[2, i] = momentum + 0.5 * g * (two * two - high * high)
        out[3, i] = mass * (v[i] + 0.5 * slopes[2, i] if mass > 0.0 else v[j] - 0.5 * slopes[2, j])
        fastest = max(fastest, speed)
    return fastest


@_compiled
def _rates(state, z, rate, spacing, g, pull, mu, dry, wall, radial, line, slopes, out):
    """Rates of change of h, hu, hv without friction; returns 1/s: fastest wave over spacing, summed over directions."""
    rows, columns = z.shape
    total = 0.0
    for direction in range(2):
        n, lines = (columns, rows) if direction == 0 else (rows, columns)
        if n == 1:
            continue
        fastest, along = 0.0, direction + 1
        for k in range(lines):
            for i in range(n):
                r, c = (k, i) if direction == 0 else (i, k)
                depth = state[0, r, c]
                wet = depth > dry
                line[0, i + 2], line[3, i + 2] = depth, z[r, c]
                line[1, i + 2] = state[along, r, c] / depth if wet else 0.0
                line[2, i + 2] = state[3 - along, r, c] / depth if wet else 0.0
            for m in range(4):
                sign = -1.0 if wall and m == 1 else 1.0
                for ghost in range(2):
                    line[m, 1 - ghost] = sign * line[m, 2 + ghost if wall else 2]
                    line[m, n + 2 + ghost] = sign * line[m, n + 1 - ghost if wall else n + 1]
            for i in range(n + 4):
                line[4, i] = line[0, i] + line[3, i]
            fastest = max(fastest, _line(line, slopes, out, n, spacing, g, pull[direction], mu, dry))
            for i in range(n):
                r, c = (k, i) if direction == 0 else (i, k)
                below, above, push = 1.0 / spacing, 1.0 / spacing, out[4, i + 2] / spacing
                if radial:  # faces at i and i + 1 spacings from the axis; pressure on the sides of the sector
                    below, above = below * i / (i + 0.5), above * (i + 1.0) / (i + 0.5)
                    push += 0.5 * g * line[0, i + 2] ** 2 / ((i + 0.5) * spacing)
                if direction == 0:
                    for m in range(3):
                        rate[m, r, c] = 0.0 if m == 0 else pull[m - 1] * line[0, i + 2]
                rate[0, r, c] += below * out[0, i + 1] - above * out[0, i + 2]
                rate[along, r, c] += below * out[2, i + 1] - above * out[1, i + 2] + push
                rate[3 - along, r, c] += below * out[3, i + 1] - above * out[3, i + 2]
        total += fastest / spacing
    return total


@_compiled
def _stage(old, middle, first, second, new, dt, g, mu, turbulence, dry):
    """Heun's ``new = old + dt (first + second)/2``, rates at ``old`` and ``middle``; then friction over ``dt``."""
    _, rows, columns = old.shape
    for r in range(rows):
        for c in range(columns):
            h = old[0, r, c] + 0.5 * dt * (first[0, r, c] + second[0, r, c])
            x = old[1, r, c] + 0.5 * dt * (first[1, r, c] + second[1, r, c])
            y = old[2, r, c] + 0.5 * dt * (first[2, r, c] + second[2, r, c])
            h = max(0.0, h)  # takes rounding only, as the step is limited
            size = math.hypot(x, y)
            # on the depth that gravity has pulled at: a front that grows would lag if it were braked on what it becomes
            hold = 0.5 * dt * mu * g * (old[0, r, c] + middle[0, r, c])
            if h <= dry or size <= hold:
                x = y = 0.0
            elif mu > 0.0 or turbulence < np.inf:
                # against the mean direction over the step, or the new one where the flow has turned back
                before = old[0, r, c]
                a, b = (old[1, r, c] / before, old[2, r, c] / before) if before > dry else (0.0, 0.0)
                if a * x + b * y < 0.0:
                    a = b = 0.0
                a, b = a + x / h, b + y / h
                share = hold / math.hypot(a, b)
                x, y = x - share * a, y - share * b
                # w + k w^2 = w*, which keeps the steady speed exact
                brake = 0.5 + math.sqrt(0.25 + dt * GRAVITY / turbulence * math.hypot(x, y) / (h * h))
                x, y = x / brake, y / brake
            new[0, r, c], new[1, r, c], new[2, r, c] = h, x, y


@_compiled
def _run(state, z, spacing, duration, g, pull, mu, turbulence, courant, wall, radial, dry):
    """Advance ``state`` in place; returns the number of steps."""
    first, second, middle = np.empty_like(state), np.empty_like(state), np.empty_like(state)
    size = max(z.shape) + 4
    line, slopes, out = np.empty((5, size)), np.empty((4, size)), np.empty((5, size))
    elapsed, steps = 0.0, 0
    while elapsed < duration:
        rate = _rates(state, z, first, spacing, g, pull, mu, dry, wall, radial, line, slopes, out)
        dt = duration - elapsed
        if dt * rate > courant:
            dt = courant / rate
        while True:
            _stage(state, state, first, first, middle, dt, g, mu, turbulence, dry)
            rate = _rates(middle, z, second, spacing, g, pull, mu, dry, wall, radial, line, slopes, out)
            if not dt * rate > 0.5:
                break
            dt *= 0.5  # beyond half a cell a depth could become negative
        _stage(state, middle, first, second, state, dt, g, mu, turbulence, dry)
        elapsed = elapsed + dt if dt < duration - elapsed else duration
        steps += 1
    return steps


@dataclass(frozen=True)
class FVResult:
    """State at the end, number of steps, and CPU time of the time loop [s]."""

    h: np.ndarray
    hu: np.ndarray
    hv: np.ndarray
    steps: int
    cpu: float


def solve(h, hu, hv, spacing: float, time: float, gravity_normal: float = GRAVITY, gravity_along=(0.0, 0.0),
          friction: float = 0.0, bed=None, courant: float = 0.45, boundaries: str = "open",
          turbulence: float = np.inf, radial: bool = False) -> FVResult:  # fmt: skip
    """Depth-averaged flow over ``time`` seconds.

    Parameters
    ----------
    h, hu, hv : array_like
        Depth [m] and momentum [m2/s] in square cells, one row (or 1-D) for flow in one dimension, y up the rows.
    spacing : float
        Size of a cell [m].
    gravity_normal : float
        Acceleration that presses on the bed [m/s2]: ``g cos(slope)`` in slope-normal form.
    gravity_along : tuple of float
        Constant acceleration along x and y [m/s2]: ``(g sin(slope), 0)`` down a plane.
    friction : float
        Apparent friction coefficient [-] (Coulomb).
    bed : array_like, optional
        Bed elevation [m].
    courant : float
        Fastest wave times step over spacing, summed over directions; 0.5 at most, where depths stay positive.
    boundaries : {"open", "wall"}
        All sides alike.
    turbulence : float
        ``xi`` of Voellmy (1955) [m/s2]; infinite: none.
    radial : bool
        One row is a radius from 0, ``hu`` the radial momentum; on a flat bed.
    """
    state = np.array([np.atleast_2d(np.asarray(a, dtype=float)) for a in (h, hu, hv)])
    z = np.zeros(state.shape[1:]) if bed is None else np.atleast_2d(np.array(bed, dtype=float))
    if z.shape != state.shape[1:] or not np.isfinite(state).all() or not np.isfinite(z).all() or (state[0] < 0.0).any():
        raise ValueError("h >= 0, hu, hv and bed are to be finite and of one shape")
    if not 0.0 < courant <= 0.5 or boundaries not in ("open", "wall") or (radial and (bed is not None or len(z) > 1)):
        raise ValueError("courant is to be in (0, 0.5], boundaries open or wall, and radial one row without a bed")
    pull, dry = (float(gravity_along[0]), float(gravity_along[1])), DRY * float(state[0].max())
    begin = clock.process_time()
    steps = _run(state, z, float(spacing), float(time), float(gravity_normal), pull, float(friction),
                 float(turbulence), float(courant), boundaries == "wall", radial, dry)  # fmt: skip
    cpu = clock.process_time() - begin
    shape = np.shape(h)
    return FVResult(*(a.reshape(shape) for a in state), steps, cpu)
