"""Interfaces of the laws: the states they read, the arrays they write, their methods.

A law is a frozen dataclass made by `core.parameters.declared` with one array method. It reads the
arrays it is given, writes only those named ``out`` (or named in the docstring), and is composed with
the laws of other kinds in Python: no law knows another.
"""

from typing import Any, ClassVar, NamedTuple, Protocol

import numpy as np
from numpy import ndarray as Array

from ..spatial.packing import Position
from .bed_state import SATURATED_BED, BedState
from .column_contracts import ColumnForcing

NOT_ASKED = np.zeros(1)
"""Value of a state that no law of the kind reads: finding it takes time."""


class BasalStress(NamedTuple):
    """Stresses at the base of the flow under each of n particles.

    Attributes
    ----------
    effective_normal : ndarray, shape (n,); max(0, rho' g_n h_n - p_b), the stress on which friction acts
    [Pa]
    liquefaction : ndarray, shape (n,); rho' g h_n cos(theta), of static gravity g [Pa]
    excess_pore_pressure : ndarray, shape (n,); p_b, above hydrostatic, at the base [Pa]
    shear : ndarray, shape (n,); tau_b, yield stress and drag of the friction law; (1,) for friction laws [Pa]
    """

    effective_normal: Array
    liquefaction: Array
    excess_pore_pressure: Array
    shear: Array = NOT_ASKED


class BasalState(NamedTuple):
    """The base of the flow under each of n particles; friction and erosion laws read it.

    The n particles may be a part of the flow, and several threads may call a law at once, each for another part: a law
    keeps nothing of a call except in its variables.

    Attributes
    ----------
    depth : ndarray, shape (n,); vertical depth of the flow [m]
    thickness : ndarray, shape (n,); h_n, slope-normal [m]
    speed : ndarray, shape (n,); mean over the depth, along the slope [m s-1]
    density : ndarray, shape (n,); of the mixture [kg m-3]
    normal_gravity : ndarray, shape (n,); g_n, with the curvature of the bed, >= 0 [m s-2]
    stress : BasalStress; stresses at the base [Pa]
    eroded_depth : ndarray, shape (n,); vertical, taken from the bed in this event; (1,) for friction laws [m]
    material : Material; densities [kg m-3], porosity [-], gravity [m s-2]
    parameters : object; the law's parameters as attributes, each (n,) or (1,), in SI units (angles in rad)
    variables : object; the law's own variables as attributes, (n,), written in place for the next step
    dilatancy : ndarray, shape (n,), tan(psi) at the base, whose angle psi adds to the friction angle [-]; or None if
    the column law has no dilatancy
    bed : BedState; pore water of the bed, for erosion laws
    """

    depth: Array
    thickness: Array
    speed: Array
    density: Array
    normal_gravity: Array
    stress: BasalStress
    eroded_depth: Array
    material: Any
    parameters: Any
    variables: Any
    dilatancy: Array | None = None
    bed: BedState = SATURATED_BED


class FrictionLaw(Protocol):
    """Resistance of the bed."""

    def basal_resistance(self, state: BasalState, yield_stress: Array, drag: Array) -> None:
        """Write the yield stress, which holds a body at rest [Pa], and the drag, other resistance over speed [Pa s/m].

        Both have shape (n,), are >= 0 and finite; `state` is the base of the flow under n particles.
        """


def is_jump_condition(erosion: Any) -> bool:
    """Return whether the rate of an erosion law is the jump of shear stress across the base; see `ErosionLaw`."""
    return getattr(erosion, "is_jump_condition", False)


class ErosionLaw(Protocol):
    """Rate at which the flow erodes the bed.

    The rate of a law with ``is_jump_condition = True`` is the jump of shear stress across the base, so flow and bed
    have a stress of their own there. The shear stress of the friction law then contains the momentum of the soil that
    comes in, which is not taken from the flow again; and soil brings its own pressure to the column and no more
    (INFLOW). Without that attribute it is False.
    """

    def entrainment_rate(self, state: BasalState, out: Array) -> None:
        """Write the demanded erosion rate into `out`, shape (n,): bed volume per map area and time [m s-1].

        The rate is >= 0, and 0 at rest; `state` is the base of the flow under n particles.
        """


MIXTURE, WATER = 0, 1
"""Phase of a particle: grains, with the water between them if the flow law has one phase; or water."""


class Smoothing(NamedTuple):
    """Smoothing length, its cap [m] and the grad-h term Omega [-] of each of n particles; arrays of shape (n,)."""

    length: Array  # (n,) smoothing length [m]
    longest: Array  # (n,) cap of it [m]
    gradient_term: Array  # (n,) Omega of the grad-h formulation, of the step before [-]


class MixtureState(NamedTuple):
    """Mixture at each of n particles, as a flow law of two phases reads it, with the arrays for its results."""

    phase: Array  # (n,) MIXTURE or WATER (int8)
    share: Array  # (n,) fraction of the thickness that belongs to the own phase, of the step before [-]
    cross_term: Array  # (n,) as that of `spatial.cross_summation.CrossPhaseSums`, of the step before [-]
    mean_pressure: Array  # (n,) depth mean of the excess pore pressure [Pa]
    material: Any  # physics.material.Material
    written: Any  # `MixtureSums` of the moving particles, without ghosts


class MixtureSums(NamedTuple):
    """Results of a flow law of two phases for m particles: own share [-], cross term [-] and mean pressure [Pa], (m,).

    Particles in sleeping cells are left unchanged.
    """

    share: Array  # (m,) fraction of the thickness that belongs to the own phase [-]
    cross_term: Array  # (m,) [-]
    mean_pressure: Array  # (m,) for water only: depth mean of the excess pore pressure of the grains around [Pa]


class FlowState(NamedTuple):
    """The moving mass that a flow law reads: n particles on the surface, ghosts behind walls included.

    Attributes
    ----------
    position : Position; on the surface [m]
    velocity : ndarray, shape (3, n); tangent to the bed [m s-1]
    volume : ndarray, shape (n,); of the particle [m3]
    smoothing : Smoothing; smoothing lengths [m] and their caps
    thickness : ndarray, shape (n,); slope-normal, of the own phase, of the step before [m]
    thickening : ndarray, shape (n,); -h div v, of the step before [m s-1]
    cos_slope : ndarray, shape (n,); cosine of the slope of the bed [-]
    density : ndarray, shape (n,); of the mixture [kg m-3]
    gravity : float; acceleration by gravity [m s-2]
    mixture : MixtureState or None; None in a flow of one phase
    """

    position: Position
    velocity: Array
    volume: Array
    smoothing: Smoothing
    thickness: Array
    thickening: Array
    cos_slope: Array
    density: Array
    gravity: float
    mixture: MixtureState | None


class FlowLaw(Protocol):
    """Inner forces of the flow.

    A law with ``number_of_phases`` 2 has also the methods `drag_coefficient` and `coefficient_of_consolidation` of
    `physics.flow.TwoPhase`; without that attribute there is one phase.
    """

    number_of_phases: ClassVar[int]

    def interact(self, state: FlowState, cells, shock_viscosity: float, threads: int, sums):
        """Write the sums over neighbours (`spatial.summation.Sums`) of particles in cells that are awake.

        The sums are thickness, smoothing length and gradient term, the acceleration by the flow's own pressure, and the
        convergence, of the n particles of `state` in a cell list `cells`. The shock viscosity has no unit. A law with
        two phases also writes ``state.mixture.written`` and returns the cells of grains and of water.
        """


class Phases(Protocol):
    """Stages of a step that depend on the number of phases (model/phases).

    `particles` are all particles, `which` some n, `exchange` is the state of the exchange between grains and water.
    """

    variables: tuple  # `Variable`s beyond those of every flow
    phase_fractions: tuple  # phase and volume fraction of each kind of particle that a volume is divided into
    solid_fraction: float  # of the soil: volume that the eroding particle keeps, the grains of two phases, all of one
    sleeps: bool  # whether particles at rest may sleep

    def bearing(self, particles) -> slice:
        """Return the places of the particles that bear on the bed: friction and columns are computed for them alone."""

    def density(self, particles) -> Array:
        """Return the intrinsic density of each particle's phase, shape (n,) [kg m-3]."""

    def solid_volume(self, particles) -> Array:
        """Return the volume of the grains in each particle, shape (n,) [m3]."""

    def coefficient_of_consolidation(self, particles, which: slice) -> Array:
        """Return the coefficient of consolidation of some columns, as long as they are many or of length 1 [m2 s-1]."""

    def after_summation(self, particles, exchange, cells) -> None:
        """Write thickness and mixture of the particles from sums over neighbours; `cells` has a cell list per phase."""

    def kick(self, particles, exchange, velocity, yield_stress, drag, rest_speed, dt: float, threads: int = 1) -> None:
        """Change `velocity`, (3, n) [m s-1], of particles awake by all forces along the bed in `dt` [s]."""

    def held_at_rest(self, particles, exchange, which: slice, yield_stress, drag, walls) -> Array:
        """Return whether friction (yield stress [Pa], drag [Pa s m-1]) and walls would hold `which` at rest, (n,)."""

    def limit_entrainment(self, exchange, rate) -> None:
        """Set the erosion rate to 0, in place, where no particle could take the water of the soil."""

    def share_entrained(self, particles, exchange) -> None:
        """Give to other particles the volume of entrained soil that the eroding particle does not keep."""

    def column_forcing(self, particles, forcing: ColumnForcing, prescribed, dt: float) -> ColumnForcing:
        """Return `forcing` with the source by a change of porosity in `dt` [s], not at `prescribed` places [Pa s-1]."""

    def update_mean_pressure(self, particles, exchange, forcing: ColumnForcing, profiles, dt: float) -> None:
        """Update the mean pore pressure [Pa] by `forcing` in `dt` [s]; `profiles()` gives columns at levels [Pa]."""

    def celerity_squared(self, particles, dt: float) -> Array:
        """Return the part of the squared celerity that is not due to weight, (n,) or (1,) [m2 s-2]."""
