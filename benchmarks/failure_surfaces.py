"""Failure surfaces of four kinds, on a plane and in the polygon of S-1000: python -m benchmarks.failure_surfaces

Keeps benchmarks/results/failure_surfaces.nc, from which docs/figures/failure_surfaces.png is drawn. Rasters of S-1000
are read from the folder $DEBRISFLOW_DATA.
"""

import argparse

import numpy as np
import xarray as xr

from benchmarks import charts, result_files, style
from benchmarks.releases import KINDS, S1000_CELL, WORDS, read_s1000, square_on_plane
from landlab_debrisflow.scene import failing_depth

COMMAND = "python -m benchmarks.failure_surfaces"
BOX = (10.0, 70.0, 50.0, 110.0)
"""West, east, south and north of the map of the square [m]."""

MARGIN = 2
"""Nodes around the scar of S-1000."""


def on_grid(grid, values, rows=slice(None), columns=slice(None)):
    """Return node values as rows and columns, those of a part of the raster."""
    return np.reshape(values, grid.shape)[rows, columns]


def measure() -> xr.Dataset:
    """Return ground and depth of the kinds on a plane of 30 degrees, and of S-1000, observed and modelled."""
    grid, inside = square_on_plane(30.0, 1.0)
    near = {"rows": slice(45, 116), "columns": slice(5, 80)}
    depths = [on_grid(grid, failing_depth(grid, inside, kind=kind, mean_depth=2.0), **near) for kind in KINDS]
    found = {
        "plane_depth": (("kind", "plane_y", "plane_x"), np.array(depths)),
        "plane_ground": (
            ("plane_y", "plane_x"), on_grid(grid, grid.at_node["topographic__elevation"], **near),
        ),
    }  # fmt: skip
    places = {"plane_x": grid.x_of_node[: grid.shape[1]][near["columns"]],
              "plane_y": on_grid(grid, grid.y_of_node)[near["rows"], 0], "kind": list(KINDS)}  # fmt: skip
    read = read_s1000()
    if read is None:
        raise SystemExit("the figure shows S-1000, too: give the folder of its rasters in $DEBRISFLOW_DATA")
    grid, observed = read
    scar, volume = observed > 0.0, observed.sum() * S1000_CELL**2
    rows, columns = np.nonzero(on_grid(grid, scar))
    near = {
        "rows": slice(rows.min() - MARGIN, rows.max() + MARGIN + 1),
        "columns": slice(columns.min() - MARGIN, columns.max() + MARGIN + 1),
    }
    bodies = [observed, *(failing_depth(grid, scar, kind=kind, volume=volume) for kind in KINDS[1:])]
    closed = grid.status_at_node == grid.BC_NODE_IS_CLOSED
    ground = np.where(closed, np.nan, grid.at_node["topographic__elevation"])
    found["scar_depth"] = (("body", "y", "x"), np.array([on_grid(grid, depth, **near) for depth in bodies]))
    found["scar_ground"] = (("y", "x"), on_grid(grid, ground, **near))
    places |= {"x": on_grid(grid, grid.x_of_node, **near)[0], "y": on_grid(grid, grid.y_of_node, **near)[:, 0]}
    return xr.Dataset(found, places | {"body": ["observed", *KINDS[1:]]})


def chart():
    """Return the figure: long sections and maps of the kinds, and the scar of S-1000."""
    found = result_files.read_dataset("failure_surfaces")
    figure, axes = style.panels(3, len(KINDS), (12.0, 8.2), height_ratios=[0.62, 1.0, 1.25])
    plane = found.plane_ground.rename(plane_x="x", plane_y="y")
    for column, kind in zip(axes.T, KINDS, strict=True):
        depth = found.plane_depth.sel(kind=kind).rename(plane_x="x", plane_y="y")
        draw_section(column[0], plane, depth)
        column[0].set_title(f"{WORDS.get(kind, kind)}: {float(depth.max()):.1f} m at the deepest", fontsize=10)
        square = draw_map(column[1], plane, depth, 4.0)
        column[1].set(xlim=BOX[:2], ylim=BOX[2:], xlabel="x [m]")
    for axis, body in zip(axes[2], found.body.values, strict=True):
        depth = found.scar_depth.sel(body=body)
        scar = draw_map(axis, found.scar_ground, depth, 16.0)
        axis.set_title(f"S-1000, {WORDS.get(body, body)}: {float(depth.max()):.1f} m deepest", fontsize=10)
        axis.set_xlabel("easting [m]")
        axis.ticklabel_format(useOffset=False, style="plain")
        axis.tick_params(axis="x", rotation=30)
        axis.locator_params(nbins=4)
    axes[0, 0].set_ylabel("elevation [m]")
    axes[1, 0].set_ylabel("y [m]")
    axes[2, 0].set_ylabel("northing [m]")
    figure.colorbar(square, ax=axes[1], label="depth, 2 m on average [m]")
    figure.colorbar(scar, ax=axes[2], label="depth of the observed volume [m]")
    figure.suptitle("A square of 40 m on a plane of 30°, and the scar of S-1000; contours of the ground every 5 m")
    return figure


def draw_section(axis, ground, depth) -> None:
    """Draw ground and floor along the middle row, and the level of the lower lip."""
    row = depth.sizes["y"] // 2
    x, z, taken = ground.x.values, ground[row].values, depth[row].values
    axis.fill_between(x, z - taken, z, color=style.ORANGE, alpha=0.5)
    axis.plot(x, z, "k", lw=1.0)
    axis.plot(x, z - taken, color=style.RED, lw=1.2)
    lip = z[np.flatnonzero(taken)[-1] + 1]
    axis.axhline(lip, color="0.4", lw=0.8, ls=":")
    axis.text(x[0], lip, "lower lip", fontsize=8, va="bottom", color="0.3")
    axis.set(aspect="equal", xlabel="x [m]")


def draw_map(axis, ground, depth, most: float):
    """Draw a depth over ``y`` and ``x`` [m], with contours of the ground."""
    shown = axis.pcolormesh(
        ground.x, ground.y, depth.where(depth > 0.0), cmap="YlOrRd", vmin=0.0, vmax=most, shading="nearest"
    )
    levels = np.arange(float(ground.min()) // 5 * 5.0, float(ground.max()), 5.0)
    axis.contour(ground.x, ground.y, ground, levels, colors="0.5", linewidths=0.5)
    axis.set(aspect="equal")
    return shown


def main() -> None:
    argparse.ArgumentParser(description=__doc__.splitlines()[0]).parse_args()
    steps = {"plane_depth": 1e-3, "plane_ground": 1e-2, "scar_depth": 1e-3, "scar_ground": 0.05}
    result_files.keep_dataset("failure_surfaces", measure(), COMMAND, steps)
    charts.make("failure_surfaces")


if __name__ == "__main__":
    main()
