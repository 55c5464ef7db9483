"""Write a scene file to start from."""

import os
from pathlib import Path
from typing import Any

from ..core.errors import InputError
from ..geo.lattice import Lattice, extent
from ..geo.names import find_file
from ..geo.rasters import open_raster
from ..geo.references import check_reference, label_of
from ..geo.shapes import read_shapes
from ..record.files import write_atomically
from .gully import LATTICE
from .template import scene_text

GUESS = "A GUESS, to be replaced: "
EXAMPLE_RELEASE = [[20, 145], [50, 145], [50, 170], [20, 170]]
"""Polygon in the gully, east and north of the first node [m]."""
EXAMPLE_SETTINGS: dict[str, dict[str, Any]] = {
    "friction": {"law": "voellmy", "turbulent_coefficient": 300.0},
    "erosion": {"law": "growth", "growth_rate": 0.002},
    "numerics": {"particle_count": 1000},
    "output": {"max_duration": 300.0, "interval": 5.0},
}
RASTERS = (".tif", ".tiff", ".asc", ".nc", ".vrt", ".img")


def new_scene(
    path: str | Path, dem: str | Path | None = None, release: str | Path | None = None, *, crs: str | None = None,
    full: bool = False,
) -> Path:  # fmt: skip
    """Write a commented scene that runs: an example, or one with the files of a user.

    Parameters
    ----------
    path : str or Path
        Scene file to be written; a file that is there stays as it is.
    dem : str or Path, optional
        Raster of the elevation; by default the ground is a built-in gully.
    release : str or Path, optional
        Polygons, a raster of depths, or points; needed with `dem`.
    crs : str, optional
        Coordinate reference system of a DEM that names none, such as ``"EPSG:32633"``.
    full : bool
        Whether every key of every law is there, as a comment if not set; by default the usual ones.

    Returns
    -------
    Path
        The scene file.

    Raises
    ------
    InputError
        If the scene file is there already or cannot be written, or a file given cannot be used.
    """
    path = Path(path)
    if path.suffix.lower() not in (".yaml", ".yml"):
        raise InputError(f"a scene is a YAML file: give {path.with_suffix('.yaml').name} rather than {path.name}")
    if path.exists():
        raise InputError(f"{path} is there already and stays as it is; choose another name, or remove it first")
    if (dem is None) != (release is None):
        missing = "the release" if release is None else "the DEM"
        raise InputError(f"{missing} is missing; give a DEM and a release, such as --from dem.tif release.gpkg")
    if dem is None or release is None:
        if crs is not None:
            raise InputError(f"crs: {crs} is for a DEM; give one and a release, such as --from dem.asc release.gpkg")
        text = _example(path, full)
    else:
        text = _own(path, str(dem), str(release), crs, full)
    return write_atomically(path, lambda temporary: temporary.write_text(text, encoding="utf-8"))


def _example(path: Path, full: bool) -> str:
    x0, y0 = LATTICE.lower_left
    outline = [[int(x0) + x, int(y0) + y] for x, y in EXAMPLE_RELEASE]
    remarks = ["", "The ground is a built-in gully above a fan; replace example by the file of a DEM (elevation)."]
    keys = {"polygons": outline, "depth": 1.5}
    return scene_text(path.name, {"example": "gully"}, keys, remarks, settings=EXAMPLE_SETTINGS, full=full)


def _own(path: Path, dem: str, release: str, crs: str | None, full: bool) -> str:
    """Return the scene of a DEM and a release of a user."""
    notes: list[str] = []
    source = open_raster(dem, crs, notes)
    lattice = source.lattice
    check_reference(lattice, crs, source.path)
    remarks = [
        "", f"{source.path.name}: {lattice.shape[0]} x {lattice.shape[1]} nodes (rows x columns), spacing "
        f"{lattice.spacing[0]:g} x {lattice.spacing[1]:g} m, {extent(lattice.bounds)}, {_reference(lattice)}.",
    ]  # fmt: skip
    terrain = {"elevation": _relative(dem, path)} | ({} if crs is None else {"crs": crs}) | {"soil_depth": 1.0}
    comments = {"soil_depth": f"{GUESS}depth of erodible soil [m], a number or a raster; 0: nothing erodes"}
    keys, words = _release_keys(release, path, lattice, remarks, notes)
    remarks += notes
    return scene_text(
        path.name,
        terrain,
        keys,
        remarks,
        comments | words,
        {"output": {"interval": 10.0}, "numerics": {"particle_count": 2000}},
        full,
    )


def _release_keys(
    release: str, path: Path, lattice: Lattice, remarks: list[str], notes: list[str]
) -> tuple[dict[str, Any], dict[str, str]]:
    """Return keys of a release, and remarks on some of them; a sentence on the file is appended to the remarks."""
    file, _ = find_file(release)
    if file.suffix.lower() in RASTERS:
        open_raster(release, lattice.crs, notes)
        return {"raster": _relative(release, path)}, {}
    shapes = read_shapes(release, lattice.crs, kind="any", bounds=lattice.bounds, notes=notes)
    kinds = {shape.geometry.geom_type.removeprefix("Multi") for shape in shapes}
    if kinds == {"Point"}:
        remarks.append(f"{file.name}: {len(shapes)} points, at each of which the hydrograph flows in.")
        keys = {
            "points": _relative(release, path), "hydrograph": [[0.0, 0.0], [60.0, 20.0], [300.0, 0.0]], "width": 10.0,
            "speed": 3.0,
        }  # fmt: skip
        words = {
            "hydrograph": f"{GUESS}pairs of time [s] and discharge [m3 s-1], or the name of a CSV file",
            "width": f"{GUESS}of the inflow, across the slope [m]", "speed": f"{GUESS}of the inflow [m s-1]",
        }  # fmt: skip
        return keys, words
    if kinds != {"Polygon"}:
        raise InputError(f"{file.name} must hold polygons or points, got {' and '.join(sorted(kinds))}")
    area = sum(shape.geometry.area for shape in shapes)
    remarks.append(f"{file.name}: {len(shapes)} polygons of {area:.6g} m2 in all, {area / lattice.area:.4g} cells.")
    keys = {"polygons": _relative(release, path)}
    bare = [shape for shape in shapes if not {str(name).lower() for name in shape.attributes} & {"depth", "volume"}]
    if not bare:
        return keys, {}
    return keys | {"depth": 1.0}, {
        "depth": f"{GUESS}mean depth [m] of the {len(bare)} of {len(shapes)} polygons that have neither an attribute "
        "depth [m] nor volume [m3]"
    }


def _relative(name: str, scene: Path) -> str:
    """Return the name of a file relative to the directory of a scene, a choice after a colon kept."""
    file, choice = find_file(name)
    try:
        found = Path(os.path.relpath(file, scene.parent)).as_posix()
    except ValueError:  # on another drive
        found = file.resolve().as_posix()
    return f"{found}:{choice}" if choice else found


def _reference(lattice: Lattice) -> str:
    return "without a coordinate reference system (terrain: crs)" if lattice.crs is None else label_of(lattice.crs)
