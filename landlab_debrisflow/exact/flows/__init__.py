"""Exact solutions of depth-averaged flow on planes and in basins (docs/theory.md#flow-solutions).

Slope-normal form: ``h`` is the thickness across the plane [m], ``x`` points down it [m], ``u`` and ``v`` are
depth-averaged velocities along ``x`` and ``y`` [m s-1]. Angles are in radians, ``slope`` is that of the plane; a
coefficient ``friction`` is the apparent one, ``(rho'/rho) (1 - r) tan(phi)``, which is ``tan(delta)`` where dry. A dam
stands at ``x = 0`` with its reservoir at ``x < 0``; caps start centred at the origin, at rest. Functions of position
broadcast ``x`` and ``y`` and return ``h, u`` in one dimension and ``h, u, v`` in two; velocities are 0 where nothing
flows.
"""

from .basins import basin, thacker_curved, thacker_curved_period, thacker_planar, thacker_planar_period
from .blocks import consolidating_block, eroding_block, sliding_block
from .caps import cap, cap_radius, ridge, ridge_half_width, similarity, similarity_scales
from .dam_breaks import mangeney, mangeney_front, ritter, stoker, stoker_states
from .plane import GRAVITY

__all__ = [
    "GRAVITY",
    "basin",
    "cap",
    "cap_radius",
    "consolidating_block",
    "eroding_block",
    "mangeney",
    "mangeney_front",
    "ridge",
    "ridge_half_width",
    "ritter",
    "similarity",
    "similarity_scales",
    "sliding_block",
    "stoker",
    "stoker_states",
    "thacker_curved",
    "thacker_curved_period",
    "thacker_planar",
    "thacker_planar_period",
]
