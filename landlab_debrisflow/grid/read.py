"""Fields of a grid, checked, as plain arrays: the only part of a grid that the model gets.

Arrays over nodes share the memory of the fields, so that erosion and deposit appear in them without a copy of the
raster. No field is written here.
"""

import logging
from typing import NamedTuple

import numpy as np

from ..core.parameters import on_nodes
from ..spatial.raster import CORE
from . import checks, doubts, elevation_checks
from .consolidation import consolidation_doubts
from .inflow_lines import check_lines
from .release import NO_RELEASE, Release, read_release

log = logging.getLogger("landlab_debrisflow")

BED_PRESSURE = "bed__excess_pore_pressure"


class Terrain(NamedTuple):
    """Shape of the ground.

    Attributes
    ----------
    elevation : ndarray, shape (nodes,)
        Elevation of the ground [m].
    status : ndarray of uint8, shape (nodes,)
        As Landlab numbers node statuses.
    shape : tuple of int
        Rows and columns.
    spacing : tuple of float
        dx, dy [m].
    lower_left : tuple of float
        Map coordinates of the first node [m].
    changed : bool
        Whether elevation or status have changed since the last call, other than by the release.
    """

    elevation: np.ndarray
    status: np.ndarray
    shape: tuple
    spacing: tuple
    lower_left: tuple
    changed: bool

    @property
    def core(self):
        """Nodes that may hold material, ndarray of bool, shape (nodes,)."""
        return self.status == CORE


class Soil(NamedTuple):
    """State of the ground below the flow; each may be None: not given.

    Attributes
    ----------
    depth : ndarray, shape (nodes,), or None
        Erodible depth [m].
    pressure_ratio : ndarray, shape (nodes,), or None
        Excess pore pressure over its liquefaction value [-].
    pressure : ndarray, shape (nodes,), or None
        Excess pore pressure that follows the load [Pa].
    drained : ndarray of bool, shape (nodes,), or None
        Where a drain holds the excess pore pressure at 0.
    saturation : ndarray, shape (nodes,), or None
        Degree of saturation of the pores with water [-].
    """

    depth: np.ndarray | None
    pressure_ratio: np.ndarray | None
    pressure: np.ndarray | None
    drained: np.ndarray | None
    saturation: np.ndarray | None


class GridInput(NamedTuple):
    """Input of one call.

    Attributes
    ----------
    terrain : Terrain
        Elevation, statuses and shape of the raster.
    soil : Soil
        State of the ground below the flow.
    release : Release
        Ground that is about to fail.
    parameters : dict
        NamedTuple of arrays, (nodes,) or (1,), in SI units, by kind of law.
    new_event : bool
        Whether nothing was moving and nothing had yet to flow in.
    warned : tuple of str
        Kinds of doubt that have been logged so far.
    """

    terrain: Terrain
    soil: Soil
    release: Release
    parameters: dict
    new_event: bool
    warned: tuple


class GridReader:
    """Reads the fields of a grid at the beginning of each call.

    Parameters
    ----------
    grid : RasterModelGrid
        Gets the field of the bed's pore pressure if the material asks for it and it is missing.
    setup : Setup
        Laws, material and numerics.
    """

    def __init__(self, grid, setup):
        self._grid, self._setup = grid, setup
        self._loaded = setup.material.bed_loading_coefficient > 0.0
        if self._loaded and BED_PRESSURE not in grid.at_node:
            grid.add_zeros(BED_PRESSURE, at="node", units="Pa")
        self.laws = {kind: getattr(setup, kind) for kind in ("friction", "erosion")}
        checks.check_parameters(grid, self.laws)

    def read(self, grid_bed, inflow, carried: bool, warned: tuple, with_release: bool = True) -> GridInput:
        """Read and check all fields.

        Parameters
        ----------
        grid_bed : GridBed
            Terrain as the last call left it.
        inflow : Inflow
            Inflow to come.
        carried : bool
            Whether the model carries particles.
        warned : tuple of str
            Kinds of doubt not to be logged again.
        with_release : bool
            Whether to read the release.

        Raises
        ------
        InputError
            If a value is not usable.
        """
        grid, new_event = self._grid, not carried and inflow.over
        checks.check_types(grid)
        terrain = self._read_terrain(grid_bed)
        soil = self._read_soil()
        checks.check_parameters(grid, self.laws)
        parameters = {kind: on_nodes(law, grid.at_node) for kind, law in self.laws.items()}
        check_lines(terrain, inflow)
        release = read_release(grid, soil.depth) if with_release else NO_RELEASE
        if terrain.changed and grid_bed.is_below(release, terrain.elevation, terrain.status):
            terrain = terrain._replace(changed=False)
        warned += self._warn(release, soil, new_event, warned)
        return GridInput(terrain, soil, release, parameters, new_event, warned)

    def read_again(self, status, drained):
        """Return terrain, soil and parameters of laws for a call that has begun, or was the last one, unchecked.

        Parameters
        ----------
        status : ndarray of uint8, shape (nodes,)
            Node statuses of the call.
        drained : ndarray of bool, shape (nodes,), or None
            Drains of the call.

        Returns
        -------
        Terrain, Soil, dict
        """
        terrain = self._terrain(self._field("topographic__elevation"), status)
        parameters = {kind: on_nodes(law, self._grid.at_node) for kind, law in self.laws.items()}
        return terrain, self._soil()._replace(drained=drained), parameters

    def _read_terrain(self, grid_bed) -> Terrain:
        grid, elevation = self._grid, self._field("topographic__elevation")
        status = np.array(grid.status_at_node)
        changed = not grid_bed.matches(elevation, status)
        if changed:
            checks.check_boundaries(grid)
            elevation_checks.check_elevation(grid, elevation)
        return self._terrain(elevation, status, changed)

    def _terrain(self, elevation, status, changed: bool = False) -> Terrain:
        grid = self._grid
        shape, spacing = tuple(map(int, grid.shape)), (float(grid.dx), float(grid.dy))
        return Terrain(elevation, status, shape, spacing, tuple(map(float, grid.xy_of_lower_left)), changed)

    def _read_soil(self) -> Soil:
        soil = self._soil()
        checks.check_bed(self._grid, soil.depth, soil.pressure_ratio, soil.drained, soil.saturation)
        if self._loaded:
            checks.check_loaded_bed(self._grid, soil.pressure_ratio, soil.pressure)
        return soil._replace(drained=None if soil.drained is None else soil.drained > 0.0)

    def _soil(self) -> Soil:
        """Return the fields of the ground, unchecked; `drained` as numbers."""
        pressure = self._field(BED_PRESSURE) if self._loaded else None
        ratio, drained = self._field("bed__excess_pore_pressure_ratio"), self._field("bed__drained")
        return Soil(self._field("soil__depth"), ratio, pressure, drained, self._field("bed__degree_of_saturation"))

    def _field(self, name):
        """Return the values of a field, sharing its memory, or None if the grid lacks the field."""
        return np.asarray(self._grid.at_node[name]) if name in self._grid.at_node else None

    def _warn(self, release, soil, new_event, warned) -> tuple:
        """Log doubts about the release that were not logged before; return the kinds of doubt logged.

        `release` is a `Release`, `soil` a `Soil`; `new_event` tells whether nothing moves; `warned` are the kinds
        logged before, "depth", "velocity", "consolidation" and "nothing".
        """
        logged = ()
        found = {
            "depth": doubts.release_doubts(self._grid, release.nodes, release.depth),
            "velocity": doubts.velocity_doubts(release.velocity),
            "consolidation": consolidation_doubts(self._grid, self._setup, release),
        }
        for kind, sentences in found.items():
            for doubt in () if kind in warned else sentences:
                log.warning("%s", doubt)
                logged += (kind,)
        if release.nodes.size == 0 and new_event and "nothing" not in warned:
            reason = doubts.missing_release_reason(self._grid, soil.depth)
            log.warning("nothing to do: no value > 0 in debris_flow__release_depth and nothing moving%s", reason)
            logged += ("nothing",)
        return logged
