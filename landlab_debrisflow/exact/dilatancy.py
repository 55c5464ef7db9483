"""Closed forms of debris that contracts or dilates as it is sheared (docs/theory.md#dilatancy), and a sliding block.

Units are SI. Arguments have the names of the parameters of `laws.Dilatancy`; stresses are effective stresses of one
level, its load less its excess pore pressure.
"""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from scipy.integrate import solve_ivp

from .flows.plane import GRAVITY

__all__ = [
    "DilatantDebris",
    "dilatant_block",
    "drained_solid_fraction",
    "equilibrium_solid_fraction",
    "equilibrium_stress",
    "liquefaction_strain",
    "stress_after_strain",
]


class DilatantDebris(NamedTuple):
    """Debris of the closed forms; the defaults are those of the laws.

    Attributes
    ----------
    critical_solid_fraction : float
        m_crit [-].
    pore_fluid_viscosity : float
        mu [Pa s].
    grain_diameter : float
        delta [m].
    solid_density : float
        rho_s [kg m-3].
    compressibility : float
        a [-].
    reference_stress : float
        sigma_0 [Pa].
    """

    critical_solid_fraction: float = 0.64
    pore_fluid_viscosity: float = 0.005
    grain_diameter: float = 0.001
    solid_density: float = 2650.0
    compressibility: float = 0.017
    reference_stress: float = 1000.0


USUAL = DilatantDebris()
STEEPEST = np.radians(89.0)


def equilibrium_solid_fraction(stress: ArrayLike, shear_rate: ArrayLike, debris: DilatantDebris = USUAL) -> np.ndarray:
    """Return m_eq = m_crit/(1 + sqrt(N)) [-], to which shear drives debris.

    Parameters
    ----------
    stress : array_like
        Effective stress, >= 0 [Pa].
    shear_rate : array_like
        Shear rate, >= 0 [s-1].
    debris : DilatantDebris

    Returns
    -------
    ndarray
        Solid fraction [-]; at rest without stress the critical one.

    References
    ----------
    Iverson & George (2014).

    Examples
    --------
    >>> equilibrium_solid_fraction([0.0, 100.0, 1e4], 10.0).round(4)
    array([0.4462, 0.626 , 0.6386])
    """
    rate = np.asarray(shear_rate, dtype=float)
    resisting = debris.solid_density * (rate * debris.grain_diameter) ** 2 + np.asarray(stress, dtype=float)
    viscous, resisting = np.broadcast_arrays(debris.pore_fluid_viscosity * rate, resisting)
    number = np.divide(viscous, resisting, out=np.where(viscous > 0.0, np.inf, 0.0), where=resisting > 0.0)
    return debris.critical_solid_fraction / (1.0 + np.sqrt(number))


def equilibrium_stress(solid_fraction: ArrayLike, shear_rate: ArrayLike, debris: DilatantDebris = USUAL) -> np.ndarray:
    """Return the effective stress to which steady shear drives debris that does not drain [Pa].

    ``mu gd/(m_crit/m - 1)^2 - rho_s gd^2 delta^2``, at which m is the equilibrium solid fraction.

    Parameters
    ----------
    solid_fraction : array_like
        m [-].
    shear_rate : array_like
        gd, > 0 [s-1].
    debris : DilatantDebris

    Returns
    -------
    ndarray
        [Pa]; 0 where grains stay liquefied, inf for m >= m_crit, which dilates until suction is at its bound.

    References
    ----------
    Iverson & George (2014), eqs. 3.10 to 4.16.

    Examples
    --------
    >>> equilibrium_stress([0.58, 0.6, 0.62, 0.66], 20.0).round(2)
    array([ 8.28, 21.44, 95.04,   inf])
    """
    rate, fraction = np.broadcast_arrays(np.asarray(shear_rate, float), np.asarray(solid_fraction, float))
    gap = np.maximum(debris.critical_solid_fraction / fraction - 1.0, 0.0)
    viscous = np.divide(debris.pore_fluid_viscosity * rate, gap**2, out=np.full(gap.shape, np.inf), where=gap > 0.0)
    return np.maximum(viscous - debris.solid_density * (rate * debris.grain_diameter) ** 2, 0.0)


def stress_after_strain(
    strain: ArrayLike, stress: float, solid_fraction: float, debris: DilatantDebris = USUAL
) -> np.ndarray:
    """Return the effective stress after a shear strain, without drainage and with a fluid of no viscosity [Pa].

    ``sigma' + sigma_0`` falls by a factor e per ``a/(m (m_crit - m))`` of strain, until the debris is liquefied; it
    rises if m > m_crit.

    Parameters
    ----------
    strain : array_like
        Shear strain, the integral of the shear rate [-].
    stress : float
        Effective stress at the start [Pa].
    solid_fraction : float
        m [-].
    debris : DilatantDebris

    Returns
    -------
    ndarray
        [Pa], >= 0; suction has no bound here.

    Examples
    --------
    >>> stress_after_strain([0.0, 1.0, 4.0], 5000.0, 0.62).round()
    array([5000., 1893.,    0.])
    """
    rate = solid_fraction * (debris.critical_solid_fraction - solid_fraction) / debris.compressibility
    moved = (stress + debris.reference_stress) * np.exp(-rate * np.asarray(strain, dtype=float))
    return np.maximum(moved - debris.reference_stress, 0.0)


def liquefaction_strain(stress: ArrayLike, solid_fraction: ArrayLike, debris: DilatantDebris = USUAL) -> np.ndarray:
    """Return the shear strain that liquefies debris, without drainage and with a fluid of no viscosity [-].

    Parameters
    ----------
    stress : array_like
        Effective stress at the start [Pa].
    solid_fraction : array_like
        m [-].
    debris : DilatantDebris

    Returns
    -------
    ndarray
        Shear strain, ``a ln(1 + sigma'/sigma_0)/(m (m_crit - m))`` [-]; inf for m >= m_crit.

    Examples
    --------
    Debris half a metre thick that is sheared at 2 v/h has moved by 0.6 m when it is liquefied.

    >>> float(liquefaction_strain(5000.0, 0.62).round(2)), float(liquefaction_strain(5000.0, 0.65))
    (2.46, inf)
    """
    fraction = np.asarray(solid_fraction, dtype=float)
    contraction = np.maximum(fraction * (debris.critical_solid_fraction - fraction), 0.0)
    gain = debris.compressibility * np.log1p(np.asarray(stress, dtype=float) / debris.reference_stress)
    gain, contraction = np.broadcast_arrays(gain, contraction)
    return np.divide(gain, contraction, out=np.where(gain > 0.0, np.inf, 0.0), where=contraction > 0.0)


def drained_solid_fraction(
    strain: ArrayLike, solid_fraction: float, critical_solid_fraction: float = 0.64
) -> np.ndarray:
    """Return the solid fraction of debris that drains freely, after slow shear [-].

    ``dm/dG = -m (m - m_crit)``, G being the shear strain.

    Parameters
    ----------
    strain : array_like
        Shear strain [-].
    solid_fraction : float
        m at the start [-].
    critical_solid_fraction : float
        m_crit [-].

    Returns
    -------
    ndarray
        Solid fraction [-].

    Examples
    --------
    >>> drained_solid_fraction([0.0, 1.0, 10.0], 0.6).round(4)
    array([0.6   , 0.6183, 0.6399])
    """
    decay = np.exp(-critical_solid_fraction * np.asarray(strain, dtype=float))
    return critical_solid_fraction / (1.0 - (1.0 - critical_solid_fraction / solid_fraction) * decay)


def dilatant_block(
    time: ArrayLike, slope: float, thickness: float, solid_fraction: float, friction_angle: float,
    drained: bool = False, debris: DilatantDebris = USUAL, water_density: float = 1000.0, gravity: float = GRAVITY,
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:  # fmt: skip
    """Return velocity, stress and solid fraction of a slab that starts from rest and makes its own pore pressure.

    ``rho h dv/dt = rho g h sin(slope) - sigma' tan(phi + psi) - 2 mu (1 - m) v/h``. The shear rate is ``2 v/h``,
    ``tan(psi) = m - m_eq``, and pore water is hydrostatic at the start. Either no water moves, so that
    ``d ln(sigma' + sigma_0)/dt = m gd (m - m_eq)/a`` between liquefaction and the suction of water without pressure;
    or it moves freely, so that the stress stays and ``dm/dt = -m gd (m - m_eq)``. The two are ordinary differential
    equations, solved with a relative error of 1e-9.

    Parameters
    ----------
    time : array_like
        Times since the start, increasing [s].
    slope : float
        Slope of the plane [rad].
    thickness : float
        h, slope-normal [m].
    solid_fraction : float
        m at the start; the densities of the slab stay those of the start [-].
    friction_angle : float
        phi [rad].
    drained : bool
        Whether water moves freely, or not at all.
    debris : DilatantDebris
    water_density : float
        Density of the pore fluid [kg m-3].
    gravity : float
        Acceleration by gravity [m s-2].

    Returns
    -------
    velocity, stress, solid_fraction : ndarray, shape of `time`
        Velocity [m s-1], effective stress [Pa] and solid fraction [-] at the base.

    References
    ----------
    Iverson & George (2014).

    Examples
    --------
    On 31 degrees loose debris runs away, dense debris starts and locks.

    >>> angle = np.radians(40.7)
    >>> for m in (0.62, 0.66):
    ...     velocity, stress, _ = dilatant_block([0.5, 1.0], np.radians(31.0), 0.5, m, angle)
    ...     print(velocity.round(3), stress.round(0))
    [1.135 3.472] [1773.   65.]
    [0.237 0.   ] [6636. 7382.]
    """
    density = solid_fraction * debris.solid_density + (1.0 - solid_fraction) * water_density
    normal = gravity * thickness * np.cos(slope)
    load, most = (density - water_density) * normal, density * normal

    def rates(_, state):
        speed, moved = max(state[0], 0.0), state[1]
        stress, fraction = (load, moved) if drained else (np.clip(moved, 0.0, most), solid_fraction)
        shear = 2.0 * speed / thickness
        dilation = fraction - float(equilibrium_solid_fraction(stress, shear, debris))
        friction = stress * np.tan(min(friction_angle + np.arctan(dilation), STEEPEST))
        friction += 2.0 * debris.pore_fluid_viscosity * (1.0 - fraction) * speed / thickness
        acceleration = gravity * np.sin(slope) - friction / (density * thickness)
        change = fraction * shear * dilation
        if drained:
            return acceleration, -change
        change *= (stress + debris.reference_stress) / debris.compressibility
        at_bound = (moved <= 0.0 and change < 0.0) or (moved >= most and change > 0.0)
        return acceleration, 0.0 if at_bound else change

    stops: Any = lambda _, state: state[0]  # noqa: E731
    stops.terminal, stops.direction = True, -1.0
    time, start = np.asarray(time, dtype=float), (0.0, solid_fraction if drained else load)
    if rates(0.0, start)[0] <= 0.0 or not time.any():
        velocity, moved = np.zeros(time.shape), np.full(time.shape, start[1])
    else:
        found = solve_ivp(
            rates, (0.0, time.max()), start, "LSODA", dense_output=True, events=stops, rtol=1e-9, atol=1e-9
        )  # fmt: skip
        velocity, moved = found.sol(np.minimum(time, found.t[-1]).ravel()).reshape(2, *time.shape)
        if found.t_events[0].size:
            velocity = np.where(time < found.t[-1], velocity, 0.0)
    same = np.full(time.shape, load if drained else solid_fraction)
    return (velocity, same, moved) if drained else (velocity, np.clip(moved, 0.0, most), same)
