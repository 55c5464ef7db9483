"""The USGS debris-flow flume over an erodible bed, wet or dry (Reid et al., 2011; Iverson et al., 2011)."""

from ..event import Event
from . import measures, picture, setup

EVENT = Event(
    name="flume_entrainment",
    title="USGS flume, erodible bed",
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
