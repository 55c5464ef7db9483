"""What a law is given and what it must return.

A law is a frozen dataclass made by `core.parameters.declared` with one array method. It reads the
arrays it is given, writes only those named ``out`` (or named in the docstring), and is composed with
others in Python: no law knows another.
"""

from enum import IntEnum
from typing import Any, ClassVar, NamedTuple, Protocol

from numpy import ndarray as Array


class BasalState(NamedTuple):
    """The base of the flow under each of n particles: what friction and erosion laws read."""

    depth: Array  # (n,) vertical [m]
    thickness: Array  # (n,) slope-normal [m]
    speed: Array  # (n,) along the slope [m s-1]
    normal_gravity: Array  # (n,) with curvature, >= 0 [m s-2]
    effective_normal_stress: Array  # (n,) max(0, rho' g_n h_n - p_b): all that friction must know of pore pressure [Pa]
    liquefaction_pressure: Array  # (n,) rho' g thickness cos(theta), static gravity [Pa]
    excess_pore_pressure: Array  # (n,) at the base [Pa]
    density: Array  # (n,) mixture [kg m-3]
    eroded_depth: Array  # (n,) vertical, taken from the bed in this event, for erosion laws; else (1,) [m]
    gravity: float  # [m s-2]
    slip_ratio: float  # velocity at the base over the mean [-]
    parameters: Any  # NamedTuple of those of the law's parameters that may vary in space, here: (n,) or (1,), SI


class BaseContact(IntEnum):
    """Condition at the base of a column; a step is told one of the first three.

    ================ ==================== ============================ ===========================
    contact          base of the column   pressure of incoming soil    stands for
    ================ ==================== ============================ ===========================
    BY_EROSION       as soil comes in     that of the bed              ERODING (INFLOW if the law's
                                                                       ``bed_contact`` is "flux") while
                                                                       soil comes in, IMPERMEABLE else
    IMPERMEABLE      dp/dy = 0            that of the base: SEALED     itself
    PRESCRIBED       p of the bed         that of the bed              itself
    ERODING          p of the bed         that of the bed              itself
    INFLOW           nothing diffuses in  that of the bed              itself
    SEALED           nothing diffuses in  that of the column's base    itself
    DRAINED          p = 0                0                            PRESCRIBED with 0 Pa
    ================ ==================== ============================ ===========================
    """

    BY_EROSION = 0
    IMPERMEABLE = 1
    PRESCRIBED = 2
    ERODING = 3
    INFLOW = 4
    SEALED = 5
    DRAINED = 6


class ColumnState(NamedTuple):
    """The pore-pressure columns of n particles, written by the column law.

    ``profile`` and ``memory`` are in a form of the law's own, so that it may leave a column alone, or
    keep it in another form, while nothing is missed; a law's ``synchronise`` turns them into pressures.
    A new column has its pressure at equally spaced levels in ``profile``, index 0 at the base and the
    last at the surface, and zeros in ``memory``; its first ``advance``, of 0 seconds, tells it its load.
    """

    profile: Array  # (n, levels) [Pa]
    memory: Array  # (n, memory_size of the law), the law's own
    clipped: Array  # (n,), pressure taken off by the bounds, times thickness, so far [Pa m]


class ColumnForcing(NamedTuple):
    """Change of n columns in one step of the flow; arrays have length n, those marked (1) also 1."""

    volume: Array  # after the step [m3]
    thickness: Array  # after the step, slope-normal [m]
    liquefaction_pressure: Array  # after the step [Pa]
    entrained: Array  # volume granted by the bed in the step [m3]; > 0 means eroding
    bed_pressure: Array  # (1) of the soil that came in, or of the bed below [Pa]
    base: Array  # (1) BaseContact: BY_EROSION, IMPERMEABLE or PRESCRIBED (int8)
    porosity_source: Array  # (1) pressure made by a change of porosity, everywhere in the column [Pa s-1]
    coefficient_of_consolidation: Array  # (1) [m2 s-1]
    water_to_buoyant: float  # density of water over buoyant density: lower bound of the pressure ratio [-]
    bounded: bool  # whether pressure is kept between suction and liquefaction


class FrictionLaw(Protocol):
    """Resistance of the bed."""

    def basal_resistance(self, state: BasalState, yield_stress: Array, drag: Array) -> None:
        """Write the yield stress, which holds a body at rest [Pa], and the other resistance over speed [Pa s m-1].

        Both are >= 0 and finite.
        """


class ErosionLaw(Protocol):
    """How fast the flow asks soil from the bed."""

    def entrainment_rate(self, state: BasalState, out: Array) -> None:
        """Write the erosion rate asked for: bed volume per map area and time [m s-1], >= 0, zero at rest."""


class ColumnLaw(Protocol):
    """Excess pore pressure under a particle."""

    stores_pressure: ClassVar[bool]  # whether a source of pressure raises the pressure in the column

    @property
    def levels(self) -> int:
        """Number of levels of a column, at least 2."""

    @property
    def memory_size(self) -> int:
        """Number of floats of a column in `ColumnState.memory`."""

    def advance(self, columns: ColumnState, forcing: ColumnForcing, dt: float, basal_pressure: Array) -> None:
        """Advance the columns by ``dt`` seconds in place and write the pressure friction feels [Pa]."""

    def synchronise(self, columns: ColumnState, forcing: ColumnForcing) -> None:
        """Bring every profile to the present in place, for output, a change of volume or the end."""


MIXTURE, WATER = 0, 1
"""What a particle is of: grains, with the water between them if the flow law has one phase; or water."""


class MixtureState(NamedTuple):
    """What a flow law with two phases finds of the mixture at each of n particles; written where cells are awake."""

    share: Array  # of the thickness that is of the own phase [-]
    cross_term: Array  # [-]
    mean_pressure: Array  # depth mean of the excess pore pressure, of the grains around, at water only [Pa]


class FlowState(NamedTuple):
    """The moving mass as the flow law sees it, n particles on the surface."""

    x: Array  # map coordinates [m]
    y: Array
    z: Array  # elevation of the bed [m]
    velocity: Array  # (3, n) [m s-1]
    volume: Array  # [m3]
    smoothing_length: Array  # [m]
    longest: Array  # cap of the smoothing length [m]
    thickness: Array  # slope-normal, of the own phase, of the step before [m]
    thickening: Array  # -h div v, of the step before [m s-1]
    gradient_term: Array  # Omega of the grad-h formulation, of the step before [-]
    cos_slope: Array  # [-]
    density: Array  # of the mixture [kg m-3]
    phase: Array  # MIXTURE or WATER (int8)
    share: Array  # of the thickness that is of the own phase, of the step before [-]
    cross_term: Array  # as that of `spatial.across.Across`, of the step before [-]
    mean_pressure: Array  # depth mean of the excess pore pressure [Pa]
    gravity: float  # [m s-2]
    material: Any  # physics.material.Material
    mixture: MixtureState  # of those that are moved, without mirror images


class FlowLaw(Protocol):
    """Inner forces of the flow."""

    def interact(self, state: FlowState, cells, shock_viscosity: float, threads: int, sums):
        """Write, where cells are awake, what neighbours do to each other: `spatial.summation.Sums`.

        That is the thickness and what belongs to it, the acceleration by the flow's own pressure and the
        rate at which converging flow thickens. A law with two phases, one with the methods `drag_coefficient` and
        `coefficient_of_consolidation` of `physics.flow.TwoPhase`, also writes ``state.mixture`` and returns the
        cells of grains and of water.
        """
