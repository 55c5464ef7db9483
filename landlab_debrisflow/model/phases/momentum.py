"""Momentum of grains and of the water around them over one kick: gravity, pressure, friction and drag.

For each grain particle and its water, exactly for constant forces (docs/decisions.md, Two phases 3): grains of mass m_s
and water of mass m_w, per area, with the relative velocity d = v_w - v_s, and x = dt C (1/m_s + 1/m_w):
d' = d exp(-x) + dt phi(x) (a_w - a_s + f/m_s), phi = (1 - exp(-x))/x, and the sum of momenta changes by
dt (m_s a_s + m_w a_w - f). So v_s' is linear in the friction f, with a compliance G, and friction stops grains exactly
if f G takes all their speed.
"""

from typing import NamedTuple

import numpy as np

from ...core.jit import inner, kernel
from ...core.structs import struct
from ...physics.contracts import WATER
from ..kinematics import along_bed


@struct
class Motion(NamedTuple):
    """Motion of n particles along the bed.

    Attributes
    ----------
    velocity : ndarray, shape (3, n)
        Velocity tangent to the bed [m s-1].
    pressure_acceleration : ndarray, shape (3, n)
        Acceleration by the pressure of neighbours [m s-2].
    slope_x : ndarray, shape (n,)
        Slope of the bed, dz/dx [-].
    slope_y : ndarray, shape (n,)
        Slope of the bed, dz/dy [-].
    cos_slope : ndarray, shape (n,)
        Cosine of the slope of the bed [-].
    """

    velocity: np.ndarray
    pressure_acceleration: np.ndarray
    slope_x: np.ndarray
    slope_y: np.ndarray
    cos_slope: np.ndarray


@struct
class GrainsAndWater(NamedTuple):
    """The mixture at n particles, each of grains or of water.

    Attributes
    ----------
    phase : ndarray, shape (n,)
        MIXTURE, which are the grains, or WATER.
    volume : ndarray, shape (n,)
        Volume of the particle's own phase [m3].
    thickness : ndarray, shape (n,)
        Slope-normal thickness of both phases [m].
    porosity : ndarray, shape (n,)
        Pores over the whole [-].
    solid_density : float
        Density of the grains [kg m-3].
    water_density : float
        Density of the water [kg m-3].
    """

    phase: np.ndarray
    volume: np.ndarray
    thickness: np.ndarray
    porosity: np.ndarray
    solid_density: float
    water_density: float


@struct
class MixtureResistance(NamedTuple):
    """Resistance of the bed, and of the phases against each other, at n particles.

    Attributes
    ----------
    yield_stress : ndarray, shape (n,)
        Yield stress of the mixture, borne by grains [Pa].
    drag : ndarray, shape (n,)
        Other resistance of the bed over speed, borne by grains [Pa s m-1].
    phase_drag : ndarray, shape (n,)
        Drag between the phases, per area and relative velocity [Pa s m-1].
    water_drag : ndarray, shape (n,) or (1,)
        Drag of the bed on water, over its mass and speed squared [m-1].
    rest_speed : ndarray, shape (n,) or (1,)
        Speed below which particles come to rest where they may; infinite: all do [m s-1].
    """

    yield_stress: np.ndarray
    drag: np.ndarray
    phase_drag: np.ndarray
    water_drag: np.ndarray
    rest_speed: np.ndarray


@kernel
def kick_both(partners, motion, mixture, resistance, gravity, dt):
    """Accelerate grains and water along the bed for `dt` seconds, in place.

    Parameters
    ----------
    partners : Partners
        Partners of the m grain particles among the water.
    motion : Motion
        Motion of n particles.
    mixture : GrainsAndWater
        Mixture at n particles.
    resistance : MixtureResistance
        Resistance of the bed and between the phases.
    gravity : float
        Acceleration by gravity [m s-2].
    dt : float
        Duration of the step [s].
    """
    of, count = partners.of, partners.count
    velocity, _, slope_x, slope_y, cosine = motion
    phase, volume, thickness, porosity, solid_density, water_density = mixture
    yield_stress, drag, phase_drag, water_drag, rest_speed = resistance
    free = _free_motion(motion, gravity)
    around, impulse = _gather_water(partners, free), np.empty((of.size, 3))
    # 1. kick the grains, and find the momentum that their water gets by drag
    for k in range(of.size):
        i, taken = of[k], around[k, 6]
        u, v, w = around[k, 0], around[k, 1], around[k, 2]
        ax, ay, az = around[k, 3], around[k, 4], around[k, 5]
        # water around on another slope moves across the bed here: this component is left out
        nx, ny, nz = -cosine[i] * slope_x[i], -cosine[i] * slope_y[i], cosine[i]
        u, v, w = _along(u, v, w, nx, ny, nz)
        ax, ay, az = _along(ax, ay, az, nx, ny, nz)
        m_s = solid_density * (1.0 - porosity[i]) * thickness[i]
        m_w = water_density * porosity[i] * thickness[i]
        # drag is per volume of water; these grains claim the fraction `taken` of it
        x = dt * phase_drag[i] * (taken / m_s + 1.0 / m_w)
        m_w *= taken if count[k] > 0 else 1.0
        lost = -np.expm1(-x)
        left, response = 1.0 - lost, dt * (lost / x if x > 1e-12 else 1.0)
        water_fraction = m_w / (m_s + m_w)  # fraction of the mass
        compliance = (dt + m_w / m_s * response) / (m_s + m_w)
        us, vs, ws, bx, by, bz = free[i, 0], free[i, 1], free[i, 2], free[i, 3], free[i, 4], free[i, 5]
        du = (u - us) * left + response * (ax - bx)
        dv = (v - vs) * left + response * (ay - by)
        dw = (w - ws) * left + response * (az - bz)
        fu = us + dt * bx + water_fraction * (u - us + dt * (ax - bx) - du)
        fv = vs + dt * by + water_fraction * (v - vs + dt * (ay - by) - dv)
        fw = ws + dt * bz + water_fraction * (w - ws + dt * (az - bz) - dw)
        speed, grip = np.sqrt(fu * fu + fv * fv + fw * fw), compliance * yield_stress[i]
        factor = 0.0
        if speed > 0.0 or not speed <= 0.0:  # a NaN must survive until the check after the step
            slow = speed - grip
            if slow < 0.0:
                slow = 0.0
            slow /= 1.0 + compliance * drag[i]
            factor = slow / speed
            least = rest_speed[min(i, rest_speed.size - 1)]
            if slow < least and least == np.inf:
                factor = 0.0
            elif slow < least and slow * slow < us * us + vs * vs + ws * ws:
                reached = water_fraction * (dt - response)  # part of the pull on the water that drag passes on
                ex, ey, ez = dt * bx + reached * (ax - bx), dt * by + reached * (ay - by), dt * bz + reached * (az - bz)
                if ex * ex + ey * ey + ez * ez <= grip * grip:
                    factor = 0.0
        velocity[0, i], velocity[1, i], velocity[2, i] = factor * fu, factor * fv, factor * fw
        # velocity of the water: that of the grains, the difference left by drag, and a further one by friction on the
        # grains
        more = factor + response / m_s * (1.0 - factor) / compliance
        mass = water_density * volume[i] * porosity[i] / (1.0 - porosity[i])  # mass of the water with these grains
        impulse[k, 0] = mass * (more * fu + du - u - dt * ax)
        impulse[k, 1] = mass * (more * fv + dv - v - dt * ay)
        impulse[k, 2] = mass * (more * fw + dw - w - dt * az)
    received = _give_back(partners, impulse, phase.size)
    # 2. kick the water with the momentum it received and the drag of the bed
    for i in range(phase.size):
        if phase[i] != WATER:
            continue
        per_mass = 1.0 / (water_density * volume[i])
        gx, gy, gz = received[i, 0] * per_mass, received[i, 1] * per_mass, received[i, 2] * per_mass
        nx, ny, nz = -cosine[i] * slope_x[i], -cosine[i] * slope_y[i], cosine[i]
        across = gx * nx + gy * ny + gz * nz
        ax, ay, az = free[i, 3], free[i, 4], free[i, 5]
        u = velocity[0, i] + dt * ax + gx - across * nx
        v = velocity[1, i] + dt * ay + gy - across * ny
        w = velocity[2, i] + dt * az + gz - across * nz
        was = np.sqrt(velocity[0, i] ** 2 + velocity[1, i] ** 2 + velocity[2, i] ** 2)
        factor = 1.0 / (1.0 + dt * water_drag[min(i, water_drag.size - 1)] * was)
        speed = factor * np.sqrt(u * u + v * v + w * w)
        slowest = rest_speed[min(i, rest_speed.size - 1)]
        if speed < slowest and slowest == np.inf:
            factor = 0.0
        elif speed < slowest and speed < was:
            seepage = np.sqrt(ax * ax + ay * ay + az * az) * water_density * porosity[i] * thickness[i]
            if seepage <= slowest * phase_drag[i]:  # between grains at rest, drag would leave no more speed than this
                factor = 0.0
        velocity[0, i], velocity[1, i], velocity[2, i] = factor * u, factor * v, factor * w


@inner
def _along(x, y, z, nx, ny, nz):
    """Return a vector without its component normal to the bed, in its unit.

    The vector has the components x, y, z; nx, ny, nz is the unit normal of the bed [-]. All are floats.
    """
    across = x * nx + y * ny + z * nz
    return x - across * nx, y - across * ny, z - across * nz


@inner
def _free_motion(motion, gravity):
    """Return velocity and acceleration without friction and drag, shape (n, 6) [m s-1, m s-2].

    `motion` is a `Motion`; `gravity` is in m s-2.
    """
    velocity, pressure, slope_x, slope_y, cosine = motion
    free = np.empty((cosine.size, 6))
    for i in range(cosine.size):
        free[i, 0], free[i, 1], free[i, 2] = velocity[0, i], velocity[1, i], velocity[2, i]
        free[i, 3], free[i, 4], free[i, 5] = along_bed(i, pressure, slope_x, slope_y, cosine, gravity)
    return free


@inner
def _gather_water(partners, free):
    """Return the mean free motion of the water around each of m grain particles and the sum of its weights, (m, 7)."""
    count, index, weight = partners.count, partners.index, partners.weight
    around = np.empty((count.size, 7))
    for k in range(count.size):
        u, v, w, ax, ay, az, taken = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
        for s in range(count[k]):
            j, fraction = index[k, s], weight[k, s]
            u += fraction * free[j, 0]
            v += fraction * free[j, 1]
            w += fraction * free[j, 2]
            ax += fraction * free[j, 3]
            ay += fraction * free[j, 4]
            az += fraction * free[j, 5]
            taken += fraction
        if count[k] > 0:
            u, v, w, ax, ay, az = u / taken, v / taken, w / taken, ax / taken, ay / taken, az / taken
        around[k, 0], around[k, 1], around[k, 2] = u, v, w
        around[k, 3], around[k, 4], around[k, 5], around[k, 6] = ax, ay, az, taken
    return around


@inner
def _give_back(partners, impulse, n):
    """Return the momentum that each of n particles gets from grains by drag, shape (n, 3) [kg m s-1].

    `partners` are the `Partners` of m grains; `impulse` is the momentum each of these gives, shape (m, 3) [kg m s-1].
    """
    count, index, weight, received = partners.count, partners.index, partners.weight, np.zeros((n, 3))
    for k in range(count.size):
        gx, gy, gz = impulse[k, 0], impulse[k, 1], impulse[k, 2]
        for s in range(count[k]):
            j, fraction = index[k, s], weight[k, s]
            received[j, 0] += fraction * gx
            received[j, 1] += fraction * gy
            received[j, 2] += fraction * gz
    return received
