"""Exact solutions of depth-averaged flow, to judge every scheme with.

Slope-normal form: ``h`` is the thickness across the plane [m], ``x`` points down it [m], ``u`` and ``v`` are
depth-averaged along ``x`` and ``y`` [m/s]. Angles are in radians, ``slope`` is that of the plane; a friction
coefficient ``friction`` is the apparent one, ``(rho'/rho) (1 - r) tan(phi)``, which is ``tan(delta)`` where dry.
A dam stands at ``x = 0`` with its reservoir at ``x < 0``; caps start centred at the origin, at rest. All functions
of position broadcast ``x`` and ``y`` and return ``h, u`` in one dimension and ``h, u, v`` in two. Velocities are 0
where nothing flows. A circular dam break has no exact solution: see `validation.cases.dam_breaks.circular_dam_break`.
"""

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

GRAVITY = 9.81
START = 1e-200  # a time so short that a dam break is still the step it starts from [s]


def _masked(h, *velocity):
    """Thickness with its dry parts cut off, and velocities that are 0 there."""
    wet = h > 0.0
    return (np.where(wet, h, 0.0), *(np.where(wet, value, 0.0) for value in velocity))


# Dam breaks -----------------------------------------------------------------------------------------------------------


def ritter(x, time: float, depth: float = 1.0, gravity: float = GRAVITY):
    """Dam break on a dry flat bed without friction (Ritter, 1892)."""
    return mangeney(x, time, depth, 0.0, 0.0, gravity)


def mangeney(x, time: float, depth: float = 1.0, slope: float = 0.0, friction: float = 0.0, gravity: float = GRAVITY):
    """Dam break on a dry plane with Coulomb friction below its slope (Mangeney, Heinrich & Roche, 2000).

    Ritter's solution in a frame that falls with ``m = g cos(slope) (tan(slope) - friction)``: the reservoir as a
    whole moves at ``m t``, the front is at ``2 c0 t + m t^2/2`` and the rarefaction starts at ``-c0 t + m t^2/2``.
    """
    normal, pull = _plane(slope, friction, gravity)
    if pull < 0.0:
        raise ValueError("friction holds the reservoir: no solution of this form")
    celerity, x, time = np.sqrt(normal * depth), np.asarray(x, dtype=float), max(time, START)
    place = (x - 0.5 * pull * time**2) / time  # in the falling frame, over time
    wave = np.clip((2.0 * celerity - place) / 3.0, 0.0, celerity)
    return _masked(wave**2 / normal, 2.0 * (celerity - wave) + pull * time)


def mangeney_front(time, depth: float = 1.0, slope: float = 0.0, friction: float = 0.0, gravity: float = GRAVITY):
    """Position of the front of `mangeney` [m]."""
    normal, pull = _plane(slope, friction, gravity)
    return 2.0 * np.sqrt(normal * depth) * time + 0.5 * pull * time**2


def _plane(slope, friction, gravity):
    """Gravity across a plane, and along it less the friction of what slides down."""
    return gravity * np.cos(slope), gravity * (np.sin(slope) - friction * np.cos(slope))


def stoker_states(depth: float = 1.0, depth_ahead: float = 0.1, gravity: float = GRAVITY):
    """Depth and velocity between rarefaction and shock of `stoker`, and speed of the shock [m, m/s, m/s]."""

    def behind_shock(h):
        return (h - depth_ahead) * np.sqrt(0.5 * gravity * (h + depth_ahead) / (h * depth_ahead))

    def behind_rarefaction(h):
        return 2.0 * (np.sqrt(gravity * depth) - np.sqrt(gravity * h))

    middle = brentq(lambda h: behind_shock(h) - behind_rarefaction(h), depth_ahead, depth, xtol=1e-15, rtol=1e-14)
    velocity = behind_rarefaction(middle)
    return middle, velocity, middle * velocity / (middle - depth_ahead)


def stoker(x, time: float, depth: float = 1.0, depth_ahead: float = 0.1, gravity: float = GRAVITY):
    """Dam break on a wet flat bed without friction (Stoker, 1957, section 10.8), ``0 < depth_ahead < depth``."""
    middle, _, shock = stoker_states(depth, depth_ahead, gravity)
    celerity, x, time = np.sqrt(gravity * depth), np.asarray(x, dtype=float), max(time, START)
    wave = np.clip((2.0 * celerity - x / time) / 3.0, np.sqrt(gravity * middle), celerity)
    ahead = x > shock * time
    return np.where(ahead, depth_ahead, wave**2 / gravity), np.where(ahead, 0.0, 2.0 * (celerity - wave))


# Caps on a plane ------------------------------------------------------------------------------------------------------


def ridge_half_width(time: float, half_width: float = 10.0, depth: float = 1.0, slope: float = 0.0,
                     gravity: float = GRAVITY) -> tuple[float, float]:  # fmt: skip
    """Half width of a parabolic ridge and its rate [m, m/s]: ``l'' = 3/2 g cos(slope) V/l^2``, ``V = 4/3 h0 l0``.

    Its first integral is ``l'^2 = 3 g' V (1/l0 - 1/l)`` and its second, with ``s = l/l0``,
    ``t (3 g' V/l0^3)^(1/2) = (s (s - 1))^(1/2) + arcosh(s^(1/2))``.
    """
    rate = 2.0 * np.sqrt(gravity * np.cos(slope) * depth) / half_width  # (3 g' V / l0^3)^(1/2)

    def lateness(s):
        return np.sqrt(s * (s - 1.0)) + np.arccosh(np.sqrt(s)) - rate * time

    stretch = brentq(lateness, 1.0, 2.0 + rate * time, xtol=1e-14, rtol=1e-14)
    return half_width * stretch, half_width * rate * np.sqrt(1.0 - 1.0 / stretch)


def ridge(x, time: float, half_width: float = 10.0, depth: float = 1.0, slope: float = 0.0, friction: float = 0.0,
          gravity: float = GRAVITY):  # fmt: skip
    """Parabolic ridge that spreads in one dimension while it slides (Savage & Hutter, 1989).

    Pressure coefficient 1. Whatever the friction, as long as all of it moves down: without friction, or with
    ``tan(slope) - friction > 2 h0/l0``.
    """
    pull = _plane(slope, friction, gravity)[1]
    if friction > 0.0 and np.tan(slope) - friction <= 2.0 * depth / half_width:
        raise ValueError("the rear end would move up the slope, where friction changes its sign")
    width, rate = ridge_half_width(time, half_width, depth, slope, gravity)
    place = (np.asarray(x, dtype=float) - 0.5 * pull * time**2) / width
    return _masked(depth * half_width / width * (1.0 - place**2), pull * time + place * rate)


def cap_radius(time, radius: float = 10.0, depth: float = 1.0, slope: float = 0.0, gravity: float = GRAVITY):
    """Radius of `cap` [m]: ``R^2 = R0^2 + 2 g cos(slope) h0 t^2``."""
    return np.sqrt(radius**2 + 2.0 * gravity * np.cos(slope) * depth * np.asarray(time, dtype=float) ** 2)


def cap(x, y, time: float, radius: float = 10.0, depth: float = 1.0, slope: float = 0.0, gravity: float = GRAVITY):
    """Circular parabolic cap that spreads while it slides, without friction.

    The equations on a plane are those on a flat bed in a frame that falls with ``g sin(slope)``; there it is the
    limit of no basin of the curved free surface of Thacker (1981).
    """
    wide, pull = cap_radius(time, radius, depth, slope, gravity), gravity * np.sin(slope)
    x, y = np.asarray(x, dtype=float) - 0.5 * pull * time**2, np.asarray(y, dtype=float)
    rate = 2.0 * gravity * np.cos(slope) * depth * time / wide**2  # R'/R
    h = depth * (radius / wide) ** 2 * (1.0 - (x**2 + y**2) / wide**2)
    return _masked(h, pull * time + rate * x, rate * y)


def similarity_scales(time: float, length: float = 80.0, height: float = 4.0, slope: float = np.radians(35.0),
                      friction: float = np.tan(np.radians(25.0)), gravity: float = GRAVITY):  # fmt: skip
    """Lengths along and across the slope over the first one, and their rates: ``g, f, dg/dt, df/dt`` [-, -, 1/s, 1/s].

    ``g'' = 2 B/(g^2 f)`` and ``f'' = 2 B/(g f^2) - C f'/((A - C) tau)`` with ``tau = t (gravity/length)^(1/2)``,
    ``A = sin(slope)``, ``B = cos(slope) height/length``, ``C = cos(slope) friction``; ``g = f = 1`` and at rest at 0.
    """
    pull, spread, hold = np.sin(slope), np.cos(slope) * height / length, np.cos(slope) * friction
    second = np.array([2.0 * spread, 2.0 * spread * (pull - hold) / pull])  # g'' and f'' at 0, where f'/tau -> f''
    begin, end = 1e-3, time * np.sqrt(gravity / length)  # the parabola is right to begin^4: 1e-14

    def rates(tau, state):
        g, f, dg, df = state
        return dg, df, 2.0 * spread / (g**2 * f), 2.0 * spread / (g * f**2) - hold * df / ((pull - hold) * tau)

    start = np.append(1.0 + 0.5 * second * min(begin, end) ** 2, second * min(begin, end))
    if end > begin:
        start = solve_ivp(rates, (begin, end), start, "DOP853", rtol=1e-12, atol=1e-14).y[:, -1]
    return start * np.array([1.0, 1.0, *2 * [np.sqrt(gravity / length)]])


def similarity(x, y, time: float, length: float = 80.0, height: float = 4.0, slope: float = np.radians(35.0),
               friction: float = np.tan(np.radians(25.0)), gravity: float = GRAVITY):  # fmt: skip
    """Parabolic cap with Coulomb friction in two dimensions (Hutter, Siegel, Savage & Nohguchi, 1993).

    Exact for friction linearised about the motion of the centre, ``-friction g cos(slope) (1, v/u_c)``; against full
    Coulomb friction it is off by some 1 % at 5 s.
    """
    g, f, dg, df = similarity_scales(time, length, height, slope, friction, gravity)
    pull = _plane(slope, friction, gravity)[1]
    x, y = np.asarray(x, dtype=float) - 0.5 * pull * time**2, np.asarray(y, dtype=float)
    h = height / (f * g) * (1.0 - (x / (length * g)) ** 2 - (y / (length * f)) ** 2)
    return _masked(h, pull * time + x * dg / g, y * df / f)


# A basin --------------------------------------------------------------------------------------------------------------


def basin(x, y=0.0, radius: float = 10.0, depth: float = 1.0):
    """Bed of Thacker's paraboloid [m], 0 on the circle ``radius``, ``-depth`` in the middle."""
    return depth * ((np.asarray(x, dtype=float) ** 2 + np.asarray(y, dtype=float) ** 2) / radius**2 - 1.0)


def thacker_planar(x, y, time: float, radius: float = 10.0, depth: float = 1.0, orbit=(5.0, 5.0),
                   gravity: float = GRAVITY):  # fmt: skip
    """Flat surface that swings in a paraboloid (Thacker, 1981).

    A cap of constant shape whose centre moves on ``(a cos(w t), b sin(w t))``, any orbit of the oscillator
    ``w = (2 g h0)^(1/2)/radius``: equal ``orbit = (a, b)`` is Thacker's circle, ``b = 0`` a start from rest, to and
    fro along ``x``, which with ``y = 0`` is also the solution in one dimension.
    """
    frequency = np.sqrt(2.0 * gravity * depth) / radius
    cos, sin = np.cos(frequency * time), np.sin(frequency * time)
    x, y = np.asarray(x, dtype=float) - orbit[0] * cos, np.asarray(y, dtype=float) - orbit[1] * sin
    return _masked(-basin(x, y, radius, depth), -orbit[0] * frequency * sin, orbit[1] * frequency * cos)


def thacker_curved(x, y, time: float, radius: float = 10.0, depth: float = 1.0, first_radius: float = 8.0,
                   gravity: float = GRAVITY):  # fmt: skip
    """Circular cap that breathes in a paraboloid, from rest with its edge at ``first_radius`` (Thacker, 1981).

    ``A = (a^4 - r0^4)/(a^4 + r0^4)``; with squares, as it is often printed, the edge would start at ``(a r0)^(1/2)``.
    """
    frequency = np.sqrt(8.0 * gravity * depth) / radius
    swing = (radius**4 - first_radius**4) / (radius**4 + first_radius**4)
    root, squeeze = np.sqrt(1.0 - swing**2), 1.0 - swing * np.cos(frequency * time)
    x, y = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
    h = depth * (root / squeeze - (x**2 + y**2) / radius**2 * (root / squeeze) ** 2)
    rate = 0.5 * frequency * swing * np.sin(frequency * time) / squeeze
    return _masked(h, rate * x, rate * y)


# Blocks and slabs -----------------------------------------------------------------------------------------------------


def sliding_block(time, slope: float, friction: float, speed: float = 0.0, gravity: float = GRAVITY):
    """Velocity and travel of a block or endless slab [m/s, m] that starts at ``speed`` >= 0 (Coulomb).

    Held at rest where friction is not overcome; one that is braked stops at
    ``speed/(gravity (friction cos(slope) - sin(slope)))`` and stays.
    """
    pull, time = _plane(slope, friction, gravity)[1], np.asarray(time, dtype=float)
    if pull < 0.0:
        time = np.minimum(time, -speed / pull)
    return speed + pull * time, speed * time + 0.5 * pull * time**2


def eroding_block(time, slope: float, friction: float, growth: float, slip: float = 0.0, gravity: float = GRAVITY):
    """Block from rest that entrains ``growth h v`` (McDougall & Hungr, 2005): velocity, travel, thickness ratio.

    ``dv/dt = a - growth (1 - slip) v^2``; eroded soil enters with ``slip`` times the velocity of the block.
    """
    pull, drag = max(0.0, _plane(slope, friction, gravity)[1]), growth * (1.0 - slip)
    rate, time = np.sqrt(pull * drag), np.asarray(time, dtype=float)
    if rate == 0.0:
        velocity, travel = pull * time, 0.5 * pull * time**2
    else:
        velocity, travel = np.sqrt(pull / drag) * np.tanh(rate * time), np.log(np.cosh(rate * time)) / drag
    return velocity, travel, np.exp(growth * travel)


def consolidating_ratio(time, consolidation_time: float, start: str | float = "linear", terms: int = 2000):
    """Basal pore pressure of a closed column over that at the start [-] (Terzaghi, 1943).

    Parameters
    ----------
    time : array_like
        [s].
    consolidation_time : float
        ``h^2/c_v`` [s].
    start : {"linear"} or float
        Pressure that falls linearly from base to surface, or a uniform one in a basal layer of this share of the
        thickness (1: the whole).
    """
    weight, rate = _consolidation(consolidation_time, start, terms)
    return np.exp(-np.multiply.outer(np.asarray(time, dtype=float), rate)) @ weight


def _consolidation(consolidation_time, start, terms):
    """Weights and rates [1/s] of the decaying parts of the basal pressure."""
    wave = (np.arange(terms) + 0.5) * np.pi
    weight = 2.0 / wave**2 if start == "linear" else 2.0 * np.sin(wave * float(start)) / wave
    return weight, wave**2 / consolidation_time


def consolidating_block(time, slope: float, friction: float, ratio: float, consolidation_time: float,
                        start: str | float = "linear", gravity: float = GRAVITY):  # fmt: skip
    """Block from rest on its own pore pressure, which drains at the surface (Hutchinson, 1986): velocity and travel.

    ``dv/dt = g (sin(slope) - friction (1 - ratio r(t)) cos(slope))`` with ``friction = (rho'/rho) tan(phi)`` and
    ``r`` of `consolidating_ratio`. Friction only grows, so it stops once and for good.
    """
    weight, rate = _consolidation(consolidation_time, start, 2000)
    normal, pull = _plane(slope, friction, gravity)
    lift = friction * normal * ratio * weight

    def velocity(t):
        return pull * t - np.expm1(-np.multiply.outer(t, rate)) @ (lift / rate)

    time = np.asarray(time, dtype=float)
    if pull < 0.0:
        # all that the pressure can ever give is lost again by then
        last = (lift / rate).sum() / -pull
        tiny = 1e-9 * consolidation_time  # not the start, which is a root as well
        moves = pull + lift.sum() > 0.0
        time = np.minimum(time, brentq(velocity, tiny, 1.001 * last, xtol=1e-12) if moves else 0.0)
    decay = np.exp(-np.multiply.outer(time, rate))
    return velocity(time), 0.5 * pull * time**2 + time * (lift / rate).sum() - (1.0 - decay) @ (lift / rate**2)
