"""Figure of a landslide: observed beside modelled change of elevation, and where they agree."""

import xarray as xr
from matplotlib.figure import Figure

from landlab_debrisflow.plots import Layer, draw_maps


def draw(result: xr.Dataset) -> Figure:
    """Return the figure of a landslide from its stored result."""
    panels = {
        "observed (lidar)": result.observed_change,
        f"modelled: {result.attrs['set']}": result.modelled_change,
        "modelled − observed": result.modelled_change - result.observed_change,
    }
    layer = Layer(panels, "change of elevation, red: lowered, blue: raised [m]", "RdBu", (-4.0, 4.0), threshold=0.2)
    return draw_maps([layer], result.elevation, outline=result.source == 1, note="outlined: source")
