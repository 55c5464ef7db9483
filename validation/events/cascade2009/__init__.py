"""Cascade Mountains 2009: the larger, older landslide on the slope of S-1000, with lidar before and after."""

from functools import partial

from ..event import Event
from ..s1000 import TARGETS, measures, picture, setup

FAN_ROWS = 13
"""Southernmost rows, beyond row 108 of the file, where a stream carried off much of the deposit before the survey."""

EVENT = Event(
    name="cascade2009",
    title="Cascade Mountains 2009",
    default_set="traction_roots",
    particle_count=2000,
    measures=measures.MEASURES,
    targets=TARGETS,
    run=partial(setup.run_landslide, "cascade2009", fan_rows=FAN_ROWS),
    score=measures.score,
    references=measures.references,
    shown=picture.shown,
    draw=picture.draw,
    steps=picture.STEPS,
    shared_sets="s1000",
)  # fmt: skip
