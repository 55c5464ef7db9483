"""Keys of a release in a scene file."""

from typing import Any, ClassVar

from ..core.errors import ParameterError
from ..core.parameters import declared, parameter

SOURCES = ("ground", "above")
SURFACES = ("tapered", "sloping_local_base_level", "ellipsoid", "uniform")
KINDS = ("polygons", "raster", "points")
"""Keys of which a release has exactly one."""
KINDS_OF = {
    "depth": ("polygons",), "largest_depth": ("polygons",), "volume": ("polygons",), "failure_surface": ("polygons",),
    "from": ("polygons", "raster"), "velocity": ("polygons", "raster"), "speed": ("polygons", "raster", "points"),
    "hydrograph": ("points",), "width": ("points",),
}  # fmt: skip
"""Kinds of release that a key belongs to."""


@declared
class ReleaseKeys:
    """Mass that a scene sets moving at some time: polygons, a raster of depths, or points with a hydrograph."""

    keyword: ClassVar = "release"

    polygons: Any = parameter(
        "m", "file of polygons, or coordinates; attribute depth [m] or volume [m3] of each", None, kind=str, file=True,
        coordinates="polygons",
    )  # fmt: skip
    raster: str | None = parameter("m", "raster of the depth that fails", None, kind=str, file=True)
    points: Any = parameter(
        "m", "file of points, or coordinates, at each of which the hydrograph flows in", None, kind=str, file=True,
        coordinates="points",
    )  # fmt: skip
    depth: float | None = parameter(
        "m", "mean depth, vertical, of polygons without an attribute", None, (0.0, None), open_below=True
    )
    largest_depth: float | None = parameter(
        "m", "largest depth, vertical, of polygons without an attribute", None, (0.0, None), open_below=True
    )
    volume: float | None = parameter(
        "m3", "volume of each polygon without an attribute", None, (0.0, None), open_below=True
    )
    time: float = parameter("s", "elapsed time at which it starts to move", 0.0, (0.0, None))
    from_: str = parameter(
        "-", "whether the mass fails out of the ground or is laid on top of it", "ground", choices=SOURCES
    )
    failure_surface: str | None = parameter(
        "-", "shape of the body that fails out of the ground; by default tapered", None, choices=SURFACES
    )
    velocity: Any = parameter("m s-1", "at the start, towards east and north", None, kind=tuple, length=2)
    speed: float | None = parameter(
        "m s-1", "at the start, down the slope; of points that of the inflow", None, (0.0, None)
    )
    hydrograph: Any = parameter(
        "s, m3 s-1", "file (CSV) of time and discharge, or pairs of them, counted from the time of the release", None,
        kind=str, file=True, coordinates="table",
    )  # fmt: skip
    width: float | None = parameter(
        "m", "of the inflow at a point, across the slope", None, (0.0, None), open_below=True
    )

    @property
    def kind(self) -> str:
        """Key of the mass: polygons, raster or points."""
        return next(name for name in KINDS if getattr(self, name) is not None)

    def _agree(self):
        given = [name for name in KINDS if getattr(self, name) is not None]
        if len(given) != 1:
            found = " and ".join(given) if given else "none"
            raise ParameterError(f"release: give exactly one of {', '.join(KINDS)}, got {found}")
        for key, kinds in KINDS_OF.items():
            if self._is_set(key) and self.kind not in kinds:
                raise ParameterError(
                    f"release: {key} belongs to {' or '.join(kinds)}, not to {self.kind}; leave it out"
                )
        for names in (("depth", "largest_depth", "volume"), ("velocity", "speed")):
            if len(given := [name for name in names if self._is_set(name)]) > 1:
                raise ParameterError(f"release: give {' or '.join(given)}, not both")
        if self.from_ == "above" and self.failure_surface is not None:
            raise ParameterError(
                "release: failure_surface shapes a body that fails out of the ground, but from is above; leave one "
                "of them out"
            )
        if self.kind == "points":
            self._check_hydrograph()

    def _is_set(self, key: str) -> bool:
        value = getattr(self, "from_" if key == "from" else key)
        return value is not None and (key != "from" or value != "ground")

    def _check_hydrograph(self):
        needed = ("hydrograph", "speed", "width")
        if missing := [key for key in needed if getattr(self, key) is None]:
            raise ParameterError(
                f"release: points need {', '.join(needed)}; missing: {', '.join(missing)}; the thickness of the inflow "
                "is discharge over speed times width"
            )
        if self.speed == 0.0:
            raise ParameterError("release: speed must be more than 0 m s-1 at points, got 0.0; nothing would flow in")
