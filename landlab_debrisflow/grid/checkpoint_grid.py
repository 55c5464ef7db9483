"""Grid of a checkpoint: compared with that of a Dataset, and given its fields."""

from contextlib import contextmanager

import numpy as np

from ..core.errors import InputError
from .checks import where
from .fields import NODE_FIELDS, no_new_fields


def check_same(grid, dataset) -> None:
    """Refuse a grid that is not that of a checkpoint.

    Parameters
    ----------
    grid : RasterModelGrid
    dataset : xarray.Dataset
        As `checkpoint.capture` returned it.

    Raises
    ------
    InputError
        If shape, spacing, place, statuses or the inputs that there are differ.
    """
    corner, spacing = (tuple(np.ravel(dataset.attrs[name]).tolist()) for name in ("lower_left", "spacing"))
    for word, now, written in (
        ("shape, rows and columns,", tuple(map(int, grid.shape)), (dataset.sizes["y"], dataset.sizes["x"])),
        ("node spacing [m]", (float(grid.dx), float(grid.dy)), spacing),
        ("lower left node [m]", tuple(map(float, grid.xy_of_lower_left)), corner),
    ):
        if now != written:
            raise InputError(f"load: the grid is another one: its {word} is {now}, that of the checkpoint {written}")
    status, written = np.asarray(grid.status_at_node), dataset["node_status"].values.reshape(-1)
    if (other := np.flatnonzero(status != written)).size:
        node = other[0]
        raise InputError(
            f"load: {other.size} nodes of the grid have another status than in the checkpoint, the first is "
            f"{where(grid, node)}: {status[node]}, there {written[node]}; set grid.status_at_node to the former "
            "statuses, or load without a grid"
        )
    names = {data.attrs["field"] for data in dataset.values() if "field" in data.attrs}
    for field in NODE_FIELDS:
        if "in" in field.intent and field.name in grid.at_node and field.name not in names:
            raise InputError(
                f"load: the grid has the field {field.name!r}, without which the flow was saved; delete it first: "
                f"grid.delete_field('node', {field.name!r})"
            )


@contextmanager
def fields_of(grid, dataset):
    """Give a grid the input fields of a checkpoint; yield a function that gives it all fields.

    `dataset` is as `checkpoint.capture` returned it.
    """
    fields = {data.attrs["field"]: data for data in dataset.values() if "field" in data.attrs}
    outputs = {field.name for field in NODE_FIELDS if field.intent == "out"}
    before = {name: grid.at_node[name].copy() for name in fields if name in grid.at_node}

    def put(left_out=()):
        for name in sorted(fields.keys() - left_out):
            data = fields[name]
            values = data.values.reshape(-1)
            if name in grid.at_node:
                grid.at_node[name][:] = values
            else:
                grid.add_field(name, values.copy(), at="node", units=data.attrs["units"])

    with no_new_fields(grid):
        try:
            put(outputs)  # only after another component on the grid has put its own outputs aside
            yield put
        except BaseException:
            for name, values in before.items():
                grid.at_node[name][:] = values
            raise
