"""Interface of the laws of pore-pressure columns: the states they read and write, their methods."""

from enum import IntEnum
from typing import Any, ClassVar, NamedTuple, Protocol

from numpy import ndarray as Array


class BaseContact(IntEnum):
    """Condition at the base of a column; a step is given one of the first three, or INFLOW.

    ================ ==================== ============================ ===========================
    contact          base of the column   pressure of incoming soil    stands for
    ================ ==================== ============================ ===========================
    BY_EROSION       as soil comes in     that of the bed              ERODING (INFLOW if the law's
                                                                       ``bed_contact`` is "flux") while
                                                                       soil comes in, IMPERMEABLE else
    IMPERMEABLE      dp/dy = 0            that of the base: SEALED     itself
    PRESCRIBED       p of the bed         that of the bed              itself
    ERODING          p of the bed         that of the bed              itself
    INFLOW           nothing diffuses in  that of the bed              itself while soil comes in,
                                                                       IMPERMEABLE else
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

    ``profile`` and ``memory`` are in a form of the law's own, so that it may skip updates of a column, or keep another
    representation; a law's ``synchronise`` turns them into pressures. A new column has its pressure at equally spaced
    levels in ``profile``, index 0 at the base and the last at the surface, and zeros in ``memory``; its first
    ``advance``, of 0 seconds, tells it its load.

    Attributes
    ----------
    profile : ndarray, shape (n, levels); excess pore pressure, or the law's own form of it [Pa]
    memory : ndarray, shape (n, memory_size of the law); the law's own numbers
    clipped : ndarray, shape (n,); pressure above liquefaction taken off, times thickness, so far [Pa m]
    solid_fraction : ndarray, shape (n, levels), at the same levels; or None if the law has no dilatancy [-]
    """

    profile: Array
    memory: Array
    clipped: Array
    solid_fraction: Array | None = None

    def copy(self) -> "ColumnState":
        """Return a copy with arrays of its own."""
        return ColumnState(*(None if array is None else array.copy() for array in self))


class DilatantBase(NamedTuple):
    """Debris at the base of n columns of a law with dilatancy; arrays of shape (n,).

    Attributes
    ----------
    dilatancy : ndarray; tan(psi), whose angle psi adds to the friction angle [-]
    fluid_viscosity : ndarray; of the pore fluid, over the mixture: mu (1 - m) [Pa s]
    coefficient_of_consolidation : ndarray; [m2 s-1]
    """

    dilatancy: Array
    fluid_viscosity: Array
    coefficient_of_consolidation: Array


class Shearing(NamedTuple):
    """Shear of n columns in one step, which a law with dilatancy reads.

    Attributes
    ----------
    rate : ndarray, shape (n,); 2 (v - v_b)/h_n [s-1]
    load : ndarray, shape (n,); rho' g_n h_n after the step, with g_n as the curvature of the bed has it [Pa]
    start_solid_fraction : float; of a column that the law is told of for the first time with 0 at its levels [-]
    soil_solid_fraction : float; of the soil that comes in [-]
    solid_density : float; of the grains [kg m-3]
    """

    rate: Array
    load: Array
    start_solid_fraction: float
    soil_solid_fraction: float
    solid_density: float


class ColumnForcing(NamedTuple):
    """Change of n columns in one step of the flow.

    Attributes
    ----------
    volume : ndarray, shape (n,); after the step [m3]
    thickness : ndarray, shape (n,); after the step, slope-normal [m]
    liquefaction_pressure : ndarray, shape (n,); after the step [Pa]
    entrained : ndarray, shape (n,); volume granted by the bed in the step [m3]; > 0 means eroding
    bed_pressure : ndarray, shape (n,) or (1,); of the soil that came in, or of the bed below [Pa]
    base : ndarray, shape (n,) or (1,); BaseContact (int8): BY_EROSION, IMPERMEABLE, PRESCRIBED or INFLOW
    porosity_source : ndarray, shape (n,) or (1,); pressure made by a change of porosity, at all levels [Pa s-1]
    coefficient_of_consolidation : ndarray, shape (n,) or (1,); c_v [m2 s-1]
    water_to_buoyant : float; density of water over buoyant density: lower bound of the pressure ratio [-]
    bounded : bool; whether pressure above liquefaction is taken off, and seen as no less than suction
    shearing : Shearing or None; None unless the law has dilatancy
    """

    volume: Array
    thickness: Array
    liquefaction_pressure: Array
    entrained: Array
    bed_pressure: Array
    base: Array
    porosity_source: Array
    coefficient_of_consolidation: Array
    water_to_buoyant: float
    bounded: bool
    shearing: Shearing | None = None


class ColumnLaw(Protocol):
    """Excess pore pressure under a particle.

    A law whose attribute ``dilatancy`` is not None has also a variable ``solid_fraction`` per level, reads
    `ColumnForcing.shearing`, and has a method ``at_base(memory)`` that returns the `DilatantBase` of columns.
    """

    stores_pressure: ClassVar[bool]  # whether a source of pressure raises the pressure in the column

    @property
    def levels(self) -> int:
        """Number of levels of a column, at least 2."""

    @property
    def memory_size(self) -> int:
        """Number of floats of a column in `ColumnState.memory`."""

    def advance(self, columns: ColumnState, forcing: ColumnForcing, dt: float, basal_pressure: Array) -> None:
        """Advance the `columns` by `dt` [s] in place under a `forcing`; write `basal_pressure`, shape (n,) [Pa]."""

    def synchronise(self, columns: ColumnState, forcing: ColumnForcing) -> None:
        """Turn every profile of `columns` into the pressures at levels now [Pa], in place; `forcing` is the last."""


def is_dilatant(column: Any) -> bool:
    """Return whether the debris of a column law contracts or dilates as it is sheared."""
    return getattr(column, "dilatancy", None) is not None
