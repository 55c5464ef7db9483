"""The USGS debris-flow flume: eight releases of sand, gravel and mud on a rigid bed (Iverson et al., 2010)."""

from ..event import Event
from . import measures, picture, setup

EVENT = Event(
    name="flume",
    title="USGS flume, rigid bed",
    default_set=setup.DEFAULT,
    particle_count=1000,
    measures=measures.MEASURES,
    targets=measures.TARGETS,
    run=setup.run,
    score=measures.score,
    references=measures.references,
    draw=picture.draw,
    steps={
        "thickness": 1e-4, "pressure": 1.0, "deposit": 1e-4, "measured_thickness": 1e-4, "measured_pressure": 1.0,
    },
)  # fmt: skip
