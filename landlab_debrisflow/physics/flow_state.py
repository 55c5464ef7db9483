"""The moving mass as a law of flow reads it."""

from typing import Any, NamedTuple

from numpy import ndarray as Array

from ..spatial.packing import Position


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
