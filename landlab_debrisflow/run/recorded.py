"""Records of a run, read for pictures: from its directory, its last checkpoint, or one file."""

import dataclasses
import logging
import tempfile
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from ..core.errors import InputError
from ..grid.checkpoint import FIELD
from ..grid.fields import OUTPUT_PREFIX
from ..record.checkpoint_file import read_checkpoint
from ..record.combine import combine_maps
from ..spatial.raster import CLOSED
from .files import MAPS, SERIES, SERIES_SUFFIX
from .maps import EXPOSURE
from .results import Results

KINDS = ("series", "sections", "gauges", "thalweg", "budget", "columns", "tracks")
"""Datasets of a run besides its maps, as their files are called."""

log = logging.getLogger("landlab_debrisflow")


@dataclasses.dataclass(frozen=True)
class Recorded:
    """Datasets of a run.

    Attributes
    ----------
    path : Path
        Directory or file that holds them.
    maps : xarray.Dataset or None
        Maps at the end, or at the last checkpoint.
    datasets : dict of str to xarray.Dataset
        The others, by the names of `KINDS`.
    asked : tuple of str
        Names of maps that the scene asks for.
    shapes : GeoDataFrame or None
        Exposed polygons.
    """

    path: Path
    maps: xr.Dataset | None = None
    datasets: dict[str, xr.Dataset] = dataclasses.field(default_factory=dict)
    asked: tuple[str, ...] = ()
    shapes: Any = None

    @property
    def thalweg(self) -> np.ndarray | None:
        """Vertices of the thalweg of the scene, shape (n, 2) [m]; None if the scene has none."""
        front = self.datasets.get("thalweg")
        if front is None or "thalweg_x" not in front:
            return None
        return np.stack([front.thalweg_x.values, front.thalweg_y.values], axis=1)

    @property
    def animated(self) -> str | None:
        """Name of the map of the series that is animated, the depth if the series has it; None without a series."""
        series = self.datasets.get(SERIES, xr.Dataset())
        names = [str(name).removeprefix(OUTPUT_PREFIX) for name, data in series.items() if data.ndim == 3]
        return "depth" if "depth" in names else next(iter(names), None)


def read_recorded(path: Path) -> Recorded:
    """Read the records of a run.

    Parameters
    ----------
    path : Path
        Directory of the results of a scene, or one file of results.

    Raises
    ------
    InputError
        If there are no results, or nothing of them can be drawn.
    """
    if path.is_file() or path.suffix == ".zarr":
        return _of_file(path)
    if not path.exists():
        raise InputError(f"{path} does not exist; give the directory of the results of a scene, or its maps.nc")
    results = Results(path)
    asked = tuple((results.record.scene.get("output") or {}).get("maps") or ())
    if not results.finished and not (path / MAPS).is_file():
        return _of_unfinished(results, asked)
    datasets = {name: results.dataset(name) for name in KINDS if (path / f"{name}.nc").is_file()}
    if (store := path / f"{SERIES}{SERIES_SUFFIX['zarr']}").is_dir():
        datasets[SERIES] = _opened(store)
    return Recorded(path, results.maps, datasets, asked, _shapes(path / f"{EXPOSURE}.gpkg"))


def _of_unfinished(results: Results, asked: tuple[str, ...]) -> Recorded:
    """Return the maps of the last checkpoint of an unfinished run, and the maps written during the run."""
    path, state = results.directory, results.record.state
    maps, failure = None, ""
    for checkpoint in results.checkpoints:
        try:
            maps = _maps_of_checkpoint(read_checkpoint(checkpoint))
        except InputError as error:
            failure = str(error)
            continue
        log.warning("the run in %s is %s: its last checkpoint is drawn, at %.6g s", path, state, maps.elapsed_time)
        break
    datasets = {}
    if any((path / SERIES).glob("maps_*.nc")):
        with tempfile.TemporaryDirectory() as folder:
            datasets[SERIES] = _opened(combine_maps(path / SERIES, Path(folder) / f"{SERIES}.nc"))
    if maps is None and not datasets:
        raise InputError(
            f"{path} holds nothing to draw yet: the run is {state}"
            f"{f', and {failure}' if failure else ' and has no checkpoint'}; landlab-debrisflow resume {path} goes on"
        )
    return Recorded(path, maps, datasets, asked)


def _maps_of_checkpoint(checkpoint: xr.Dataset) -> xr.Dataset:
    """Return the fields in a checkpoint as maps, NaN at closed nodes.

    Raises
    ------
    InputError
        If the checkpoint lacks something.
    """
    try:
        open_nodes = checkpoint.node_status != CLOSED
        fields = {
            str(name).removeprefix(FIELD): data.where(open_nodes)
            for name, data in checkpoint.items() if str(name).startswith(FIELD) and set(data.dims) == {"y", "x"}
        }  # fmt: skip
        accounts = {"eroded_depth": checkpoint.node_eroded, "deposit_depth": checkpoint.node_settled}
        for name, depth in accounts.items():  # fields have them from the end of a call on
            values = np.reshape(depth.values, open_nodes.shape)
            fields[OUTPUT_PREFIX + name] = open_nodes.copy(data=values).where(open_nodes)
        volumes = {"budget_released": checkpoint.budget_released, "budget_moving": checkpoint.particle_volume.sum()}
        moment = {name: float(value) for name, value in (volumes | {"elapsed_time": checkpoint["time"]}).items()}
    except (KeyError, AttributeError, ValueError, TypeError) as error:
        raise InputError(f"the checkpoint is not one of a flow: {error}") from error
    return xr.Dataset(fields, attrs=moment)


def _of_file(path: Path) -> Recorded:
    """Return the Dataset of one file, as maps or as one of `KINDS`."""
    if path.suffix not in (".nc", ".zarr"):
        raise InputError(
            f"{path} is no file of results that can be drawn; give the directory of a run, or a NetCDF file of it"
        )
    dataset = _opened(path)
    if kind := _kind(dataset):
        return Recorded(path, datasets={kind: dataset})
    if any(set(data.dims) == {"y", "x"} for data in dataset.values()):
        return Recorded(path, dataset)
    raise InputError(
        f"{path} holds nothing that can be drawn: it has {', '.join(map(str, dataset)) or 'no variables'}; give "
        "maps over y and x, or another file of a run"
    )


def _kind(dataset: xr.Dataset) -> str | None:
    """Return which of `KINDS` a Dataset is; None if it is none."""
    signs = {
        "sections": {"section", "discharge"}, "gauges": {"gauge", "depth"}, "thalweg": {"front_distance"},
        "budget": {"released", "eroded", "moving"}, "columns": {"excess_pore_pressure", "level", "time"},
        "tracks": {"particle", "x", "y", "speed"},
    }  # fmt: skip
    for kind, names in signs.items():
        if names <= set(dataset.variables):
            return kind
    return "series" if any(set(data.dims) == {"time", "y", "x"} for data in dataset.values()) else None


def _opened(path: Path) -> xr.Dataset:
    """Return a Dataset from a NetCDF file or a Zarr store, whole."""
    engine: Any = "zarr" if path.suffix == ".zarr" else "netcdf4"
    try:
        with xr.open_dataset(path, engine=engine, decode_coords="all", decode_timedelta=False) as data:
            return data.load()
    except ImportError as error:
        raise InputError(f'cannot read {path}: {error}; pip install "landlab_debrisflow[geo]"') from error
    except (OSError, RuntimeError, ValueError, KeyError) as error:
        raise InputError(f"cannot read {path}: {error}; it is damaged, or no such file") from error


def _shapes(path: Path) -> Any:
    """Return the exposed polygons of a run; None without any, or without the library that reads them."""
    if not path.is_file():
        return None
    try:
        import geopandas
    except ImportError:
        return None
    return geopandas.read_file(path, engine="pyogrio")
