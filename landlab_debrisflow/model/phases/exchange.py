"""Grains and the water around them: drag, friction and soil, exchanged between partners."""

import numpy as np

from ...core.jit import kernel
from ...physics.contracts import WATER
from ..kinematics import along_bed


class Exchange:
    """What grains and water know of each other from step to step; in a flow of one phase it stays empty.

    Attributes
    ----------
    partners : Partners or None
        Of the grains among the water.
    generation : tuple of int or None
        `Particles.generation` for which they were found.
    age : int
        Sums over neighbours since then.
    steps : int
        Times that the mean pore pressure was updated.
    """

    def __init__(self):
        self.partners, self.generation, self.age, self.steps = None, None, 0, 0

    def copy(self) -> "Exchange":
        """Return an independent copy; partners are never changed, but replaced."""
        other = Exchange()
        vars(other).update(vars(self))
        return other


@kernel
def kick_both(
    of, count, index, weight, phase, velocity, push, sample, cosine, yield_stress, drag, coupling, porosity, manning,
    thickness, volume, solid_density, water_density, gravity, rest_speed, dt,
):  # fmt: skip
    """Solve for each grain and the water around it, exactly for constant forces; see `docs/decisions.md`, Two phases 3.

    Grains of mass m_s and water of mass m_w, per area, with the relative velocity d = v_w - v_s, and
    x = dt C (1/m_s + 1/m_w): d' = d exp(-x) + dt phi(x) (a_w - a_s + f/m_s), phi = (1 - exp(-x))/x, and the sum of
    momenta changes by dt (m_s a_s + m_w a_w - f). So v_s' is linear in the friction f, with a compliance G, and
    friction stops grains just where f G takes all their speed.
    """
    n, slope_x, slope_y = phase.size, sample.slope_x, sample.slope_y
    moves, received = np.empty((n, 6)), np.zeros((n, 3))  # velocity and acceleration without friction; what drag gives
    for i in range(n):
        moves[i, 0], moves[i, 1], moves[i, 2] = velocity[0, i], velocity[1, i], velocity[2, i]
        moves[i, 3], moves[i, 4], moves[i, 5] = along_bed(i, push, slope_x, slope_y, cosine, gravity)
    for k in range(of.size):
        i = of[k]
        u, v, w, ax, ay, az, taken = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0  # of the water around
        for s in range(count[k]):
            j, part = index[k, s], weight[k, s]
            u += part * moves[j, 0]
            v += part * moves[j, 1]
            w += part * moves[j, 2]
            ax += part * moves[j, 3]
            ay += part * moves[j, 4]
            az += part * moves[j, 5]
            taken += part
        if count[k] > 0:
            u, v, w, ax, ay, az = u / taken, v / taken, w / taken, ax / taken, ay / taken, az / taken
        nx, ny, nz = -cosine[i] * slope_x[i], -cosine[i] * slope_y[i], cosine[i]
        # what water around on other slopes has across this one does not count
        across, pull = u * nx + v * ny + w * nz, ax * nx + ay * ny + az * nz
        u, v, w = u - across * nx, v - across * ny, w - across * nz
        ax, ay, az = ax - pull * nx, ay - pull * ny, az - pull * nz
        m_s = solid_density * (1.0 - porosity[i]) * thickness[i]
        m_w = water_density * porosity[i] * thickness[i]
        x = dt * coupling[i] * (taken / m_s + 1.0 / m_w)  # drag is per volume of water, of which so much is with these
        m_w *= taken if count[k] > 0 else 1.0
        lost = -np.expm1(-x)
        left, response = 1.0 - lost, dt * (lost / x if x > 1e-12 else 1.0)
        part = m_w / (m_s + m_w)  # of the momentum
        compliance = (dt + m_w / m_s * response) / (m_s + m_w)
        us, vs, ws, bx, by, bz = moves[i, 0], moves[i, 1], moves[i, 2], moves[i, 3], moves[i, 4], moves[i, 5]
        du = (u - us) * left + response * (ax - bx)
        dv = (v - vs) * left + response * (ay - by)
        dw = (w - ws) * left + response * (az - bz)
        fu = us + dt * bx + part * (u - us + dt * (ax - bx) - du)
        fv = vs + dt * by + part * (v - vs + dt * (ay - by) - dv)
        fw = ws + dt * bz + part * (w - ws + dt * (az - bz) - dw)
        speed, grip = np.sqrt(fu * fu + fv * fv + fw * fw), compliance * yield_stress[i]
        factor = 0.0
        if speed > 0.0 or not speed <= 0.0:  # a NaN must survive
            slow = speed - grip
            if slow < 0.0:
                slow = 0.0
            slow /= 1.0 + compliance * drag[i]
            factor = slow / speed
            least = rest_speed[min(i, rest_speed.size - 1)]
            if slow < least and least == np.inf:
                factor = 0.0
            elif slow < least and slow * slow < us * us + vs * vs + ws * ws:
                share = part * (dt - response)  # what of the pull on the water has reached the grains
                ex, ey, ez = dt * bx + share * (ax - bx), dt * by + share * (ay - by), dt * bz + share * (az - bz)
                if ex * ex + ey * ey + ez * ez <= grip * grip:
                    factor = 0.0
        velocity[0, i], velocity[1, i], velocity[2, i] = factor * fu, factor * fv, factor * fw
        # the water's velocity is that of the grains, and apart, and more apart for the friction on the grains
        more = factor + response / m_s * (1.0 - factor) / compliance
        mass = water_density * volume[i] * porosity[i] / (1.0 - porosity[i])  # of the water with these grains
        gx, gy, gz = (
            mass * (more * fu + du - u - dt * ax), mass * (more * fv + dv - v - dt * ay),
            mass * (more * fw + dw - w - dt * az),
        )  # fmt: skip
        for s in range(count[k]):
            j, part = index[k, s], weight[k, s]
            received[j, 0] += part * gx
            received[j, 1] += part * gy
            received[j, 2] += part * gz
    for i in range(n):
        if phase[i] != WATER:
            continue
        per_mass = 1.0 / (water_density * volume[i])
        gx, gy, gz = received[i, 0] * per_mass, received[i, 1] * per_mass, received[i, 2] * per_mass
        nx, ny, nz = -cosine[i] * slope_x[i], -cosine[i] * slope_y[i], cosine[i]
        across = gx * nx + gy * ny + gz * nz
        ax, ay, az = moves[i, 3], moves[i, 4], moves[i, 5]
        u = velocity[0, i] + dt * ax + gx - across * nx
        v = velocity[1, i] + dt * ay + gy - across * ny
        w = velocity[2, i] + dt * az + gz - across * nz
        was = np.sqrt(velocity[0, i] ** 2 + velocity[1, i] ** 2 + velocity[2, i] ** 2)
        factor = 1.0 / (1.0 + dt * manning[min(i, manning.size - 1)] * was)
        speed = factor * np.sqrt(u * u + v * v + w * w)
        slowest = rest_speed[min(i, rest_speed.size - 1)]
        if speed < slowest and slowest == np.inf:
            factor = 0.0
        elif speed < slowest and speed < was:
            seepage = np.sqrt(ax * ax + ay * ay + az * az) * water_density * porosity[i] * thickness[i]
            if seepage <= slowest * coupling[i]:  # what drag would leave of its speed if the grains rest
                factor = 0.0
        velocity[0, i], velocity[1, i], velocity[2, i] = factor * u, factor * v, factor * w


MOST_SCALED = 2.0
"""Most by which the part that grains have in a water particle is raised to make it whole. On lattices that lie anyhow
over each other the parts sum to 0.5 to 1.4; water with still fewer grains around flows partly by itself."""


@kernel
def make_whole(of, count, index, weight, porosity, volume):
    """Scale the weights so that the parts that grains have in each water particle sum to its volume, in place.

    Stiff drag leaves of a kick nothing but what balances it, if all of the water takes part: of a tenth that does not
    a tenth of the kick remains, and of a tenth taken twice its reverse.
    """
    parts = np.zeros(volume.size)
    for k in range(of.size):
        around = volume[of[k]] * porosity[of[k]] / (1.0 - porosity[of[k]])
        for s in range(count[k]):
            parts[index[k, s]] += around * weight[k, s]
    for k in range(of.size):
        for s in range(count[k]):
            j = index[k, s]
            weight[k, s] *= min(volume[j] / parts[j], MOST_SCALED)


@kernel
def share_soil(of, count, index, weight, entrained, water, volume, velocity, exponent):
    """Share the water of the soil among the partners, in place; v goes like V^-`exponent`.

    `entrained` is what grains took of their own [m3], `water` how much there is of it over that in the soil [-].
    """
    taken = np.zeros(volume.size)
    for k in range(of.size):
        soil = water * entrained[of[k]]
        if soil > 0.0:
            soil /= np.sum(weight[k, : count[k]])
            for s in range(count[k]):
                taken[index[k, s]] += weight[k, s] * soil
    for i in range(volume.size):
        if taken[i] > 0.0:
            part = volume[i] / (volume[i] + taken[i])
            volume[i] += taken[i]
            if exponent < 1.0:
                part **= exponent
            for d in range(3):
                velocity[d, i] *= part
