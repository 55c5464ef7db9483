"""Probabilities that buildings, roads and further shapes are hit, over the members of an ensemble."""

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from ..core.errors import InputError
from ..ensemble import EnsembleResults
from ..geo.exposed_shapes import cells_under, check_on_grid, identifiers, in_system, open_faces, shape_frame
from ..geo.exposure import ELEVATION, FACTORS, QUANTITIES
from ..grid.fields import OUTPUT_PREFIX
from ..record.datasets import ON_WALLS
from ..record.written_maps import LEAST_DEPTH
from ..run.maps import exposed_frame
from ..run.scene import Scene
from .bins import bin_of_rank, bin_values
from .census import Census, completed_members, take_census
from .counting import Histogram, without_films
from .questions import ARRIVAL, DEPTH, QUANTILES, Questions, check_questions
from .scale import HazardScale, check_scale
from .shape_cells import ShapeCells


def exposure_probabilities(
    results: EnsembleResults | str | os.PathLike[str],
    shapes: Any = None,
    thresholds: Mapping[str, Any] | None = None,
    *,
    identifier: str | None = None,
    least_depth: float = LEAST_DEPTH,
    scale: HazardScale | None = None,
    independent: bool | None = None,
    scene: Scene | None = None,
) -> Any:
    """Return the probability that each shape is reached, and that its largest values exceed thresholds.

    A shape has the cells that it covers in part or whole. Where it is a closed cell, a building that was made a wall,
    impact pressure counts at its own faces, depth and speed in the open cells beside them.

    Parameters
    ----------
    results : EnsembleResults, str or Path
        Results of an ensemble, or its store.
    shapes : geopandas.GeoDataFrame, str or Path, optional
        Polygons, lines or points, or a file of them; by default the exposed polygons of the scene.
    thresholds, least_depth, scale, independent
        As in `hazard_maps`.
    identifier : str, optional
        Column whose values name the shapes, each once; by default the shapes are numbered from 1.
    scene : Scene, optional
        Scene of the ensemble; by default made of the plain values in the results, files being relative to the present
        directory. It is asked for its exposed polygons and its closed cells.

    Returns
    -------
    geopandas.GeoDataFrame
        One row for every shape: ``id``, ``p_reached``, ``p_max_depth_above_0.5_m`` and so on, each with ``_low`` and
        ``_high``, the 95 % interval; ``p_class_...`` of that class or a more severe one; ``earliest_arrival_s``,
        ``median_arrival_s`` among the members that reach the shape; ``cells``, ``on_grid``, geometry.

    Raises
    ------
    InputError, ParameterError
        As in `hazard_maps`; if a shape cannot be used, or none touches the grid.
    """
    import geopandas

    results = results if isinstance(results, EnsembleResults) else EnsembleResults.open(Path(results))
    asked = check_questions(results.maps, thresholds, QUANTILES, least_depth)
    if scale is not None:
        check_scale(scale, results.maps)
    census, lattice = take_census(results, independent), results.lattice
    scene = Scene.from_mapping(results.scene) if scene is None else scene
    if shapes is None:
        if not scene.places.exposure:
            raise InputError("hazard: the scene has no exposed polygons; give shapes, or output: exposure in the scene")
        shapes, identifier = exposed_frame(scene), "id"
    frame = in_system(shape_frame(shapes), lattice.crs)
    names = identifiers(frame, identifier)
    under = [cells_under(geometry, lattice) for geometry in frame.geometry]
    check_on_grid(frame, lattice, [one[3] for one in under])
    closed = np.isnan(scene.terrain[ELEVATION].values)
    whole = ShapeCells.of([(rows, columns) for rows, columns, _, _ in under])
    beside = ShapeCells.of([_with_faces(rows, columns, closed) for rows, columns, _, _ in under])
    columns = _counted(results, census, asked, scale, whole, beside)
    numbers = {"cells": [one[0].size for one in under], "on_grid": [one[3] for one in under]}
    table = geopandas.GeoDataFrame(
        {"id": names} | columns | numbers, geometry=list(frame.geometry), crs=frame.crs or lattice.crs
    )  # fmt: skip
    table.attrs = {"members_completed": census.completed, "no_sampling_error": census.reason}
    return table


def _with_faces(rows: np.ndarray, columns: np.ndarray, closed: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the open cells of a shape and the open cells beside its closed cells."""
    is_open = ~closed[rows, columns]
    faces = open_faces(rows[~is_open], columns[~is_open], closed)
    return np.concatenate([rows[is_open], faces[0]]), np.concatenate([columns[is_open], faces[1]])


def _counted(
    results: EnsembleResults, census: Census, asked: Questions, scale: HazardScale | None, whole: ShapeCells,
    beside: ShapeCells,
) -> dict[str, Any]:  # fmt: skip
    """Return the columns of all probabilities and arrivals, from a pass over the members."""
    shapes = whole.start.size
    columns = ["reached", *(_column(name, bound) for name, bounds in asked.thresholds.items() for bound in bounds)]
    columns += [f"class_{one.name}" for one in scale.classes] if scale is not None else []
    counts = np.zeros((census.trials.size, len(columns), shapes), np.int64)
    arrivals, earliest = Histogram(ARRIVAL, (shapes, 1), census.members), np.full(shapes, np.nan)
    for member in completed_members(results):
        values = without_films(member, asked.least_depth)
        came = [beside.largest(member, values[DEPTH]) > 0.0]
        for name, bounds in asked.thresholds.items():
            largest = (whole if OUTPUT_PREFIX + name in ON_WALLS else beside).largest(member, values[name])
            came += [largest > bound for bound in bounds]
        if scale is not None:
            worst = beside.largest(member, scale.class_of(values))
            came += [worst > k for k in range(len(scale.classes))]
        counts[census.group[member.member]] += np.array(came)
        if ARRIVAL in values:
            first = beside.least(member, values[ARRIVAL])
            earliest = np.fmin(earliest, first)
            hit = np.flatnonzero(np.isfinite(first))
            arrivals.count(hit, np.zeros(hit.size, int), first[hit])
    found: dict[str, Any] = {}
    for k, column in enumerate(columns):
        estimate = census.estimate(counts[:, k])
        found |= {f"p_{column}": estimate.probability, f"p_{column}_low": estimate.low}
        found[f"p_{column}_high"] = estimate.high
    if ARRIVAL in results.maps:
        found |= {"earliest_arrival_s": earliest, "median_arrival_s": _median(arrivals.counts[:, 0])}
    return found


def _column(name: str, bound: float) -> str:
    """Return the name of a column, in the units of the table of a run."""
    unit = QUANTITIES.get(name, "m")
    return f"{name}_above_{FACTORS.get(unit, 1.0) * bound:g}_{unit}"


def _median(histogram: np.ndarray) -> np.ndarray:
    """Return the median of the arrivals at each shape, the middle of a bin; NaN without any, shape (shapes,)."""
    count = histogram.sum(axis=1, dtype=np.int64)
    middle = bin_of_rank(histogram, np.maximum((count + 1) // 2, 1))
    values = bin_values(ARRIVAL)
    return np.where(count > 0, values[np.minimum(middle, values.size - 1)], np.nan)
