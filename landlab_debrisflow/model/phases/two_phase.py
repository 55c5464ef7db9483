"""Flow of two phases: grains and water drag each other, share the entrained soil, and squeeze the pores.

The particles of both phases are in the same arrays. Grains meet the bed, and carry the columns; water
is dragged along. Momentum and soil are exchanged between grains and their partners among the water
(`spatial.partners.find_partners`), with weights that sum to 1, so that no digit is lost.
"""

import numpy as np

from ...core.variables import Variable
from ...physics.column.driver import depth_mean
from ...physics.contracts import MIXTURE, WATER
from ...spatial.packing import Position
from ...spatial.partners import find_partners
from ..time_step import NOT_STIFF
from ..walls import bear
from .exchange import distribute_soil_water, leave_to_mixed, make_whole
from .mixture import PoreWater, end_of_grains, find_mixture, follow_source, pressure_by_porosity, stiffen
from .momentum import GrainsAndWater, MixtureResistance, Motion, kick_grains, kick_water, pull_along_bed

STEPS_BETWEEN_PROFILES = 16
"""Number of steps between two readings of the mean pore pressure from the columns. In between, the mean follows the
changes of porosity, which can be fast, and drains at `DRAINAGE`."""

STEPS_WITH_PARTNERS = 8
"""Number of steps for which grains keep their partners among the water: so few that no particle moves far."""


class TwoPhaseDynamics:
    """The `Phases` of a flow of grains and water.

    Parameters
    ----------
    law : FlowLaw
        With two phases.
    material : Material
        Densities, porosity, gravity.
    stores_pressure : bool
        Whether a source of pressure raises the pressure in the columns.
    """

    variables = (
        Variable("cross_term", "-", "grad-h term of the other phase", written=False),
        Variable("mean_excess_pore_pressure", "Pa", "its depth mean", written=False),
        Variable("porosity_before", "-", "before the flow of the step changed it", written=False),
        Variable("phase_drag", "Pa s m-1", "drag between the phases, per area and relative velocity", written=False,
                 scratch=True),
        Variable("bed_drag", "m-1", "drag of the bed on water, over its mass and speed squared", written=False,
                 scratch=True),
        Variable("pull", "m s-2", "acceleration along the bed by gravity and pressure", components=3, written=False,
                 scratch=True),
        Variable("water_pull", "m s-2", "of grains: mean of that of the water around", components=3, written=False,
                 scratch=True),
        Variable("consolidation", "m2 s-1", "coefficient of consolidation of its column", written=False, scratch=True),
    )  # fmt: skip

    sleeps = False
    """Sleep would save 1 to 2 % of the time, and partners would have to be renumbered."""

    def __init__(self, law, material, stores_pressure: bool):
        self.law, self.material, self.stores_pressure = law, material, stores_pressure
        self.phase_fractions = ((MIXTURE, 1.0 - material.porosity), (WATER, material.porosity))
        self.solid_fraction = 1.0 - material.soil_porosity

    def bearing(self, p) -> slice:
        """Return the places up to the last grain; water beyond has neither friction nor a column.

        A release puts all of its grains before its water. Where several follow each other, water between them passes
        through friction and columns, with results that nothing reads.
        """
        return slice(end_of_grains(p.phase))

    def density(self, p):
        """Return the intrinsic density of each particle's phase, shape (n,) [kg m-3]."""
        return np.where(p.phase == WATER, self.material.water_density, self.material.solid_density)

    def solid_volume(self, p):
        """Return the volume of the grains in each particle, shape (n,) [m3]."""
        return p.volume * (p.phase != WATER)

    def coefficient_of_consolidation(self, p, which: slice):
        """Return c_v of the columns of some particles [m2 s-1]: it follows from the drag between the phases."""
        return p.consolidation[which]

    def after_summation(self, p, exchange, cells) -> None:
        """Write thickness, porosity and drag from the sums; `cells` are the cells of grains and of water."""
        material, law = self.material, self.law
        find_mixture(
            p.phase, p.share, p.own_thickness, material.solid_density, material.water_density, p.porosity, p.density,
            p.thickness,
        )  # fmt: skip
        np.multiply(law.drag_coefficient(p.porosity, material), p.thickness, out=p.phase_drag)
        p.consolidation[:] = law.coefficient_of_consolidation(p.porosity, material)
        if law.manning_coefficient > 0.0:
            roughness = material.gravity * law.manning_coefficient**2
            p.bed_drag[:] = roughness / np.maximum(p.thickness, 1e-6) ** (4.0 / 3.0)
        if p.generation != exchange.generation or exchange.age == STEPS_WITH_PARTNERS:
            partners = find_partners(*cells, Position(p.x, p.y, p.z), p.volume, p.smoothing_length)
            make_whole(tuple(partners), p.porosity, p.volume)
            exchange.keep(partners, p.phase, p.generation)
        exchange.age += 1
        pull_along_bed(tuple(exchange.partners), p.thrust, _motion(p, p.velocity), material.gravity)

    def kick(self, p, exchange, velocity, yield_stress, drag, rest_speed, dt: float) -> None:
        """Accelerate grains and water along the bed for `dt` seconds, friction and drag between them included.

        Parameters
        ----------
        p : Particles
            All particles.
        exchange : Exchange
            State of the exchange between grains and water.
        velocity : ndarray, shape (3, n)
            Changed in place [m s-1].
        yield_stress, drag, rest_speed
            As for `kinematics.kick`; the resistance is that of the mixture, and grains bear it.
        dt : float
            Duration of the step [s].
        """
        material = self.material
        motion = _motion(p, velocity)
        mixture = GrainsAndWater(
            volume=p.volume,
            thickness=p.thickness,
            porosity=p.porosity,
            solid_density=material.solid_density,
            water_density=material.water_density,
        )
        resistance = MixtureResistance(
            yield_stress=yield_stress,
            drag=drag,
            phase_drag=p.phase_drag,
            water_drag=p.bed_drag,
            rest_speed=rest_speed,
        )
        impulse = kick_grains(tuple(exchange.partners), motion, mixture, resistance, dt)
        kick_water(tuple(exchange.grains), impulse, motion, mixture, resistance, dt)
        _hold_back(velocity, p.light)

    def held_at_rest(self, p, exchange, which: slice, yield_stress, drag, walls):
        """Return which grains friction and walls would hold at rest, which water drag, (n,); `which` is not used."""
        none, at_rest = np.zeros(p.count), np.zeros(1)
        velocity, pull = np.zeros((3, none.size)), p.pull.copy()
        self.kick(p, exchange, velocity, yield_stress, drag, at_rest, 1.0)
        free = _size(velocity)
        bear(p.x, p.y, velocity, p.surface_sample, walls)
        left = _size(velocity)
        leaning = (left < free) & (left * p.density * p.thickness <= yield_stress)  # friction holds it along the wall
        bear(p.x, p.y, pull, p.surface_sample, walls)
        seeping = _size(pull) * self.material.water_density * p.porosity * p.thickness
        return np.where(p.phase == WATER, seeping <= p.rest_speed * p.phase_drag, leaning | (left == 0.0))

    def limit_entrainment(self, exchange, rate) -> None:
        """Set the erosion rate to 0, in place, for grains without water around to take the water of the soil."""
        leave_to_mixed(tuple(exchange.partners), exchange.grains.of, rate)

    def share_entrained(self, p, exchange) -> None:
        """Give the water of the entrained soil to the water; porosity then changes by the flow alone."""
        if p.entrained_volume.any():
            water_ratio = 1.0 / self.solid_fraction - 1.0  # water over grains, by volume
            exponent = 1.0 - self.material.basal_slip_ratio
            distribute_soil_water(
                tuple(exchange.partners), tuple(exchange.grains), p.entrained_volume, water_ratio, p.volume, p.velocity,
                exponent,
            )  # fmt: skip
        p.porosity_before[:] = p.porosity

    def column_forcing(self, p, forcing, prescribed, dt: float):
        """Return the forcing of the columns with the pressure that a change of porosity makes [Pa s-1].

        Where water leaves the grains, their skeleton takes up load. With dn/dt, the rate of porosity by relative
        motion, dp/dt = K/(1 - n) dn/dt (docs/decisions.md, Two phases 2).
        """
        if dt == 0.0:
            return forcing
        bearing = forcing.volume.size
        source = pressure_by_porosity(
            p.phase[:bearing], p.porosity_before[:bearing], p.porosity[:bearing], self.law.stiffness, dt
        )  # fmt: skip
        source[prescribed[prescribed < bearing]] = 0.0
        return forcing._replace(porosity_source=source)

    def update_mean_pressure(self, p, exchange, forcing, profiles, dt: float) -> None:
        """Update the depth mean of the pore pressure, on which the pressure of the flow depends [Pa].

        The mean is read from the columns every few steps; in between it follows the source.
        """
        if exchange.steps % STEPS_BETWEEN_PROFILES == 0:
            mean = depth_mean(profiles())
            np.copyto(p.mean_excess_pore_pressure[: mean.size], mean, where=p.phase[: mean.size] != WATER)
            dt = 0.0
        weight = self.material.water_density * self.material.gravity
        gained = dt if self.stores_pressure else 0.0
        follow_source(
            _pore_water(p), p.cos_slope, p.liquefaction_pressure, forcing.porosity_source, weight, gained,
            p.mean_excess_pore_pressure,
        )  # fmt: skip
        exchange.steps += 1

    def celerity_squared(self, p, dt: float):
        """Return the part of the squared celerity that is due to the stiffness of the skeleton, shape (n,) [m2 s-2]."""
        if not self.stores_pressure or p.count == 0:
            return NOT_STIFF
        material = self.material
        return stiffen(_pore_water(p), material.solid_density, material.water_density, self.law.stiffness, dt)


def _pore_water(p):
    """Return the `PoreWater` of the particles `p`."""
    return PoreWater(
        phase=p.phase, porosity=p.porosity, thickness=p.thickness, phase_drag=p.phase_drag,
        consolidation=p.consolidation,
    )  # fmt: skip


def _motion(p, velocity):
    """Return the `Motion` of the particles `p` with a `velocity`, shape (3, n) [m s-1]."""
    return Motion(
        velocity=velocity, pull=p.pull, water_pull=p.water_pull, slope_x=p.slope_x, slope_y=p.slope_y,
        cos_slope=p.cos_slope,
    )  # fmt: skip


def _size(vectors):
    return np.sqrt((vectors**2).sum(axis=0))


def _hold_back(velocity, light) -> None:
    """Limit the speed of light particles to that of the fastest particle that is not light, in place.

    Drag acts against the mean of the partners, and a light particle has almost no weight in this mean.
    """
    if light.any():
        speed = _size(velocity)
        fastest = speed[~light].max(initial=0.0)
        velocity[:, light] *= np.minimum(1.0, fastest / np.maximum(speed[light], 1e-300))
