"""Keys of a scene file: `terrain`, `release`, `output`; the others are those of `Setup`."""

from typing import ClassVar

from ..core.errors import ParameterError
from ..core.parameters import declared, parameter


@declared
class TerrainKeys:
    """Ground of a scene: elevation and erodible soil from files or numbers."""

    elevation: str | None = parameter("m", "raster of the elevation (DEM)", None, kind=str, file=True)
    crs: str | None = parameter("-", "coordinate reference system of files that name none", None, kind=str, file=True)
    soil_depth: float | str | None = parameter(
        "m", "depth of erodible soil: a number or a raster", None, (0.0, None), file=True
    )

    def _agree(self):
        if self.elevation is None:
            raise ParameterError("terrain: elevation is missing; give the file of a DEM, such as elevation: dem.tif")


@declared
class ReleaseKeys:
    """Failing ground of a scene: polygons or a raster of depths, at some time."""

    polygons: str | None = parameter(
        "-", "file of polygons with their attribute depth [m] or volume [m3]", None, kind=str, file=True
    )
    depth: float | None = parameter(
        "m", "mean depth, of polygons without the attribute", None, (0.0, None), open_below=True
    )
    time: float = parameter("s", "elapsed time at which the ground fails", 0.0, (0.0, None))


@declared
class OutputKeys:
    """Output of a scene."""

    directory: str | None = parameter(
        "-", "directory of the results, by default named after the scene with _out", None, kind=str, file=True
    )
    max_duration: float = parameter("s", "longest time to simulate", 3600.0, (0.0, None), open_below=True)
    interval: float | None = parameter("s", "time between maps of the series", None, (0.0, None), open_below=True)
    variables: ClassVar = ("depth", "speed")
    maps: ClassVar = ()
    least_depth: float = parameter("m", "written peaks are missing where the depth stayed below", 0.05, (0.0, 100.0))
    checkpoint_interval: float = parameter("s", "wall time between two checkpoints", 60.0, (0.0, None))
