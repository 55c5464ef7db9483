"""Rio Olivares, Chile: six mapped debris flows, run with one set (inventory of Goetz et al., 2021)."""

import xarray as xr

from ..event import Event, Target
from . import picture
from .baseline import steepest_paths, widened_paths
from .leave_one_out import best_measures, chosen_measures
from .measures import MEASURES, WET, ceilings, compare, summary
from .setup import FLOWS, read_observed, run_flows


def score(result: xr.Dataset) -> dict[str, float]:
    """Return the measures of a run of the six flows."""
    observed = read_observed()
    return summary({flow: compare(result.max_depth.sel(flow=flow).values > WET, observed, flow) for flow in FLOWS})


def references(result: xr.Dataset) -> dict[str, dict[str, float]]:
    """Return the measures of the steepest path, of outlines that are changed by a cell, and of leave-one-out."""
    observed = read_observed()
    paths = steepest_paths(observed)
    named = {
        f"steepest paths, {words}": {
            flow: compare(widened_paths(observed, flow, paths[flow], others=others), observed, flow) for flow in FLOWS
        }
        for words, others in (("reach and width of the flow", False), ("travel angle and width of the others", True))
    } | ceilings(observed)
    if chosen := chosen_measures():
        named["chosen on the five others"] = chosen
        named["best of the family for each flow, found afterwards"] = best_measures()
    return {words: summary(single) for words, single in named.items()}


EVENT = Event(
    name="olivares",
    title="Rio Olivares, six debris flows",
    default_set="literature",
    particle_count=2000,
    measures=MEASURES,
    targets=(
        Target("median iou", "median IoU of six flows with one set, ≥ 0.50", low=0.50),
        Target("right reaches", "farthest wet cell within 300 m of the mapped toe, four of six", low=4.0),
    ),
    run=run_flows,
    score=score,
    references=references,
    shown=picture.shown,
    draw=picture.draw,
    steps=picture.STEPS,
    drawn_with="dem.asc",
)
