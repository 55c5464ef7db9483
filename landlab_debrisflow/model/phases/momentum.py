"""Momentum of grains and of the water around them over one kick: gravity, pressure, friction and drag.

For each grain particle and its water, exactly for constant forces (docs/decisions.md, Two phases 3): grains of mass m_s
and water of mass m_w, per area, with the relative velocity d = v_w - v_s, and x = dt C (1/m_s + 1/m_w):
d' = d exp(-x) + dt phi(x) (a_w - a_s + f/m_s), phi = (1 - exp(-x))/x, and the sum of momenta changes by
dt (m_s a_s + m_w a_w - f). So v_s' is linear in the friction f, with a compliance G, and friction stops grains exactly
if f G takes all their speed.
"""

from typing import NamedTuple

import numpy as np

from ...core.jit import allocating_kernel, inner, kernel
from ...core.structs import struct
from ..kinematics import along_bed

FORGOTTEN = 40.0
"""Number of e-foldings after which nothing is left in double precision."""


@struct
class Motion(NamedTuple):
    """Motion of n particles along the bed.

    Attributes
    ----------
    velocity : ndarray, shape (3, n)
        Velocity tangent to the bed, changed in place [m s-1].
    pull : ndarray, shape (3, n)
        Acceleration along the bed by gravity and the pressure of neighbours [m s-2].
    water_pull : ndarray, shape (3, n)
        Of grains: mean acceleration of the water around them, along the bed below the grains [m s-2].
    slope_x : ndarray, shape (n,)
        Slope of the bed, dz/dx [-].
    slope_y : ndarray, shape (n,)
        Slope of the bed, dz/dy [-].
    cos_slope : ndarray, shape (n,)
        Cosine of the slope of the bed [-].
    """

    velocity: np.ndarray
    pull: np.ndarray
    water_pull: np.ndarray
    slope_x: np.ndarray
    slope_y: np.ndarray
    cos_slope: np.ndarray


@struct
class GrainsAndWater(NamedTuple):
    """The mixture at n particles, each of grains or of water.

    Attributes
    ----------
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
def pull_along_bed(partners, push, motion, gravity):
    """Write the acceleration of all particles along the bed, and the mean of the water around each grain particle.

    Between two changes of place both stay as they are: the last kick of a step and the first of the next share them.

    Parameters
    ----------
    partners : Partners
        Partners of the grains among the water.
    push : ndarray, shape (3, n)
        Acceleration by the pressure of neighbours [m s-2].
    motion : Motion
        Of n particles; `pull` and `water_pull` are written.
    gravity : float
        Acceleration by gravity [m s-2].
    """
    of, first, index, weight = partners
    _, pull, water_pull, slope_x, slope_y, cosine = motion
    for i in range(cosine.size):
        pull[0, i], pull[1, i], pull[2, i] = along_bed(i, push, slope_x, slope_y, cosine, gravity)
    for k in range(of.size):
        i, ax, ay, az, total = of[k], 0.0, 0.0, 0.0, 0.0
        for s in range(first[k], first[k + 1]):
            j, fraction = index[s], weight[s]
            ax += fraction * pull[0, j]
            ay += fraction * pull[1, j]
            az += fraction * pull[2, j]
            total += fraction
        if total > 0.0:
            ax, ay, az = ax / total, ay / total, az / total
        nx, ny, nz = -cosine[i] * slope_x[i], -cosine[i] * slope_y[i], cosine[i]
        water_pull[0, i], water_pull[1, i], water_pull[2, i] = _along(ax, ay, az, nx, ny, nz)


@allocating_kernel
def kick_grains(partners, motion, mixture, resistance, dt):
    """Accelerate grains along the bed for `dt` seconds, in place; return the momentum that their water gets by drag.

    Parameters
    ----------
    partners : Partners
        Partners of the m grain particles among the water, which has not been accelerated yet.
    motion : Motion
        Motion of n particles.
    mixture : GrainsAndWater
        Mixture at n particles.
    resistance : MixtureResistance
        Resistance of the bed and between the phases.
    dt : float
        Duration of the step [s].

    Returns
    -------
    ndarray, shape (m, 3)
        Momentum for the partners of each [kg m s-1].
    """
    of, first, index, weight = partners
    velocity, pull, water_pull, slope_x, slope_y, cosine = motion
    volume, thickness, porosity, solid_density, water_density = mixture
    yield_stress, drag, phase_drag, _, rest_speed = resistance
    impulse = np.empty((of.size, 3))
    for k in range(of.size):
        i, u, v, w, taken = of[k], 0.0, 0.0, 0.0, 0.0
        for s in range(first[k], first[k + 1]):
            j, fraction = index[s], weight[s]
            u += fraction * velocity[0, j]
            v += fraction * velocity[1, j]
            w += fraction * velocity[2, j]
            taken += fraction
        alone = first[k] == first[k + 1]
        if not alone:
            u, v, w = u / taken, v / taken, w / taken
        # water around on another slope moves across the bed here: this component is left out
        nx, ny, nz = -cosine[i] * slope_x[i], -cosine[i] * slope_y[i], cosine[i]
        u, v, w = _along(u, v, w, nx, ny, nz)
        ax, ay, az = water_pull[0, i], water_pull[1, i], water_pull[2, i]
        bx, by, bz = pull[0, i], pull[1, i], pull[2, i]
        us, vs, ws = velocity[0, i], velocity[1, i], velocity[2, i]
        m_s = solid_density * (1.0 - porosity[i]) * thickness[i]
        m_w = water_density * porosity[i] * thickness[i]
        # drag is per volume of water; these grains claim the fraction `taken` of it
        x = dt * phase_drag[i] * (taken / m_s + 1.0 / m_w)
        m_w *= 1.0 if alone else taken
        lost = 1.0 if x > FORGOTTEN else -np.expm1(-x)
        left, response = 1.0 - lost, dt * (lost / x if x > 1e-12 else 1.0)
        water_fraction = m_w / (m_s + m_w)  # fraction of the mass
        compliance = (dt + m_w / m_s * response) / (m_s + m_w)
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
    return impulse


@kernel
def kick_water(grains, impulse, motion, mixture, resistance, dt):
    """Accelerate water along the bed for `dt` seconds, in place.

    Parameters
    ----------
    grains : Partners
        Grains whose partner each water particle is; made by `reverse`.
    impulse : ndarray, shape (m, 3)
        Momentum that grains give to all their partners [kg m s-1].
    motion, mixture, resistance, dt
        As in `kick_grains`.
    """
    of, first, index, weight = grains
    velocity, pull, _, slope_x, slope_y, cosine = motion
    volume, thickness, porosity, _, water_density = mixture
    _, _, phase_drag, water_drag, rest_speed = resistance
    for k in range(of.size):
        i, gx, gy, gz = of[k], 0.0, 0.0, 0.0
        for s in range(first[k], first[k + 1]):
            giver, fraction = index[s], weight[s]
            gx += fraction * impulse[giver, 0]
            gy += fraction * impulse[giver, 1]
            gz += fraction * impulse[giver, 2]
        per_mass = 1.0 / (water_density * volume[i])
        nx, ny, nz = -cosine[i] * slope_x[i], -cosine[i] * slope_y[i], cosine[i]
        gx, gy, gz = _along(gx * per_mass, gy * per_mass, gz * per_mass, nx, ny, nz)
        ax, ay, az = pull[0, i], pull[1, i], pull[2, i]
        u, v, w = velocity[0, i] + dt * ax + gx, velocity[1, i] + dt * ay + gy, velocity[2, i] + dt * az + gz
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
