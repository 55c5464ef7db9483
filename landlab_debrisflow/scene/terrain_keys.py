"""Keys of the ground of a scene: elevation, window, soil, zones of parameters, edits."""

from typing import Any, ClassVar

from ..core.errors import ParameterError
from ..core.parameters import declared, parameter

EDITS = ("dam", "wall", "excavation", "buildings")
"""Keys of which an edit has exactly one."""
EDITS_WITH = {
    "crest_elevation": ("dam", "wall"), "crest_height": ("dam", "wall"), "crest_width": ("dam", "wall"),
    "slope": ("dam", "excavation"), "depth": ("excavation",), "floor_elevation": ("excavation",),
    "height": ("buildings",), "thin": ("buildings",),
}  # fmt: skip
"""Edits that a key belongs to."""


@declared
class Zone:
    """Polygons with soil and parameters of friction and erosion of their own."""

    keyword: ClassVar = "zone"

    polygons: Any = parameter(
        "m", "file of polygons, or coordinates", None, kind=str, file=True, coordinates="polygons"
    )
    soil_depth: float | None = parameter("m", "depth of erodible soil inside", None, (0.0, None))
    bed_pressure_ratio: float | None = parameter(
        "-", "excess pore pressure of the bed over its liquefaction value, inside", None, (0.0, 1.0)
    )
    bed_degree_of_saturation: float | None = parameter("-", "water over pores of the bed, inside", None, (0.0, 1.0))
    friction: Any = parameter("-", "parameters of the friction law inside, by name", None, kind=dict)
    erosion: Any = parameter("-", "parameters of the erosion law inside, by name", None, kind=dict)

    def _agree(self):
        if self.polygons is None:
            raise ParameterError("zone: polygons is missing; give a file, such as polygons: forest.gpkg")
        bed = self.soil_depth, self.bed_pressure_ratio, self.bed_degree_of_saturation
        if all(one is None for one in (*bed, self.friction, self.erosion)):
            raise ParameterError(
                "zone: give soil_depth, bed_pressure_ratio, bed_degree_of_saturation, friction or erosion inside the "
                "polygons"
            )


@declared
class Edit:
    """Change of the ground: a dam or wall along lines, an excavation or buildings in polygons."""

    keyword: ClassVar = "edit"

    dam: Any = parameter("m", "file of lines, or coordinates, along the crest", None, kind=str, file=True,
                         coordinates="lines")  # fmt: skip
    wall: Any = parameter("m", "file of lines, or coordinates, along the crest; its sides are upright", None, kind=str,
                          file=True, coordinates="lines")  # fmt: skip
    excavation: Any = parameter("m", "file of polygons, or coordinates, of the upper rim", None, kind=str, file=True,
                                coordinates="polygons")  # fmt: skip
    buildings: Any = parameter("m", "file of polygons, or coordinates, of the walls", None, kind=str, file=True,
                               coordinates="polygons")  # fmt: skip
    crest_elevation: float | None = parameter("m", "elevation of the crest", None)
    crest_height: float | None = parameter(
        "m", "height of the crest above the ground along the line", None, (0.0, None), open_below=True
    )
    crest_width: float | None = parameter(
        "m", "width of the crest; of a wall, which is three nodes by default, its thickness", None, (0.0, None),
        open_below=True,
    )  # fmt: skip
    slope: float | None = parameter(
        "deg", "of the sides; by default 33.7 (2 in 3) of a dam, 45 of an excavation", None, (5.0, 90.0)
    )
    depth: float | None = parameter("m", "below the ground, of the floor", None, (0.0, None), open_below=True)
    floor_elevation: float | None = parameter("m", "elevation of the floor", None)
    height: float | None = parameter(
        "m", "of buildings without this attribute; without either, nodes are closed and the flow cannot get over",
        None, (0.0, None), open_below=True,
    )  # fmt: skip
    thin: str = parameter(
        "-", "whether buildings thinner than three nodes are refused or left out", "refuse",
        choices=("refuse", "leave_out"),
    )  # fmt: skip

    @property
    def kind(self) -> str:
        """Key of the change: dam, wall, excavation or buildings."""
        return next(name for name in EDITS if getattr(self, name) is not None)

    def _agree(self):
        given = [name for name in EDITS if getattr(self, name) is not None]
        if len(given) != 1:
            raise ParameterError(f"edit: give exactly one of {', '.join(EDITS)}, got {' and '.join(given) or 'none'}")
        for key, kinds in EDITS_WITH.items():
            is_set = getattr(self, key) not in (None, "refuse")
            if is_set and self.kind not in kinds:
                raise ParameterError(f"edit: {key} belongs to {' or '.join(kinds)}, not to {self.kind}; leave it out")
        pair = {"dam": ("crest_elevation", "crest_height"), "excavation": ("depth", "floor_elevation")}
        pair["wall"] = pair["dam"]
        if self.kind in pair:
            one, other = pair[self.kind]
            if (getattr(self, one) is None) == (getattr(self, other) is None):
                raise ParameterError(f"edit: {self.kind} needs either {one} [m] or {other} [m]")


@declared
class TerrainKeys:
    """Ground of a scene: elevation, erodible soil and changes of both, from files or numbers."""

    keyword: ClassVar = "terrain"

    elevation: str | None = parameter("m", "raster of the elevation (DEM)", None, kind=str, file=True)
    example: str | None = parameter("-", "ground without a file, instead of elevation", None, choices=("gully",))
    crs: str | None = parameter("-", "coordinate reference system of files that name none", None, kind=str)
    nodata: float | None = parameter("m", "further value that marks missing data in the DEM, such as 0", None)
    window: Any = parameter(
        "m", "part of the DEM: reach, the part that releases can reach, by default of DEMs of over 250 000 nodes; "
        "all; or a list of west, south, east, north", None, kind=tuple, choices=("reach", "all"), length=4,
    )  # fmt: skip
    travel_angle: float = parameter("deg", "least travel angle of the releases, for window: reach", 5.0, (0.1, 45.0))
    spacing: float | None = parameter(
        "m", "of the nodes; by default that of the DEM", None, (0.0, None), open_below=True
    )
    soil_depth: float | str | None = parameter(
        "m", "depth of erodible soil: a number, a raster, or polygons with this attribute", None, (0.0, None), file=True
    )
    bed_pressure_ratio: float | str | None = parameter(
        "-", "excess pore pressure of the bed over its liquefaction value: a number or a raster", None, (0.0, 1.0),
        file=True,
    )  # fmt: skip
    bed_degree_of_saturation: float | str | None = parameter(
        "-", "water over pores of the bed: a number or a raster", None, (0.0, 1.0), file=True
    )
    zones: Any = parameter("-", "polygons in which soil or parameters differ, the last one counts", (), items=Zone)
    edits: Any = parameter("-", "changes of the ground, in this order", (), items=Edit)

    def _agree(self):
        if (self.elevation is None) == (self.example is None):
            found = "is missing" if self.elevation is None else "and example are both given; keep one"
            raise ParameterError(f"terrain: elevation {found}; give the file of a DEM, such as elevation: dem.tif")
        if isinstance(self.window, tuple):
            west, south, east, north = self.window
            if not (west < east and south < north):
                raise ParameterError(
                    f"terrain: window must be [west, south, east, north] with west < east and south < north, got "
                    f"{list(self.window)}"
                )
