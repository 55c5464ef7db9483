"""Keys of the output in a scene file."""

from typing import Any, ClassVar

from ..core.errors import ParameterError
from ..core.parameters import declared, parameter
from ..grid.fields import NODE_FIELDS

PREFIX = "debris_flow__"
MAPS = tuple(field.name.removeprefix(PREFIX) for field in NODE_FIELDS if field.intent == "out")
"""Names of output fields without their prefix."""
ALWAYS = ("max_depth", "max_speed", "arrival_time", "eroded_depth", "deposit_depth")
"""Maps that are written as GeoTIFF by default."""
LOOKED_AT = ("depth", "speed", "basal_excess_pore_pressure", "eroded_depth", "deposit_depth")
"""Variables that are written as they change, by default."""


@declared
class OutputKeys:
    """Output of a scene: duration of the run, files, places and variables."""

    keyword: ClassVar = "output"

    directory: str | None = parameter(
        "-", "directory of the results, by default the name of the scene with _out", None, kind=str, file=True
    )
    max_duration: float = parameter("s", "longest time to simulate", 3600.0, (0.0, None), open_below=True)
    interval: float | None = parameter(
        "s", "time between two maps of the series; by default none is written", None, (0.0, None), open_below=True
    )
    series_interval: float = parameter(
        "s", "time between two values of gauges, sections, thalweg, tracks and columns", 1.0, (0.0, None),
        open_below=True,
    )  # fmt: skip
    variables: Any = parameter("-", "variables of the series of maps", LOOKED_AT, kind=tuple, choices=MAPS)
    format: str = parameter("-", "file format of the series of maps", "netcdf", choices=("netcdf", "zarr"))
    maps: Any = parameter("-", f"maps to write as GeoTIFF besides {', '.join(ALWAYS)}", (), kind=tuple, choices=MAPS)
    least_depth: float = parameter("m", "written peaks are missing where the depth stayed below", 0.05, (0.0, 100.0))
    gauges: Any = parameter(
        "m", "points with a name: file, or mapping of name to [x, y]", None, kind=str, file=True,
        coordinates="points", named=True,
    )  # fmt: skip
    sections: Any = parameter(
        "m", "lines with a name, across which discharge is measured: file, or mapping of name to [[x, y], ...]", None,
        kind=str, file=True, coordinates="lines", named=True,
    )  # fmt: skip
    thalweg: Any = parameter(
        "m", "line along which the front is followed: file, or [[x, y], ...]", None, kind=str, file=True,
        coordinates="lines",
    )  # fmt: skip
    tracks: int = parameter("-", "number of particles whose tracks are written", 0, (0, None), kind=int)
    columns: int = parameter("-", "number of particles whose columns are written", 0, (0, None), kind=int)
    exposure: Any = parameter(
        "m", "polygons with an id, such as buildings: file, or mapping of id to [[x, y], ...]", None, kind=str,
        file=True, coordinates="polygons", named=True,
    )  # fmt: skip
    checkpoint_interval: float = parameter(
        "s", "wall time between two checkpoints; 0: none but at an interruption", 60.0, (0.0, None)
    )

    def _agree(self):
        if self.thalweg is not None and not isinstance(self.thalweg, str) and len(self.thalweg) != 1:
            raise ParameterError(f"output: thalweg must be one line, got {len(self.thalweg)}")
        if self.interval is not None and self.interval > self.max_duration:
            raise ParameterError(
                f"output: interval must be at most max_duration, {self.max_duration:g} s, got {self.interval:g} s"
            )
