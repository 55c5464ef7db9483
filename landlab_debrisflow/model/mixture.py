"""What a flow of two phases does besides: grains and water drag each other, share the soil, and squeeze the pores.

The particles of both phases are in the same arrays. Grains meet the bed, and carry the columns; water
is dragged along. All is exchanged between grains and their partners among the water (`spatial.across.find_partners`),
with weights that sum to 1, so what one gives the other gets, to the last digit.
"""

import numpy as np

from ..core.jit import inner, kernel
from ..physics.contracts import WATER
from ..spatial.across import find_partners

STEPS_BETWEEN_LOOKS = 16
"""Steps after which the depth mean of the pore pressure is read off the columns; between, only what changes of porosity
make of it is followed, which can be fast."""

STEPS_WITH_PARTNERS = 4
"""Steps for which grains keep their partners among the water: in so few nothing gets far."""

LEAST = 1e-6
"""Least part of the volume that either phase is taken to have."""


class Mixture:
    """The two phases of a simulation.

    Parameters
    ----------
    physics : Physics
        With a flow law of two phases.
    """

    def __init__(self, physics):
        self.law, self.material, self.column = physics.flow, physics.material, physics.column
        self.partners, self._found_for, self._found = None, None, 0  # of the grains; for whom and how long ago
        self.coupling = self.manning = None  # drag per area and relative velocity [Pa s m-1]; of the bed on water [s-1]
        self._steps = 0

    def found(self, p, cells) -> None:
        """Note what the sums over neighbours found of the mixture; `cells` are those of grains and of water."""
        material, law = self.material, self.law
        _mix(p.phase, p.share, material.solid_density, material.water_density, p.porosity, p.density)
        np.divide(p.own_thickness, p.share, out=p.thickness)
        self.coupling = law.drag_coefficient(p.porosity, material) * p.thickness
        self.manning = np.zeros(1)
        if law.manning_coefficient > 0.0:
            self.manning = material.gravity * law.manning_coefficient**2 / np.maximum(p.thickness, 1e-6) ** (4.0 / 3.0)
        if p.roll != self._found_for or self._found == STEPS_WITH_PARTNERS:
            self.partners = find_partners(*cells, p.x, p.y, p.z, p.volume, p.smoothing_length)
            _make_whole(*self.partners, p.porosity, p.volume)
            self._found_for, self._found = p.roll, 0
        self._found += 1

    def kick(self, sim, velocity, yield_stress, drag, rest_speed: float, dt: float) -> None:
        """Accelerate grains and water along the bed for `dt` seconds, friction and drag between them included.

        Parameters
        ----------
        sim : Simulation
        velocity : ndarray, shape (3, n)
            Changed in place [m s-1].
        yield_stress, drag, rest_speed
            As for `motion.kick`; the resistance is that of the mixture, and grains bear it.
        dt : float
            [s]
        """
        p, material = sim.particles, self.material
        _kick(
            *self.partners, p.phase, velocity, p.thrust, sim.ground, sim.cosine, yield_stress, drag, self.coupling,
            p.porosity, self.manning, p.thickness, p.volume, material.solid_density, material.water_density,
            material.gravity, rest_speed, dt,
        )  # fmt: skip

    def held(self, sim, yield_stress, drag):
        """Return which grains friction would hold at rest, and which water drag, shape (n,)."""
        p, velocity = sim.particles, np.zeros((3, sim.particles.count))
        self.kick(sim, velocity, yield_stress, drag, 0.0, 1.0)
        pull = _pull(p.thrust, sim.ground, sim.cosine, self.material.gravity)
        seeping = pull * self.material.water_density * p.porosity * p.thickness
        return np.where(p.phase == WATER, seeping <= sim.rest_speed * self.coupling, ~np.any(velocity, axis=0))

    def takes_soil(self, p):
        """Return which particles the bed may give soil to: grains with water around to take its part."""
        takes = np.zeros(p.count, bool)
        takes[self.partners.of[self.partners.count > 0]] = True
        return takes

    def take_up(self, sim, granted) -> None:
        """Give water its part of the soil that the grains took, of volume `granted`, shape (n,) [m3]."""
        p, material = sim.particles, self.material
        if granted.any():
            exponent = 1.0 - material.basal_slip_ratio
            _share_soil(*self.partners, granted, material.soil_porosity, p.volume, p.velocity, exponent)

    def force(self, sim, forced, dt: float):
        """Return the forcing of the columns with what two phases make of it.

        Water that leaves relative to the grains lets their skeleton take up the load: with dn/dt the rate by
        relative motion, dp/dt = K/(1 - n) dn/dt (docs/decisions.md, Two phases 2).
        """
        p = sim.particles
        gain = self.law.stiffness * np.log((1.0 - p.porosity_before) / (1.0 - p.porosity))
        gain[sim.inflow.held(p)] = 0.0
        gain[p.phase == WATER] = 0.0
        c_v = self.law.coefficient_of_consolidation(p.porosity, self.material)
        source = gain / dt if dt > 0.0 else np.zeros(1)
        return forced._replace(porosity_source=source, coefficient_of_consolidation=c_v)

    def follow_mean(self, sim, source, dt: float) -> None:
        """Follow the depth mean of the pore pressure through a step with a source [Pa s-1]: thrust depends on it."""
        p = sim.particles
        if self._steps % STEPS_BETWEEN_LOOKS == 0:
            profile = sim.columns_now()
            mean = (profile.sum(axis=1) - 0.5 * (profile[:, 0] + profile[:, -1])) / (profile.shape[1] - 1)
            np.copyto(p.mean_excess_pore_pressure, mean, where=p.phase != WATER)
            dt = 0.0
        weight = self.material.water_density * self.material.gravity
        gained = dt if self.column.stores_pressure else 0.0
        _follow(
            p.phase,
            gained,
            source,
            weight,
            p.thickness,
            sim.cosine,
            p.liquefaction_pressure,
            p.mean_excess_pore_pressure,
        )
        self._steps += 1

    def celerity_squared(self, sim, dt: float):
        """Return by how much the square of the celerity is higher as the skeleton is stiff, shape (n,) [m2 s-2].

        Of the wave in which water moves against grains, K n (1/rho_w + n/((1 - n) rho_s)), drag leaves what is reached
        of a velocity in a step of `dt` seconds.
        """
        if not self.column.stores_pressure:
            return np.zeros(1)
        p, material = sim.particles, self.material
        n = p.porosity
        lightness = n / material.water_density + n * n / ((1.0 - n) * material.solid_density)
        x = dt * self.coupling / (p.thickness * n * n) * lightness
        return self.law.stiffness * lightness * -np.expm1(-x) / np.maximum(x, 1e-12)


@kernel
def _mix(phase, share, solid_density, water_density, porosity, density):
    for i in range(phase.size):
        share[i] = min(max(share[i], LEAST), 1.0 - LEAST)
        porosity[i] = share[i] if phase[i] == WATER else 1.0 - share[i]
        density[i] = solid_density + porosity[i] * (water_density - solid_density)


@kernel
def _follow(phase, dt, source, weight, thickness, cosine, liquefaction_pressure, mean):
    """Add the source to the mean of grains, and hold it between suction and liquefaction."""
    for i in range(phase.size):
        if phase[i] != WATER:
            gained = mean[i] + dt * source[min(i, source.size - 1)]
            lowest, highest = -0.5 * weight * thickness[i] * cosine[i], 0.5 * liquefaction_pressure[i]
            mean[i] = min(max(gained, lowest), highest)


@inner
def _along(i, push, ground, cosine, gravity):
    """Return the acceleration by gravity and thrust along the bed [m s-2]."""
    c = cosine[i]
    nx, ny, nz = -c * ground[1, i], -c * ground[2, i], c
    across = push[0, i] * nx + push[1, i] * ny + push[2, i] * nz - gravity * nz
    return push[0, i] - across * nx, push[1, i] - across * ny, push[2, i] - across * nz - gravity


@kernel
def _kick(
    of, count, index, weight, phase, velocity, push, ground, cosine, yield_stress, drag, coupling, porosity, manning,
    thickness, volume, solid_density, water_density, gravity, rest_speed, dt,
):  # fmt: skip
    """Solve for each grain and the water around it, exactly for constant forces; see `docs/decisions.md`, Two phases 3.

    Grains of mass m_s and water of mass m_w, per area, with the relative velocity d = v_w - v_s, and
    x = dt C (1/m_s + 1/m_w): d' = d exp(-x) + dt phi(x) (a_w - a_s + f/m_s), phi = (1 - exp(-x))/x, and the sum of
    momenta changes by dt (m_s a_s + m_w a_w - f). So v_s' is linear in the friction f, with a compliance G, and
    friction stops grains just where f G takes all their speed.
    """
    n = phase.size
    moves, received = np.empty((n, 6)), np.zeros((n, 3))  # velocity and acceleration without friction; what drag gives
    for i in range(n):
        moves[i, 0], moves[i, 1], moves[i, 2] = velocity[0, i], velocity[1, i], velocity[2, i]
        moves[i, 3], moves[i, 4], moves[i, 5] = _along(i, push, ground, cosine, gravity)
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
        nx, ny, nz = -cosine[i] * ground[1, i], -cosine[i] * ground[2, i], cosine[i]
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
            if slow < rest_speed and slow * slow < us * us + vs * vs + ws * ws:
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
        nx, ny, nz = -cosine[i] * ground[1, i], -cosine[i] * ground[2, i], cosine[i]
        across = gx * nx + gy * ny + gz * nz
        ax, ay, az = moves[i, 3], moves[i, 4], moves[i, 5]
        u = velocity[0, i] + dt * ax + gx - across * nx
        v = velocity[1, i] + dt * ay + gy - across * ny
        w = velocity[2, i] + dt * az + gz - across * nz
        was = np.sqrt(velocity[0, i] ** 2 + velocity[1, i] ** 2 + velocity[2, i] ** 2)
        factor = 1.0 / (1.0 + dt * manning[min(i, manning.size - 1)] * was)
        speed = factor * np.sqrt(u * u + v * v + w * w)
        if speed < rest_speed and speed < was:
            seepage = np.sqrt(ax * ax + ay * ay + az * az) * water_density * porosity[i] * thickness[i]
            if seepage <= rest_speed * coupling[i]:  # what drag would leave of its speed if the grains rest
                factor = 0.0
        velocity[0, i], velocity[1, i], velocity[2, i] = factor * u, factor * v, factor * w


MOST_SCALED = 2.0
"""Most by which the part that grains have in a water particle is raised to make it whole. On lattices that lie anyhow
over each other the parts sum to 0.5 to 1.4; water with still fewer grains around flows partly by itself."""


@kernel
def _make_whole(of, count, index, weight, porosity, volume):
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
def _pull(push, ground, cosine, gravity):
    """Return the size of the acceleration along the bed, shape (n,) [m s-2]."""
    pull = np.empty(cosine.size)
    for i in range(cosine.size):
        ax, ay, az = _along(i, push, ground, cosine, gravity)
        pull[i] = np.sqrt(ax * ax + ay * ay + az * az)
    return pull


@kernel
def _share_soil(of, count, index, weight, granted, share, volume, velocity, exponent):
    """Share what water there is in the soil among the partners, in place; v goes like V^-`exponent`."""
    taken = np.zeros(volume.size)
    for k in range(of.size):
        soil = share * granted[of[k]]
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
