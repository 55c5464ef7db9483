"""The USGS debris-flow flume: eight releases of sand, gravel and mud on a rigid bed (Iverson et al., 2010)."""

from ..event import Event
from . import measures, picture, setup

EVENT = Event(
    name="flume",
    title="USGS flume, rigid bed",
    default_set=setup.DEFAULT,
    particle_count=setup.PARTICLE_COUNT,
    measures=measures.MEASURES,
    targets=measures.TARGETS,
    run=setup.run,
    score=measures.score,
    references=measures.references,
    shown=picture.shown,
    draw=picture.draw,
    steps=picture.STEPS,
)  # fmt: skip
