"""Extent and reach of a modelled flow against its mapped outline."""

from collections.abc import Mapping

import numpy as np
from scipy.ndimage import binary_dilation, binary_erosion

from landlab_debrisflow.calibration.agreement import csi

from ..event import Measure
from ..scores import precision, recall
from ..sets import ParameterSet
from .setup import FLOWS, Observed, run_flow

WET = 0.1
"""Least peak depth of a cell that counts as reached [m]."""
NEAR = 300.0
"""Distance of the farthest wet cell from the mapped toe within which the reach counts as right [m]."""
OFF_THALWEG = (1, 3)
"""Flows that leave the thalweg of the DEM near their fans, by the description of the data."""

MEASURES = {
    "median iou": Measure("median IoU", "{:.3f}"),
    "median iou of 2, 4, 5, 6": Measure("median IoU without 1 and 3", "{:.3f}"),
    **{f"iou {flow}": Measure(f"IoU {flow}") for flow in FLOWS},
    "median precision": Measure("median precision"),
    "median recall": Measure("median recall"),
    "right reaches": Measure("toes within 300 m", "{:.0f}"),
    **{
        f"{name} {flow}": Measure(f"{words} {flow}", form, tabulated=False)
        for name, words, form in (
            ("precision", "precision", "{:.2f}"), ("recall", "recall", "{:.2f}"), ("toe", "from the toe [m]", "{:.0f}"),
            ("reach", "reach less that of the toe [m]", "{:+.0f}"),
        )
        for flow in FLOWS
    },
}  # fmt: skip


def compare(wet: np.ndarray, observed: Observed, flow: int) -> dict[str, float]:
    """Return the measures of the cells reached by one flow.

    Parameters
    ----------
    wet : ndarray of bool, shape (rows, columns)
        Cells reached, on the whole map: nothing is cut off at the outline.
    observed : Observed
    flow : int

    Returns
    -------
    dict
        iou, precision, recall [-]; toe: distance of the farthest wet cell from the mapped toe [m]; reach: distance of
        the farthest wet cell from the source point less that of the toe [m]. Farthest is from the source point, in
        plan; NaN if no cell is wet.
    """
    mapped = observed.flow == flow
    found = {"iou": csi(wet, mapped), "precision": precision(wet, mapped), "recall": recall(wet, mapped)}
    found |= {"toe": np.nan, "reach": np.nan}
    if wet.any():
        end, toe = farthest(wet, observed, flow), farthest(mapped, observed, flow)
        start = observed.points[flow]
        found["toe"] = float(np.hypot(end[0] - toe[0], end[1] - toe[1]))
        found["reach"] = float(np.hypot(*np.subtract(end, start)) - np.hypot(*np.subtract(toe, start)))
    return found


def farthest(cells: np.ndarray, observed: Observed, flow: int) -> tuple[float, float]:
    """Return the map coordinates of the cell that is farthest from the source point in plan [m]."""
    rows, columns = np.nonzero(cells)
    x, y = observed.corner[0] + observed.spacing * columns, observed.corner[1] + observed.spacing * rows
    start = observed.points[flow]
    at = np.argmax(np.hypot(x - start[0], y - start[1]))
    return float(x[at]), float(y[at])


def summary(single: Mapping[int, Mapping[str, float]]) -> dict[str, float]:
    """Return the measures of all flows: medians, the number of right reaches, and the extent of every flow."""
    on_thalweg = [flow for flow in FLOWS if flow not in OFF_THALWEG]
    found = {
        "median iou": float(np.median([single[flow]["iou"] for flow in FLOWS])),
        "median iou of 2, 4, 5, 6": float(np.median([single[flow]["iou"] for flow in on_thalweg])),
        "median precision": float(np.nanmedian([single[flow]["precision"] for flow in FLOWS])),
        "median recall": float(np.median([single[flow]["recall"] for flow in FLOWS])),
        "right reaches": float(sum(single[flow]["toe"] <= NEAR for flow in FLOWS)),
    }
    for flow in FLOWS:
        found |= {f"{name} {flow}": single[flow][name] for name in ("iou", "precision", "recall", "toe", "reach")}
    return found


def measure_flow(
    observed: Observed, flow: int, parameters: ParameterSet, particle_count: int, shift=(0.0, 0.0)
) -> dict[str, float]:
    """Return the measures of one flow, run with a set of parameters; `shift` is that of `setup.build_grid`."""
    model = run_flow(observed, flow, parameters, particle_count, shift)
    return compare(model.maps["debris_flow__max_depth"].values > WET, observed, flow)


def ceilings(observed: Observed) -> dict[str, dict[int, dict[str, float]]]:
    """Return the measures of every outline itself, one cell wider, narrower, and shifted by one cell, by their words.

    Outlines are known to 25 m, two cells, at their toes: a perfect model cannot be told from one with these scores.
    """
    found: dict[str, dict[int, dict[str, float]]] = {}
    for flow in FLOWS:
        mapped = observed.flow == flow
        changed = {
            "outline, one cell wider": [binary_dilation(mapped)],
            "outline, one cell narrower": [binary_erosion(mapped)],
            "outline, shifted by one cell": [np.roll(mapped, step, axis) for axis in (0, 1) for step in (-1, 1)],
        }
        for words, others in changed.items():
            measured = [compare(each, observed, flow) for each in others]
            means = {name: float(np.mean([each[name] for each in measured])) for name in measured[0]}
            found.setdefault(words, {})[flow] = means
    return found
