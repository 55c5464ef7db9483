"""Doubts about the coefficient of consolidation of an event: pressure is gone at once, or a default decides."""

from collections.abc import Iterator

import numpy as np
from scipy.ndimage import label

from ..physics.column.consolidating import Consolidating
from ..physics.column.diagnostics import consolidation_time
from ..physics.column_contracts import is_dilatant
from ..physics.erosion import NoErosion
from ..physics.material import Material
from ..physics.scales import runout_thickness, sliding_time
from .fill_values import elevation_range

FASTEST_CONSOLIDATION = 10.0  # [m2 s-1]
FILM = 0.01  # thickness of a release of which nothing is expected [m]
GONE = 1.0  # c_v t/h2 at which the base of a column has lost 93 % of its pressure [-]
HALVED = 0.2  # c_v t/h2 at which it has lost half [-]
BEGINNING = 0.1  # of an event: time in which a body goes 1 % of its way [-]
BED_RATIO = "bed__excess_pore_pressure_ratio"


def consolidation_doubts(grid, setup, release) -> Iterator[str]:
    """Yield a doubt if pressure is gone at once, or if the default c_v decides where a thin flow stops.

    Pressure that a wet bed renews is not gone. Pressure that stays is not doubted: the default c_v is that of a large
    muddy event, in which pressure stays. In a flow of decimetres this default neither keeps the pressure nor
    lets it go.

    `grid` is the RasterModelGrid, `setup` the `Setup`, `release` a `Release`.
    """
    material, column = setup.material, setup.column
    consolidates = isinstance(column, Consolidating) and not is_dilatant(column)
    if not consolidates or setup.two_phases or release.nodes.size == 0 or material.bearing_density == 0.0:
        return
    c_v, depth = material.coefficient_of_consolidation, release.depth
    thickness = float(np.sum(depth**2) / np.sum(depth))  # of the ground below most of the mass
    if thickness < FILM:
        return
    fall = float(grid.at_node["topographic__elevation"][release.nodes].max()) - elevation_range(grid)[0]
    event = sliding_time(fall, material.gravity)
    thin = min(thickness, runout_thickness(_largest_volume(grid, release.nodes, depth)))
    time, thin_time = (float(consolidation_time(h, c_v)) for h in (thickness, thin))
    times = (
        f"in a release {thickness:.2g} m thick excess pore pressure drains within h2/c_v = {time:.2g} s, a fall of "
        f"{fall:.3g} m takes some {event:.2g} s"
    )
    recipe = (
        "give c_v of your debris, or coefficient_of_consolidation={'permeability': ..., 'pore_fluid_viscosity': ..., "
        "'stiffness': ...}"
    )
    gone = GONE * time < BEGINNING * event and material.initial_pressure_ratio > 0.0
    if gone and c_v <= FASTEST_CONSOLIDATION and not _wet_bed(grid, setup, release):  # above, the unit is doubted
        yield (
            f"material: coefficient_of_consolidation is {c_v:.2g} m2 s-1: {times}. The pressure of the start is gone "
            "before the release has moved far, whatever initial_pressure_ratio is. Was c_v meant in cm2/s? For a flow "
            f"without excess pore pressure take column='none'; else {recipe}"
        )
    elif c_v == Material.coefficient_of_consolidation and HALVED * thin_time < event:
        yield (
            f"material: coefficient_of_consolidation is {c_v:g} m2 s-1, the default, for debris metres thick: {times}. "
            f"The pressure of the start stays at first; spread to {thin:.2g} m, as flows of this volume are at their "
            f"end, it drains within {thin_time:.2g} s: where the flow stops depends on c_v, which is orders "
            f"of magnitude larger in sand and gravel than in mud; {recipe}"
        )


def _wet_bed(grid, setup, release) -> bool:
    """Return whether soil beside the release may erode and keep a pressure at the base of the flow."""
    if isinstance(setup.erosion, NoErosion) or "soil__depth" not in grid.at_node:
        return False
    wet = np.asarray(grid.at_node["soil__depth"]) > 0.0
    wet[release.nodes] = False
    if BED_RATIO in grid.at_node:
        wet &= np.asarray(grid.at_node[BED_RATIO]) > 0.0
    elif setup.material.bed_loading_coefficient == 0.0 and setup.material.bed_pressure_ratio == 0.0:
        return False
    return bool(wet.any())


def _largest_volume(grid, nodes, depth) -> float:
    """Return the volume of the largest of the sites that fail [m3]; `depth` [m] fails at some nodes."""
    rows, columns = np.unravel_index(nodes, grid.shape)
    rows, columns = rows - rows.min(), columns - columns.min()
    failing = np.zeros((rows.max() + 1, columns.max() + 1))
    failing[rows, columns] = depth
    sites, _ = label(failing > 0.0, np.ones((3, 3)))
    return float(np.bincount(sites.ravel(), failing.ravel()).max()) * grid.dx * grid.dy
