"""A plain finite-volume scheme for two phases in one dimension: reference where nothing is exact.

Solid and water on a plane, each with its volume per area and velocity (Pitman & Le, 2005; Pastor et al., 2022,
eqs. 9-11 without excess pore pressure). With h = h_s + h_w, n = h_w/h, g_n across and g_x along the plane and
r = rho_w/rho_s, per density of each phase,

    h_s,t + (h_s v_s)_x = 0                          h_w,t + (h_w v_w)_x = 0
    (h_s v_s),t + (h_s v_s^2 + (1 - r) g_n h_s h/2)_x + r g_n h_s h_x = h_s g_x + D/rho_s - F sgn v_s
    (h_w v_w),t + (h_w v_w^2)_x                       +   g_n h_w h_x = h_w g_x - D/rho_w

with friction F = (1 - r) g_n h_s tan(phi) and drag D = h C_d (v_w - v_s): C_d = n^2 rho_w g/K (Darcy), or
n (1 - n) (rho_s - rho_w) g/(V_T n^m) (Anderson & Jackson, 1967). What it can be checked by:

- Whatever the drag, one porosity and one velocity stay so without friction, and depth obeys the shallow-water
  equations: all their solutions are solutions here. With friction, very tight mixtures follow those of one phase with
  the apparent friction (rho'/rho) tan(phi).
- Where v_s = v_w the celerities are (g_n h)^(1/2) and ((1 - r) g_n h_w/2)^(1/2). All real speeds lie between
  min v - (g_n h)^(1/2) and max v + (g_n h)^(1/2); all are real if |v_w - v_s| is at most twice the slower celerity,
  or at least twice the faster one (`cases.two_phase.is_hyperbolic`; Pelanti, Bouchut & Mangeney, 2008).

Limited slopes of h_s, h_w, v_s, v_w (monotonised central: van Leer, 1977); HLL with straight paths for the products
that are no divergence (Pares, 2006; Castro & Fernandez-Nieto, 2012), which over both phases add up to one, so that
total momentum is kept. Heun's two stages that keep h_s, h_w >= 0; in each, drag exact for steady forces (Cox &
Matthews, 2002) together with friction, which never reverses. Written from the papers, for these comparisons only;
nothing is shared with the package. ``python -m validation.cases.two_phase`` prints errors and costs.
"""

import math
import time as clock
from dataclasses import dataclass

import numba
import numpy as np

from landlab_debrisflow.exact.flows import GRAVITY
from validation.rivals.finite_volume import limited

_compiled = numba.njit(cache=True, error_model="numpy")
DRY = 1e-10  # a phase thinner than this share of the greatest depth at the start has no velocity


@_compiled
def _hll(a, b, g, ratio, out):
    """Fluxes between states (h_s, h_w, v_s, v_w), and the fastest wave.

    ``out`` gets flux of solid and of water, momentum of each as the cell below sees it, and as the one above does.
    """
    out[:] = 0.0
    h, k = a[0] + a[1], b[0] + b[1]
    if h <= 0.0 and k <= 0.0:
        return 0.0
    c, d = math.sqrt(g * h), math.sqrt(g * k)
    low, high = min(a[2], a[3]), max(a[2], a[3])
    low_above, high_above = min(b[2], b[3]), max(b[2], b[3])
    if h <= 0.0:
        slow, fast = low_above - 2.0 * d, high_above + d
    elif k <= 0.0:
        slow, fast = low - c, high + 2.0 * c
    else:
        slow = min(low - c, 0.5 * (low + low_above) + c - d - 0.5 * (c + d) - 0.25 * (low - low_above))
        fast = max(high_above + d, 0.5 * (high + high_above) + c - d + 0.5 * (c + d) + 0.25 * (high - high_above))
        slow, fast = min(slow, low_above - d), max(fast, high + c)
    largest = max(abs(slow), abs(fast))
    slow, fast = min(slow, 0.0), max(fast, 0.0)
    for phase in range(2):
        one, two = a[phase] * a[2 + phase], b[phase] * b[2 + phase]
        share = 0.5 * (1.0 - ratio) * g if phase == 0 else 0.0  # of the pressure that is a divergence
        momentum = one * a[2 + phase] + share * a[0] * h
        momentum_above = two * b[2 + phase] + share * b[0] * k
        push = (ratio if phase == 0 else 1.0) * g * 0.5 * (a[phase] + b[phase]) * (k - h)
        width = fast - slow
        out[phase] = (fast * one - slow * two + slow * fast * (b[phase] - a[phase])) / width
        flux = (fast * momentum - slow * momentum_above + slow * fast * (two - one)) / width
        out[2 + phase] = flux - slow / width * push
        out[4 + phase] = flux - fast / width * push
    return largest


@_compiled
def _rates(state, rate, dx, g, pull, ratio, dry, line, slopes, faces, edge):
    """Rates of change of h_s, h_w, h_s v_s, h_w v_w without drag and friction; returns the fastest wave over dx."""
    n = state.shape[1]
    for i in range(n + 4):
        j = min(max(i - 2, 0), n - 1)  # open ends
        for phase in range(2):
            h = state[phase, j]
            line[phase, i] = h
            line[2 + phase, i] = state[2 + phase, j] / h if h > dry else 0.0
        if line[0, i] <= dry:  # an absent phase moves with the other one, so as not to widen the fan
            line[2, i] = line[3, i]
        elif line[1, i] <= dry:
            line[3, i] = line[2, i]
    for i in range(1, n + 3):
        for m in range(4):
            compared = m < 2 or min(line[m - 2, i - 1], line[m - 2, i], line[m - 2, i + 1]) > dry
            slopes[m, i] = limited(line[m, i] - line[m, i - 1], line[m, i + 1] - line[m, i]) if compared else 0.0
    fastest = 0.0
    for i in range(1, n + 2):
        for m in range(4):
            edge[0, m] = line[m, i] + 0.5 * slopes[m, i]
            edge[1, m] = line[m, i + 1] - 0.5 * slopes[m, i + 1]
        fastest = max(fastest, _hll(edge[0], edge[1], g, ratio, faces[i]))
    for j in range(n):
        i = j + 2
        steepness = g * (slopes[0, i] + slopes[1, i])
        for phase in range(2):
            rate[phase, j] = (faces[i - 1, phase] - faces[i, phase]) / dx
            inside = (ratio if phase == 0 else 1.0) * steepness * line[phase, i]
            change = faces[i - 1, 4 + phase] - faces[i, 2 + phase] - inside
            rate[2 + phase, j] = change / dx + pull * line[phase, i]
    return fastest / dx


@_compiled
def _dragged(v, w, slip, decay, gain, share):
    """Velocities v of solid and w of water after drag over a step that alone took them from ``slip`` to w - v.

    ``share`` is that of the water in the mass: drag leaves the momentum of both as it is.
    """
    slip = decay * slip + gain * (w - v - slip)
    v = v + share * (w - v - slip)
    return v, v + slip


@_compiled
def _stage(old, middle, first, second, new, dt, brake, density, drag, dry):
    """Heun's ``new = old + dt (first + second)/2``, rates at ``old`` and ``middle``; then drag and friction over dt."""
    coefficient, power, power_solid = drag
    for i in range(old.shape[1]):
        h = max(0.0, old[0, i] + 0.5 * dt * (first[0, i] + second[0, i]))  # takes rounding only: the step is limited
        k = max(0.0, old[1, i] + 0.5 * dt * (first[1, i] + second[1, i]))
        v = (old[2, i] + 0.5 * dt * (first[2, i] + second[2, i])) / h if h > dry else 0.0
        w = (old[3, i] + 0.5 * dt * (first[3, i] + second[3, i])) / k if k > dry else 0.0
        # on the solid that gravity has pulled at: a front that grows would lag if it were braked on what it becomes
        hold = 0.5 * dt * brake * (old[0, i] + middle[0, i]) / h if h > dry else 0.0
        if h > dry and k > dry:
            before, water = v, w
            if old[0, i] > dry and old[1, i] > dry:
                before, water = old[2, i] / old[0, i], old[3, i] / old[1, i]
            solid_mean, water_mean = 0.5 * (old[0, i] + h), 0.5 * (old[1, i] + k)
            depth = solid_mean + water_mean
            force = depth * coefficient * (water_mean / depth) ** power * (solid_mean / depth) ** power_solid
            on_water = dt * force / (density[1] * water_mean)
            z = dt * force / (density[0] * solid_mean) + on_water
            decay, gain = math.exp(-z), (-math.expm1(-z) / z if z > 0.0 else 1.0)
            share = density[1] * k / (density[0] * h + density[1] * k)
            free, water_free = _dragged(v, w, water - before, decay, gain, share)
            if hold > 0.0:
                braked, water_braked = _dragged(v - math.copysign(hold, free), w, water - before, decay, gain, share)
                if free * braked > 0.0:
                    free, water_free = braked, water_braked
                else:  # the bed holds the solid; water seeps through it
                    gain = -math.expm1(-on_water) / on_water if on_water > 0.0 else 1.0
                    free, water_free = 0.0, math.exp(-on_water) * water + gain * (w - water)
            v, w = free, water_free
        elif hold > 0.0:
            v = math.copysign(max(0.0, abs(v) - hold), v)
        new[0, i], new[1, i], new[2, i], new[3, i] = h, k, h * v, k * w


@_compiled
def _run(state, dx, duration, g, pull, brake, density, drag, courant, dry):
    """Advance ``state`` in place; returns the number of steps."""
    first, second, middle = np.empty_like(state), np.empty_like(state), np.empty_like(state)
    size, ratio = state.shape[1] + 4, density[1] / density[0]
    line, slopes, faces, edge = np.empty((4, size)), np.empty((4, size)), np.empty((size, 6)), np.empty((2, 4))
    elapsed, steps = 0.0, 0
    while elapsed < duration:
        rate = _rates(state, first, dx, g, pull, ratio, dry, line, slopes, faces, edge)
        dt = duration - elapsed
        if dt * rate > courant:
            dt = courant / rate
        while True:
            _stage(state, state, first, first, middle, dt, brake, density, drag, dry)
            rate = _rates(middle, second, dx, g, pull, ratio, dry, line, slopes, faces, edge)
            if not dt * rate > 0.5:
                break
            dt *= 0.5  # beyond half a cell a depth could become negative
        _stage(state, middle, first, second, state, dt, brake, density, drag, dry)
        elapsed = elapsed + dt if dt < duration - elapsed else duration
        steps += 1
    return steps


@dataclass(frozen=True)
class Mixture:
    """Material of a flow: densities [kg/m3], friction angle of the solid [rad] and drag.

    Parameters
    ----------
    drag : {"none", "darcy", "anderson_jackson"}
    conductivity : float
        Hydraulic, K of Darcy's law [m/s].
    terminal_velocity, exponent : float
        V_T [m/s] and m [-] of Anderson & Jackson (1967).
    """

    drag: str = "none"
    conductivity: float = 1e-3
    terminal_velocity: float = 1.0
    exponent: float = 1.0
    friction_angle: float = 0.0
    solid_density: float = 2650.0
    water_density: float = 1000.0

    def law(self) -> tuple[float, float, float]:
        """c, p, q of ``C_d = c n^p (1 - n)^q`` [Pa s/m2, -, -]."""
        if self.drag == "none":
            return 0.0, 0.0, 0.0
        if self.drag == "darcy":
            return self.water_density * GRAVITY / self.conductivity, 2.0, 0.0
        if self.drag == "anderson_jackson":
            buoyant = (self.solid_density - self.water_density) * GRAVITY
            return buoyant / self.terminal_velocity, 1.0 - self.exponent, 1.0
        raise ValueError(f"drag is to be none, darcy or anderson_jackson, not {self.drag!r}")

    def relaxation_rate(self, porosity) -> np.ndarray:
        """Of v_w - v_s in a uniform mixture, ``h C_d (1/(rho_s h_s) + 1/(rho_w h_w))`` [1/s]."""
        n, (c, p, q) = np.asarray(porosity, dtype=float), self.law()
        return c * n**p * (1.0 - n) ** q * (1.0 / (self.solid_density * (1.0 - n)) + 1.0 / (self.water_density * n))

    def apparent_friction(self, porosity: float) -> float:
        """``(rho'/rho) tan(phi)``, of a very tight mixture [-]."""
        solid = (1.0 - porosity) * self.solid_density
        buoyant = solid - (1.0 - porosity) * self.water_density
        return buoyant / (solid + porosity * self.water_density) * math.tan(self.friction_angle)


NO_DRAG = Mixture()


@dataclass(frozen=True)
class TwoPhaseResult:
    """State at each time: arrays of (times, cells) [m, m, m/s, m/s]; centres [m], steps, CPU time of the loop [s]."""

    x: np.ndarray
    h_s: np.ndarray
    h_w: np.ndarray
    v_s: np.ndarray
    v_w: np.ndarray
    steps: int
    cpu: float


def solve(x, h_s, h_w, v_s, v_w, times, mixture: Mixture = NO_DRAG, slope: float = 0.0,
          courant: float = 0.45) -> TwoPhaseResult:  # fmt: skip
    """Two phases down a plane from time 0, through open ends.

    Parameters
    ----------
    x : array_like
        Centres of cells of one size, down the plane [m].
    h_s, h_w, v_s, v_w : array_like
        Volume of solid and water per area of the plane [m], and velocities [m/s], at the start.
    times : array_like
        When to record, ascending [s].
    slope : float
        Of the plane, down x [rad].
    courant : float
        Fastest wave times step over size of cells; 0.5 at most, where depths stay positive.
    """
    x, times = np.asarray(x, dtype=float), np.atleast_1d(np.asarray(times, dtype=float))
    h_s, h_w, v_s, v_w = (np.broadcast_to(np.asarray(a, dtype=float), x.shape) for a in (h_s, h_w, v_s, v_w))
    state = np.array([h_s, h_w, h_s * v_s, h_w * v_w])
    if x.ndim != 1 or x.size < 2 or not np.isfinite(state).all() or (state[:2] < 0.0).any():
        raise ValueError("h_s, h_w >= 0, v_s and v_w are to be finite and along a line x of two cells at least")
    if not 0.0 < courant <= 0.5 or (np.diff(times, prepend=0.0) < 0.0).any():
        raise ValueError("courant is to be in (0, 0.5], times are to ascend from 0")
    density, dry = (mixture.solid_density, mixture.water_density), DRY * float(state[:2].sum(axis=0).max())
    normal = GRAVITY * math.cos(slope)
    brake = (1.0 - density[1] / density[0]) * normal * math.tan(mixture.friction_angle)
    found, steps, begin = np.zeros((times.size, *state.shape)), 0, clock.process_time()
    for k, duration in enumerate(np.diff(times, prepend=0.0)):
        steps += _run(state, x[1] - x[0], duration, normal, GRAVITY * math.sin(slope), brake, density, mixture.law(),
                      float(courant), dry)  # fmt: skip
        found[k] = state
    cpu = clock.process_time() - begin
    h, q = found[:, :2], found[:, 2:]
    v = np.divide(q, h, out=np.zeros_like(q), where=h > dry)
    return TwoPhaseResult(x, h[:, 0], h[:, 1], v[:, 0], v[:, 1], steps, cpu)
