"""Hazard maps of the ensemble that a scene describes, as its keys want them."""

from pathlib import Path
from typing import Any

import xarray as xr

from ..ensemble import Ensemble, EnsembleResults
from ..geo.exposure import ELEVATION
from ..run.scene import Scene
from ..scene.keys import EnsembleKeys
from ..scene.location import located
from .exposure import exposure_probabilities
from .maps import hazard_maps
from .questions import DEPTH, QUANTILES, check_questions
from .scale import SCALES, HazardScale, check_scale
from .write import write_hazard


def check_hazard_keys(scene: Scene) -> None:
    """Refuse thresholds, quantiles and hazard classes of a scene that its members could not answer.

    Parameters
    ----------
    scene : Scene
        With the key ``ensemble``.

    Raises
    ------
    ParameterError
        As `hazard_maps` raises it, with file and line.
    """
    keys = scene.content.ensemble
    if keys is None or not has_hazard(keys):
        return
    with located(scene.file, "ensemble"):
        check_questions(keys.maps, keys.thresholds, keys.quantiles or QUANTILES)
        if (scale := scale_of(keys)) is not None:
            check_scale(scale, keys.maps)


def write_scene_hazard(ensemble: Ensemble, results: EnsembleResults) -> list[Path]:
    """Write hazard maps of an ensemble into the directory of its results, and the table of its exposed polygons.

    Maps of other thresholds, from an earlier call, are removed.

    Parameters
    ----------
    ensemble : Ensemble
        Ensemble of a scene with the key ``ensemble``.
    results : EnsembleResults

    Returns
    -------
    list of pathlib.Path
        Files, as `write_hazard` returns them; none if no member has come to its end or the peak depth is not kept.

    Raises
    ------
    InputError, OutputError
        If a file cannot be written.
    """
    scene, keys = ensemble.scene, ensemble.scene.content.ensemble
    if keys is None or not has_hazard(keys) or results.done.sum() <= len(results.failures):
        return []
    maps = scene_hazard_maps(results, scene)
    exposure = exposure_probabilities(results, scene=scene, **_asked(scene)) if scene.places.exposure else None
    elevation = scene.terrain[ELEVATION].values
    written = write_hazard(ensemble.results_directory, maps, elevation=elevation, exposure=exposure)
    _remove_others(ensemble.results_directory, written)
    return written


def scene_hazard_maps(results: EnsembleResults, scene: Scene) -> xr.Dataset:
    """Return the hazard maps that the keys of a scene ask for, with the usual thresholds if it has no key ``ensemble``.

    Parameters
    ----------
    results : EnsembleResults
    scene : Scene

    Returns
    -------
    xarray.Dataset
        As `hazard_maps` returns them.
    """
    keys = scene.content.ensemble
    return hazard_maps(results, quantiles=(keys and keys.quantiles) or QUANTILES, **_asked(scene))


def _asked(scene: Scene) -> dict[str, Any]:
    """Return the arguments that maps and the table of exposed polygons have in common."""
    keys, least_depth = scene.content.ensemble, scene.output_keys.least_depth
    if keys is None:
        return {"least_depth": least_depth}
    return {"thresholds": keys.thresholds, "least_depth": least_depth, "scale": scale_of(keys)}


def _remove_others(folder: Path, written: list[Path]) -> None:
    """Remove maps of thresholds and quantiles that an earlier command wrote."""
    kept = {path.with_suffix("") for path in written}
    for path in (path for kind in ("probability_of_*", "quantile_of_*") for path in folder.glob(kind)):
        if path.suffix in (".tif", ".qml", ".png") and path.with_suffix("") not in kept:
            path.unlink()


def has_hazard(keys: EnsembleKeys) -> bool:
    """Return whether hazard maps are made: the members keep the peak depth, or thresholds or classes are asked for."""
    return DEPTH in keys.maps or keys.thresholds is not None or scale_of(keys) is not None


def scale_of(keys: EnsembleKeys) -> HazardScale | None:
    """Return the scale of hazard classes that the keys of an ensemble name."""
    return SCALES.get(keys.hazard_scale)
