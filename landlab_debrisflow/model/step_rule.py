"""Rule for the longest step: bounds by which waves, erosion and the terrain are resolved."""

from typing import NamedTuple

import numpy as np

GROWTH = 0.02
"""Largest part of its volume a particle may take up in a step."""

EVEN, MOST_EVEN = 1.9, 0.95
"""Way in a step where the ground is even, over that where it is not; and its most, over the node spacing: with the
default of half a node a step crosses .95 of one."""

TURN = 0.04
"""Largest turn of the surface on the way of a step, where the ground counts as even, over the nodes that a step may
cross anywhere [rad]: 0.02 rad with the default of half a node."""

LATTICE_FREQUENCY, LATTICE_DAMPING = 1.63, 1.17
"""Angular frequency of the fastest wave on a lattice of particles, and the rate at which a shock viscosity of 1 damps
it, both over celerity / smoothing length (docs/decisions.md, Flow 2)."""


def viscous_share(viscosity: float) -> float:
    """Return the factor on the Courant number for a shock viscosity > 1, which is integrated explicitly [-].

    Damped leapfrog bears x = c dt / l up to (1.63 x)^2/4 + 1.17 viscosity x/2 = 1.

    Examples
    --------
    >>> viscous_share(0.5), viscous_share(1.0), round(viscous_share(10.0), 2)
    (1.0, 1.0, 0.19)
    """

    def limit(strength):
        a, b = 0.25 * LATTICE_FREQUENCY**2, 0.5 * LATTICE_DAMPING * strength
        return (np.sqrt(b * b + 4.0 * a) - b) / (2.0 * a)

    return float(min(1.0, limit(viscosity) / limit(1.0)))


class StepRule(NamedTuple):
    """Rule for the longest step, by the choices of `Numerics` on one raster.

    Attributes
    ----------
    courant_number : float
        Time step over smoothing length / celerity, reduced for the shock viscosity [-].
    way : float
        Way of a particle in a step that is short enough anywhere [m]: a longer one may skip terrain.
    longest_way : float
        Longest way in a step, over even ground far from walls [m].
    turn : float
        Largest turn of the surface on the way of a step over even ground [rad].
    """

    courant_number: float
    way: float
    longest_way: float
    turn: float


def step_rule(numerics, spacing: float) -> StepRule:
    """Return the rule by the choices of `numerics`, a `Numerics`, on nodes whose smaller spacing is `spacing` [m]."""
    nodes = numerics.advective_courant_number
    return StepRule(
        courant_number=numerics.courant_number * viscous_share(numerics.shock_viscosity),
        way=nodes * spacing,
        longest_way=max(nodes, min(EVEN * nodes, MOST_EVEN)) * spacing,
        turn=TURN * nodes,
    )
