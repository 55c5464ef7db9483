"""A scene of which many runs take little time, and what varies in it."""

from landlab_debrisflow.scene.gully import LATTICE

WEST, SOUTH = LATTICE.lower_left


def square(x, y, side=25.0):
    """Return a polygon with its south-western corner at a place [m] from that of the gully."""
    return [[WEST + x + dx, SOUTH + y + dy] for dx, dy in ((0, 0), (side, 0), (side, side), (0, side))]


SCENE = {
    "terrain": {"example": "gully"},
    "release": {"polygons": square(20.0, 140.0), "depth": 1.5},
    "friction": {"law": "voellmy", "basal_friction_angle": 28.0},
    "numerics": {"particle_count": 40},
    "output": {"max_duration": 4.0},
}
ANGLE = "friction.basal_friction_angle"
VARY = {
    ANGLE: {"truncated_normal": {"mean": 28.0, "sd": 2.0, "low": 20.0, "high": 36.0}},
    "release.volume": {"lognormal": {"median": 700.0, "sigma": 0.3}},
}


def same(one, other):
    """Return whether two results of a member are equal to the bit."""
    return (
        one[:2] == other[:2]
        and repr(one.measures) == repr(other.measures)
        and one[3:5] == other[3:5]
        and one.error == other.error
        and one.maps.keys() == other.maps.keys()
        and all(one.maps[name].tobytes() == other.maps[name].tobytes() for name in one.maps)
    )
