"""Triggers: landslides of other components, written into the release field of the grid that `DebrisFlow` reads.

Landlab's `LandslideProbability` says where soil is likely to fail, its `BedrockLandslider` which slopes fail and along
which plane. Both functions here fill ``debris_flow__release_depth``; the next call of `DebrisFlow` takes the release
off the ground. Several triggers may precede one call: the larger depth counts at every node.
"""

from numbers import Real
from typing import Any

import numpy as np
from landlab import RasterModelGrid
from scipy import ndimage

from .core.checks import in_range, require
from .core.errors import InputError
from .core.hints import did_you_mean, give_number, python_value
from .grid.checks import where
from .grid.fill_values import is_fill
from .grid.release import RELEASE_DEPTH
from .spatial.raster import CORE

__all__ = ["release_bedrock_landslides", "release_probable_sites"]

ELEVATION, SOIL, ROCK = "topographic__elevation", "soil__depth", "bedrock__elevation"
PROBABILITY = "landslide__probability_of_failure"
EROSION = "landslide__erosion"
RUNOUT = ("landslide__deposition", "LS_sediment__flux", "landslide_sediment_point_source")
"""Fields of BedrockLandslider about the run-out of the ground that failed."""


def release_probable_sites(
    grid: RasterModelGrid,
    probability: Any = PROBABILITY,
    *,
    threshold: float = 0.5,
    depth: Any = None,
    least_area: float = 0.0,
    seed: int | np.random.Generator | None = None,
) -> float:
    """Release sites whose probability of failure [-] is high enough: all sites, or sites drawn at random.

    A site is a group of core nodes at or above the threshold that touch along a side, with ground to release. When
    sites are drawn, each fails as a whole, with the mean probability of its nodes: the area that is expected to fail is
    then the one that the map of probabilities promises, however strongly neighbours depend on each other.

    Parameters
    ----------
    grid : RasterModelGrid
        Its field ``debris_flow__release_depth`` [m] is filled, and added if there is none.
    probability : str or array_like, shape (nodes,) or (rows, columns)
        Name of a field at nodes or the values, from 0 to 1 at core nodes [-]; a mask will do, too. By default the
        field that Landlab's LandslideProbability writes: the probability of failure in a year, if its recharge is that
        of yearly maxima. In `n` years it is ``1 - (1 - probability)**n``.
    threshold : float
        Least probability of a node of a site, above 0 and up to 1 [-].
    depth : float, str or array_like, optional
        Thickness that fails [m], as a number, the name of a field or values at nodes; the whole soil by default. It is
        limited to the field ``soil__depth`` if the grid has it.
    least_area : float
        Map area of the smallest site that fails [m2].
    seed : int or numpy.random.Generator, optional
        Draw the sites that fail with this generator, or one that is made of this number. In a loop pass a generator,
        because a number draws the same again. By default all sites fail.

    Returns
    -------
    float
        Volume that fails, with the earlier content of the release field [m3].

    Raises
    ------
    InputError
        If a field is missing or a value is not usable; nothing was changed.

    References
    ----------
    Strauch et al. (2018), https://doi.org/10.5194/esurf-6-49-2018: the map of probabilities.

    Examples
    --------
    >>> import numpy as np
    >>> from landlab import RasterModelGrid
    >>> from landlab_debrisflow.triggers import release_probable_sites
    >>> grid = RasterModelGrid((5, 7), xy_spacing=10.0)
    >>> soil = grid.add_full("soil__depth", 0.8, at="node")
    >>> probability = grid.add_zeros("landslide__probability_of_failure", at="node")
    >>> probability.reshape(grid.shape)[1:3, 1:3] = 0.9
    >>> probability.reshape(grid.shape)[3, 5] = 0.7
    >>> release_probable_sites(grid, least_area=200.0, depth=1.0)
    320.0
    >>> grid.at_node["debris_flow__release_depth"].reshape(grid.shape)[1:4]
    array([[0. , 0.8, 0.8, 0. , 0. , 0. , 0. ],
           [0. , 0.8, 0.8, 0. , 0. , 0. , 0. ],
           [0. , 0. , 0. , 0. , 0. , 0. , 0. ]])
    """
    core = _core(grid)
    remedy = f"; run LandslideProbability first, or name another field: the grid has {_names(grid)}"
    likely = _at_nodes(grid, "probability", probability, remedy)
    place = _places(grid)
    in_range("probability", likely, 0.0, 1.0, "-", place, ignored=~core, form="g", error=InputError)
    threshold = _number("threshold", threshold, 0.0, 1.0, "-", open_ends=(True, False))
    least_area = _number("least_area", least_area, 0.0, np.inf, "m2")
    failing = _depth_to_release(grid, depth, core)
    sites, count = ndimage.label(((likely >= threshold) & core & (failing > 0.0)).reshape(grid.shape))
    sites, numbers = sites.ravel(), np.arange(1, count + 1)
    fails = np.bincount(sites, minlength=count + 1)[1:] * (grid.dx * grid.dy) >= least_area
    if seed is not None:
        fails &= _generator(seed).random(count) < ndimage.mean(likely, sites, numbers)
    return _fill(grid, np.where(np.concatenate(([False], fails))[sites], failing, 0.0))


def release_bedrock_landslides(landslider: Any, dt: float, *, porosity: float = 0.0) -> float:
    """Release the landslides [m] of a step of Landlab's BedrockLandslider, whose own run-out is taken back.

    The component is run for a step. The ground is then put back to what it was, rock that fails is turned into soil,
    and the depth that fails goes into the release field. Nothing of the run-out of BedrockLandslider is left, neither
    deposits nor fluxes: the run-out is that of the flow. The release has all ground that fails, fines included.
    Boundary nodes are not released. ``landslide__erosion`` stays as the component has written it: where landslides
    overlap it holds the last one, while the release has all of them.

    Parameters
    ----------
    landslider : BedrockLandslider
        Built on the grid of the flow, its inputs up to date. The failed volumes are in its ``landslides_volume``.
    dt : float
        Duration of the step, in the unit of its return time.
    porosity : float
        Pores in the soil that rock turns into, below 1 [-]: a volume V of rock becomes V / (1 - porosity) of debris,
        and that is the volume which is released.

    Returns
    -------
    float
        Volume that fails, with the earlier content of the release field [m3].

    Raises
    ------
    InputError
        If this is no BedrockLandslider, or an argument is not usable; nothing was changed.
    Exception
        What the component raises; elevation, soil and bedrock are as they were before.

    References
    ----------
    Campforts et al. (2020), https://doi.org/10.5194/gmd-13-3863-2020: where slopes fail, and along which plane.

    Examples
    --------
    >>> from landlab import RasterModelGrid
    >>> from landlab.components import BedrockLandslider, PriorityFloodFlowRouter
    >>> from landlab_debrisflow.triggers import release_bedrock_landslides
    >>> grid = RasterModelGrid((5, 5), xy_spacing=10.0)
    >>> z = grid.add_full("topographic__elevation", 100.0, at="node")
    >>> soil = grid.add_full("soil__depth", 1.0, at="node")
    >>> z[2] = 80.0
    >>> router = PriorityFloodFlowRouter(grid, separate_hill_flow=True, suppress_out=True)
    >>> landslider = BedrockLandslider(grid, landslides_return_time=1.0)
    >>> router.run_one_step()
    >>> round(release_bedrock_landslides(landslider, dt=10.0), 6)  # cut back from a slope of 2 to one of 1.5
    500.0
    >>> [float(field[7]) for field in (z, soil, grid.at_node["debris_flow__release_depth"])]  # four metres were rock
    [100.0, 5.0, 5.0]
    """
    grid = getattr(landslider, "grid", None)
    if not isinstance(grid, RasterModelGrid) or not callable(getattr(landslider, "run_one_step", None)):
        raise InputError(f"landslider must be a BedrockLandslider, got {landslider!r}")
    if missing := [name for name in (ELEVATION, SOIL, ROCK, EROSION, RUNOUT[0]) if name not in grid.at_node]:
        raise InputError(
            f"landslider must be a BedrockLandslider, got {type(landslider).__name__}, and its grid has no "
            f"{', '.join(missing)}"
        )
    core = _core(grid)
    dt = _number("dt", dt, 0.0, np.inf, "-", open_ends=(True, True))
    porosity = _number("porosity", porosity, 0.0, 1.0, "-", open_ends=(False, True))
    at = grid.at_node
    ground = {name: at[name].copy() for name in (ELEVATION, SOIL, ROCK)}
    try:
        landslider.run_one_step(dt)
        # the field of erosion holds only the last landslide over a node; the change of elevation holds all
        nodes = np.flatnonzero((at[EROSION] > 0.0) & core)
        soil = ground[SOIL][nodes] - (at[SOIL] - at[RUNOUT[0]])[nodes]
        rock = np.maximum(0.0, ground[ROCK][nodes] - at[ROCK][nodes])
    finally:
        for name, values in ground.items():
            at[name][:] = values
        for name in RUNOUT:
            at[name][:] = 0.0
    broken = rock / (1.0 - porosity)
    at[ROCK][nodes] -= rock
    at[SOIL][nodes] += broken
    at[ELEVATION][nodes] += broken - rock
    failing = np.zeros(grid.number_of_nodes)
    failing[nodes] = np.minimum(np.maximum(soil, 0.0) + broken, at[SOIL][nodes])
    return _fill(grid, failing)


# ---- fields and arguments ----


def _core(grid):
    """Return which nodes of a raster may hold mass, shape (nodes,) bool."""
    if not isinstance(grid, RasterModelGrid):
        raise InputError(f"a release needs a RasterModelGrid, got {type(grid).__name__}")
    if RELEASE_DEPTH in grid.at_node and grid.at_node[RELEASE_DEPTH].dtype != float:
        dtype = grid.at_node[RELEASE_DEPTH].dtype
        raise InputError(f"{RELEASE_DEPTH} must have the dtype float64, got {dtype}; add it with that dtype")
    return grid.status_at_node == CORE


def _depth_to_release(grid, depth, core):
    """Return the thickness of the ground that may fail at nodes, shape (nodes,) [m], limited to the soil."""
    if depth is None and SOIL not in grid.at_node:
        raise InputError(f"the grid has no {SOIL}, the thickness that fails by default; add it, or give depth [m]")
    remedy = f"; the grid has {_names(grid)}"
    deep = _at_nodes(grid, "depth", SOIL if depth is None else depth, remedy)
    good = np.isfinite(deep) & (deep >= 0.0) & ~is_fill(deep) | ~core
    require(good, "depth", "be a thickness >= 0 m", deep, _places(grid), form="g", error=InputError)
    if SOIL in grid.at_node:
        deep = np.minimum(deep, grid.at_node[SOIL])
    return np.where(core, deep, 0.0)


def _at_nodes(grid, name, value, remedy):
    """Return an argument, a number, an array or the name of a field, at all nodes, shape (nodes,).

    `name` is that of the argument; `remedy` ends the message about a field that is missing.
    """
    if isinstance(value, str):
        if value not in grid.at_node:
            raise InputError(
                f"{name} is to be read from the field {value!r}, which the grid does not have at its nodes"
                f"{did_you_mean(value, grid.at_node)}{remedy}"
            )
        value = grid.at_node[value]
    try:
        values = np.asarray(value, float)
    except (TypeError, ValueError):
        raise InputError(f"{name} must be the name of a field or numbers at nodes, got {value!r}") from None
    if values.ndim and values.shape not in {(grid.number_of_nodes,), tuple(grid.shape)}:
        raise InputError(f"{name} has the shape {values.shape}, the grid {grid.number_of_nodes} nodes in {grid.shape}")
    return np.broadcast_to(values.ravel(), grid.number_of_nodes)


def _number(name, value, low, high, unit, open_ends=(False, False)) -> float:
    """Return an argument that is one number, or raise InputError."""
    value = python_value(value)
    if isinstance(value, bool) or not isinstance(value, Real):
        raise InputError(f"{name} must be a number, got {value!r}{give_number(value)}")
    in_range(name, value, low, high, unit, open_ends=open_ends, error=InputError)
    return float(value)


def _generator(seed) -> np.random.Generator:
    """Return the generator of random numbers that an argument is or makes, or raise InputError."""
    try:
        return np.random.default_rng(seed)
    except (TypeError, ValueError):
        raise InputError(f"seed must be a whole number >= 0 or a numpy Generator, got {seed!r}") from None


def _fill(grid, failing) -> float:
    """Raise the release field to the failing depth, shape (nodes,) [m]; return the volume that it then holds [m3]."""
    if RELEASE_DEPTH not in grid.at_node:
        grid.add_zeros(RELEASE_DEPTH, at="node", units="m")
    field = grid.at_node[RELEASE_DEPTH]
    np.maximum(field, failing, out=field)
    return float(field.sum() * grid.dx * grid.dy)


def _places(grid):
    """Return a function that puts the first of some nodes, an array of int, into words."""
    return lambda bad: f" at {where(grid, bad[0])}, the first of {bad.size}"


def _names(grid) -> str:
    return ", ".join(sorted(grid.at_node)) or "no fields"
