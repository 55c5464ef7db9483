"""What a flow of two phases does besides: grains and water drag each other, share the soil, and squeeze the pores.

The particles of both phases are in the same arrays. Grains meet the bed, and carry the columns; water
is dragged along. All is exchanged between grains and their partners among the water (`spatial.across.find_partners`),
with weights that sum to 1, so what one gives the other gets, to the last digit.
"""

import numpy as np

from ..core.jit import inner, kernel
from ..physics.contracts import WATER
from ..spatial.across import find_partners

STEPS_BETWEEN_LOOKS = 8
"""Steps after which the depth mean of the pore pressure is read off the columns; between, only what changes of porosity
make of it is followed, which can be fast."""


STEPS_WITH_PARTNERS = 4
"""Steps for which grains keep their partners among the water: in so few nothing gets far."""

LEAST = 1e-6
"""Least part of the volume that water and grains are taken to have."""


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
        self.steps = 0

    def porosity(self, p):
        """Return the porosity where the particles are, neither 0 nor 1, shape (n,) [-]."""
        return np.clip(p.porosity, LEAST, 1.0 - LEAST)

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
        p, material, porosity = sim.particles, self.material, self.porosity(sim.particles)
        manning = material.gravity * self.law.manning_coefficient**2 / np.maximum(p.thickness, 1e-6) ** (4.0 / 3.0)
        _kick(
            *self.partners, p.phase, velocity, p.thrust, sim.ground, sim.cosine, yield_stress, drag,
            self._coupling(p, porosity), porosity, manning, p.thickness, p.volume, material.solid_density,
            material.water_density, material.gravity, rest_speed, dt,
        )  # fmt: skip

    def held(self, sim, yield_stress, drag):
        """Return which grains friction would hold at rest, and which water drag, shape (n,)."""
        p, porosity, velocity = sim.particles, self.porosity(sim.particles), np.zeros((3, sim.particles.count))
        self.kick(sim, velocity, yield_stress, drag, 0.0, 1.0)
        held = ~np.any(velocity, axis=0)
        pull = _pull(p.thrust, sim.ground, sim.cosine, self.material.gravity)
        seeping = pull * self.material.water_density * porosity * p.thickness
        return np.where(p.phase == WATER, seeping <= sim.rest_speed * self._coupling(p, porosity), held)

    def take_up(self, sim, granted) -> None:
        """Give water its part of the soil that the grains took, of volume `granted`, shape (n,) [m3]."""
        p, material = sim.particles, self.material
        _share_soil(
            *self.partners, granted, material.soil_porosity, p.volume, p.velocity, 1.0 - material.basal_slip_ratio
        )

    def takes_soil(self, p):
        """Return which particles the bed may give soil to: grains with water around to take its part."""
        takes = np.zeros(p.count, bool)
        takes[self.partners.of[self.partners.count > 0]] = True
        return takes

    def found(self, p, cells) -> None:
        """Note what the sums over neighbours found of the mixture; `cells` are those of grains and of water."""
        np.copyto(p.porosity, np.where(p.phase == WATER, p.share, 1.0 - p.share))
        np.copyto(p.density, self.material.density_of(p.porosity))
        if p.roll != self._found_for or self._found == STEPS_WITH_PARTNERS:
            self.partners = find_partners(*cells, p.x, p.y, p.z, p.volume, p.smoothing_length)
            self._found_for, self._found = p.roll, 0
        self._found += 1

    def force(self, sim, forced, dt: float):
        """Return the forcing of the columns with what two phases make of it."""
        c_v = self.law.coefficient_of_consolidation(self.porosity(sim.particles), self.material)
        gain = self.pressure_gain(sim, dt)
        return forced._replace(porosity_source=gain, coefficient_of_consolidation=c_v)

    def pressure_gain(self, sim, dt: float):
        """Return the pressure that changes of porosity made in the step that has gone, and follow its depth mean.

        Water that leaves relative to the grains lets their skeleton take up the load: with dn/dt the rate by
        relative motion, dp/dt = K/(1 - n) dn/dt (docs/decisions.md, Two phases 2).

        Returns
        -------
        ndarray, shape (n,)
            [Pa s-1]
        """
        p = sim.particles
        before = np.clip(p.porosity_before, LEAST, 1.0 - LEAST)
        gain = self.law.stiffness * np.log((1.0 - before) / (1.0 - self.porosity(p)))
        gain[p.phase == WATER] = 0.0
        gain[sim.inflow.held(p)] = 0.0
        return gain / dt if dt > 0.0 else gain

    def follow_mean(self, sim, gain) -> None:
        """Follow the depth mean of the pore pressure after a step that gained so much [Pa]: thrust depends on it."""
        p = sim.particles
        grains = p.phase != WATER
        if self.steps % STEPS_BETWEEN_LOOKS == 0:
            profile = sim.columns_now()[grains]
            mean = (profile.sum(axis=1) - 0.5 * (profile[:, 0] + profile[:, -1])) / (profile.shape[1] - 1)
        else:
            mean = p.mean_excess_pore_pressure[grains] + (gain[grains] if self.column.stores_pressure else 0.0)
        suction = self.material.water_density * self.material.gravity * p.thickness * sim.cosine
        p.mean_excess_pore_pressure[grains] = np.clip(
            mean, -0.5 * suction[grains], 0.5 * p.liquefaction_pressure[grains]
        )
        self.steps += 1

    def celerity_squared(self, sim, dt: float):
        """Return by how much the square of the celerity is higher as the skeleton is stiff, shape (n,) [m2 s-2].

        Of the wave in which water moves against grains, K n (1/rho_w + n/((1 - n) rho_s)), drag leaves what is reached
        of a velocity in a step of `dt` seconds.
        """
        material, n = self.material, self.porosity(sim.particles)
        stiff = self.law.stiffness * n * (1.0 / material.water_density + n / ((1.0 - n) * material.solid_density))
        lightness = 1.0 / (material.water_density * n) + 1.0 / (material.solid_density * (1.0 - n))
        x = dt * self.law.drag_coefficient(n, material) * lightness
        return stiff * -np.expm1(-x) / np.maximum(x, 1e-12) if self.column.stores_pressure else np.zeros(1)

    def _coupling(self, p, porosity):
        """Return drag per area and relative velocity, shape (n,) [Pa s m-1]."""
        return self.law.drag_coefficient(porosity, self.material) * p.thickness


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
        u, v, w, ax, ay, az = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0  # of the water around
        for s in range(count[k]):
            j, part = index[k, s], weight[k, s]
            u += part * moves[j, 0]
            v += part * moves[j, 1]
            w += part * moves[j, 2]
            ax += part * moves[j, 3]
            ay += part * moves[j, 4]
            az += part * moves[j, 5]
        nx, ny, nz = -cosine[i] * ground[1, i], -cosine[i] * ground[2, i], cosine[i]
        # what water around on other slopes has across this one does not count
        across, pull = u * nx + v * ny + w * nz, ax * nx + ay * ny + az * nz
        u, v, w = u - across * nx, v - across * ny, w - across * nz
        ax, ay, az = ax - pull * nx, ay - pull * ny, az - pull * nz
        m_s = solid_density * (1.0 - porosity[i]) * thickness[i]
        m_w = water_density * porosity[i] * thickness[i]
        x = dt * coupling[i] * (1.0 / m_s + 1.0 / m_w) if count[k] > 0 else 0.0
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
        mass = m_w * solid_density * volume[i] / m_s  # of the water with these grains
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
        factor = 1.0 / (1.0 + dt * manning[i] * was)
        speed = factor * np.sqrt(u * u + v * v + w * w)
        if speed < rest_speed and speed < was:
            seepage = np.sqrt(ax * ax + ay * ay + az * az) * water_density * porosity[i] * thickness[i]
            if seepage <= rest_speed * coupling[i]:  # what drag would leave of its speed if the grains rest
                factor = 0.0
        velocity[0, i], velocity[1, i], velocity[2, i] = factor * u, factor * v, factor * w


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
    before = volume.copy()
    for k in range(of.size):
        for s in range(count[k]):
            volume[index[k, s]] += weight[k, s] * share * granted[of[k]]
    for i in range(volume.size):
        if volume[i] > before[i]:
            part = (before[i] / volume[i]) ** exponent
            for d in range(3):
                velocity[d, i] *= part
