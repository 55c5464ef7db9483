"""The fields of the maps: of the flow now, and of its peaks."""

from typing import NamedTuple

import numpy as np

from ..core.structs import struct


@struct
class CurrentFields(NamedTuple):
    """Fields of the flow now, each of shape (nodes,): means over the particles at a node, weighted by volume.

    Vertical depth [m], speed along the bed [m s-1], excess pore pressure at the base [Pa], basal Péclet number [-].
    """

    depth: np.ndarray
    speed: np.ndarray
    basal_excess_pore_pressure: np.ndarray
    basal_peclet_number: np.ndarray


@struct
class PeakFields(NamedTuple):
    """Fields of the peaks of the flow so far, each of shape (nodes,).

    Largest vertical depth [m], speed [m s-1], pressure ratio at the base [-], basal Péclet number [-]; elapsed time of
    the first arrival [s], -1 where nothing came; largest impact pressure [Pa] and run-up [m].
    """

    max_depth: np.ndarray
    max_speed: np.ndarray
    max_basal_pressure_ratio: np.ndarray
    max_basal_peclet_number: np.ndarray
    arrival_time: np.ndarray
    max_impact_pressure: np.ndarray
    max_run_up: np.ndarray


@struct
class Matter(NamedTuple):
    """Matter of n particles, and its motion; arrays of shape (n,), except the velocity, (3, n).

    Volume [m3], density [kg m-3], phase (MIXTURE or WATER), velocity tangent to the bed [m s-1], elevation of the bed
    [m], of the lowest bed that the particle has come over [m], and vertical depth [m].
    """

    volume: np.ndarray
    density: np.ndarray
    phase: np.ndarray
    velocity: np.ndarray
    z: np.ndarray
    lowest_z: np.ndarray
    depth: np.ndarray


@struct
class Base(NamedTuple):
    """Base of n particles: excess pore pressure [Pa], liquefaction pressure [Pa] and Péclet number [-], each (n,)."""

    pressure: np.ndarray
    liquefaction_pressure: np.ndarray
    peclet_number: np.ndarray


CURRENT, PEAKS = CurrentFields._fields, PeakFields._fields

PHASES = ("solid_depth", "solid_speed", "water_speed")
"""Further fields of a flow of two phases, of grains and water."""

SOLID_FRACTION = "solid_fraction"
"""Further field of columns with dilatancy: volume of grains over that of the flow [-]."""
