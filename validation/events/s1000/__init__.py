"""S-1000: a landslide in Washington, December 2021, with lidar before and after (Keck et al., 2024)."""

from functools import partial

from ..event import Event, Target
from . import measures, picture, setup

BOTH = ("s1000", "cascade2009")
TARGETS = (
    Target("csi outside", "mean CSI outside the source, both landslides with one set, ≥ 0.50", low=0.50, events=BOTH),
    Target("correlation outside", "mean correlation outside, both with one set, ≥ +0.40", low=0.40, events=BOTH),
)
EVENT = Event(
    name="s1000",
    title="S-1000, landslide of 2021",
    default_set="traction_roots",
    particle_count=2000,
    measures=measures.MEASURES,
    targets=(
        *TARGETS,
        Target("in scar", "left in the scar, observed 1411 m³: 411 to 2411 m³", low=411.0, high=2411.0),
    ),
    run=partial(setup.run_landslide, "s1000"),
    score=measures.score,
    references=measures.references,
    shown=picture.shown,
    draw=picture.draw,
    steps=picture.STEPS,
)  # fmt: skip
