"""Keys of a scene file: `terrain`, `release`, `output`; other keys are the attributes of `Setup`."""

from typing import ClassVar

from ..core.errors import ParameterError
from ..core.parameters import declared, parameter
from .output_keys import OutputKeys
from .release_keys import ReleaseKeys

__all__ = ["OutputKeys", "ReleaseKeys", "TerrainKeys"]


@declared
class TerrainKeys:
    """Ground of a scene: elevation and erodible soil from files or numbers."""

    keyword: ClassVar = "terrain"

    elevation: str | None = parameter("m", "raster of the elevation (DEM)", None, kind=str, file=True)
    example: str | None = parameter("-", "ground without a file, instead of elevation", None, choices=("gully",))
    crs: str | None = parameter("-", "coordinate reference system of files that name none", None, kind=str, file=True)
    soil_depth: float | str | None = parameter(
        "m", "depth of erodible soil: a number or a raster", None, (0.0, None), file=True
    )

    def _agree(self):
        if self.example is not None and isinstance(self.soil_depth, str):
            raise ParameterError("terrain: soil_depth must be a number [m] for an example, not a file")
        if (self.elevation is None) == (self.example is None):
            found = "is missing" if self.elevation is None else "and example are both given; keep one"
            raise ParameterError(f"terrain: elevation {found}; give the file of a DEM, such as elevation: dem.tif")
