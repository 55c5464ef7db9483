"""Stand-in terrains as Landlab grids, for cases whose own terrain is not public."""

import numpy as np
from landlab import RasterModelGrid
from scipy.ndimage import gaussian_filter

from ..core.checks import require
from ..core.errors import InputError

NON_ERODIBLE_BELOW = 100.0
"""Elevation below which the bed of Tsing Shan does not erode [m] (Pastor et al., 2022, section 4.2.2)."""

PARENT_VOLUME, TRIGGER_VOLUME = 2000.0, 350.0
"""Volumes of the two landslides [m3] (Pastor et al., 2022, section 4.2.1)."""

PARENT_HALF_AXES, TRIGGER_HALF_AXES = (25.0, 14.0), (10.0, 8.0)
"""Half axes of the two landslides along and across the channel [m]: some 1.8 and 1.4 m thick on average."""

HEAD_ROOM = 100.0
"""Plan distance from the centre of the parent landslide to the western edge of the grid [m]."""

CORRELATION_LENGTH = 15.0
"""Standard deviation of the Gaussian that smooths white noise into roughness [m]."""


def tsing_shan_valley(
    *,
    erodible_length: float = 714.0,
    slopes: tuple[float, float, float] = (38.0, 28.0, 2.0),
    transition_length: float = 240.0,
    runout_length: float = 1400.0,
    width: float = 600.0,
    channel_width: float = 40.0,
    channel_depth: float = 12.0,
    erodible_depth: float = 12.0,
    roughness: float = 0.0,
    seed: int = 0,
    spacing: float = 5.0,
    offset: tuple[float, float] = (0.0, 0.0),
) -> RasterModelGrid:
    """Build a valley with the numbers of the Tsing Shan debris flow of 1990, whose own terrain is not public.

    A channel descends from west to east along the middle row, reaches 100 m elevation, and opens onto a
    plain. From the parent landslide to 100 m the path is 714 m long, over which 2350 m3 grow to
    20 000 m3 at 3e-3 per metre: ln(20000/2350)/3e-3. With the default slopes the ground falls some
    490 m over the first 1000 m from the crown, as at Tsing Shan. The end of the flow, and with it the travel angle, is
    a result of the model.

    Parameters
    ----------
    erodible_length : float
        Path along the slope of the thalweg from the centre of the parent landslide to 100 m elevation [m].
    slopes : tuple of float
        Slope of the thalweg at the head of the channel, at 100 m elevation, and on the plain [deg];
        between them the angle changes with a quintic blend, so the profile has continuous curvature.
    transition_length : float
        Path below 100 m over which the slope eases to that of the plain and the channel fades out [m].
    runout_length : float
        Plan length of the grid beyond 100 m elevation [m].
    width : float
        Plan width of the grid [m].
    channel_width, channel_depth : float
        The cross-section is ``channel_depth (1 - exp(-(2 y / channel_width)^2))`` [m], smooth throughout.
    erodible_depth : float
        ``soil__depth`` above 100 m elevation [m]; 0 below. At the foot of the channel 20 000 m3 that
        grow by 3e-3 per metre take 60 m3 from every metre of path. Over half the channel width that is
        3 m on average. The default of 12 m leaves a factor of four for the middle, where the flow is
        deepest and the cut draws more flow in: the soil is nowhere used up.
    roughness : float
        Standard deviation of correlated roughness added to the surface [m].
    seed : int
        Seed of the roughness.
    spacing : float
        Distance of nodes [m].
    offset : tuple of float
        How far everything, terrain and release, lies east and north of where it would be, in parts of the
        spacing, from -0.5 to 0.5. The valley stays the same, nodes and particles change: runs
        that differ in the offset only show the noise of the discretisation.

    Returns
    -------
    RasterModelGrid
        With ``topographic__elevation``, ``soil__depth`` and ``debris_flow__release_depth`` [m]. The
        release is a trigger of 350 m3 just above a parent of 2000 m3, both caps with elliptical rims and
        of exact volume. All boundaries are open.

    Raises
    ------
    InputError
        If a number is out of bounds.

    Examples
    --------
    >>> grid = tsing_shan_valley()
    >>> grid.shape
    (121, 421)
    >>> float(round(grid.at_node["debris_flow__release_depth"].sum() * grid.dx * grid.dy, 9))
    2350.0
    """
    lengths = {
        "erodible_length": erodible_length, "transition_length": transition_length,
        "runout_length": runout_length, "width": width, "channel_width": channel_width, "spacing": spacing,
    }  # fmt: skip
    for name, value in lengths.items():
        _check(name, value, value > 0.0, "> 0 m")
    for name, value in (("channel_depth", channel_depth), ("erodible_depth", erodible_depth), ("roughness", roughness)):
        _check(name, value, value >= 0.0, ">= 0 m")
    _check("slopes", slopes, len(slopes) == 3 and all(0.0 <= a < 60.0 for a in slopes), "three angles in [0, 60) deg")
    _check("offset", offset, len(offset) == 2 and all(abs(o) <= 0.5 for o in offset), "two numbers in [-0.5, 0.5]")

    along, height, path = _thalweg(erodible_length, slopes, transition_length, runout_length)
    head = np.interp(-erodible_length, path, along)  # plan position of the parent landslide; 100 m is at 0
    west = spacing * np.floor((head - HEAD_ROOM) / spacing)
    rows = 2 * round(0.5 * width / spacing) + 1  # an odd number: without offset the thalweg runs through the middle row
    columns = int((runout_length - west) / spacing) + 1
    grid = RasterModelGrid((rows, columns), xy_spacing=spacing)
    x = grid.x_of_node + west - offset[0] * spacing
    y = grid.y_of_node - (0.5 * (rows - 1) + offset[1]) * spacing

    fading = 1.0 - _blend(np.interp(x, along, path) / transition_length)
    banks = channel_depth * (1.0 - np.exp(-((2.0 * y / channel_width) ** 2)))
    elevation = np.interp(x, along, height) + fading * banks
    if roughness > 0.0:
        elevation += roughness * _correlated_noise(grid.shape, CORRELATION_LENGTH / spacing, seed).ravel()
    grid.add_field("topographic__elevation", elevation, at="node", units="m")
    soil = np.where(elevation >= NON_ERODIBLE_BELOW, erodible_depth, 0.0)
    grid.add_field("soil__depth", soil, at="node", units="m")

    parent = _cap(x - head, y, PARENT_HALF_AXES, PARENT_VOLUME, spacing)
    above = PARENT_HALF_AXES[0] + TRIGGER_HALF_AXES[0]  # the trigger touches the parent
    trigger = _cap(x - head + above, y, TRIGGER_HALF_AXES, TRIGGER_VOLUME, spacing)
    release = grid.add_field("debris_flow__release_depth", parent + trigger, at="node", units="m")
    _check(
        "erodible_depth", erodible_depth, bool(np.all(release <= soil)),
        f"at least the thickness of the release, {release.max():.3g} m, with all of the release above 100 m elevation",
    )  # fmt: skip
    return grid


def _thalweg(erodible_length, slopes, transition_length, runout_length):
    """Return plan distance, elevation and path from the 100 m contour (negative above it) [m].

    All lengths are in m; `slopes` are those of head, foot and plain [deg]. The three arrays have one shape.
    """
    head, foot, plain = np.radians(slopes)
    top = erodible_length + 3.0 * HEAD_ROOM
    path = np.linspace(-top, 2.0 * runout_length, 1 + round(20 * (top + 2.0 * runout_length)))
    angle = np.where(
        path < 0.0,
        foot + (head - foot) * _blend(-path / erodible_length),
        foot + (plain - foot) * _blend(path / transition_length),
    )
    along, fall = _integral(np.cos(angle), path), _integral(np.sin(angle), path)
    contour = np.array([np.interp(0.0, path, along), np.interp(0.0, path, fall)])
    return along - contour[0], NON_ERODIBLE_BELOW - (fall - contour[1]), path


def _integral(values, path):
    return np.concatenate([[0.0], np.cumsum(0.5 * (values[1:] + values[:-1]) * np.diff(path))])


def _blend(t):
    """Rise from 0 to 1 on [0, 1] with two continuous derivatives."""
    t = np.clip(t, 0.0, 1.0)
    return t**3 * (10.0 - 15.0 * t + 6.0 * t**2)


def _cap(x, y, half_axes, volume, spacing):
    """Return the depth [m] at nodes of a parabolic cap with exactly this volume [m3].

    `x`, `y` are distances of the nodes from the centre, `half_axes` two lengths, `spacing` that of the nodes [m].
    """
    shape = np.maximum(0.0, 1.0 - (x / half_axes[0]) ** 2 - (y / half_axes[1]) ** 2)
    if not shape.any():
        raise InputError(f"spacing of {spacing:g} m puts no node on a landslide of {half_axes} m; use at most 5 m")
    return shape * (volume / (shape.sum() * spacing**2))


def _correlated_noise(shape, correlation_in_nodes, seed):
    """Return noise of zero mean and unit standard deviation, correlated over some nodes.

    `shape` is (rows, columns); `correlation_in_nodes` is the length of correlation in node spacings; `seed` is an int.
    """
    noise = gaussian_filter(np.random.default_rng(seed).standard_normal(shape), correlation_in_nodes, mode="nearest")
    return (noise - noise.mean()) / noise.std()


def _check(name, value, good, allowed):
    require(good, f"tsing_shan_valley: {name}", f"be {allowed}", value, error=InputError)
