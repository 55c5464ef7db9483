"""Animations show every time of a series with one scale, and are written whole or refused."""

import matplotlib
import numpy as np
import pytest
from matplotlib.animation import FFMpegWriter
from PIL import Image

from landlab_debrisflow import InputError
from landlab_debrisflow.plots import animate, save_animation

from .drawing import event, panels, values_of


def series(times=4):
    """Return the series of a slab that moves to the east, in a window of the grid."""
    maps, _ = event()
    window = maps[["debris_flow__depth"]].isel(x=slice(2, 38), y=slice(5, 16)).expand_dims(time=10.0 * np.arange(times))
    column, first = np.arange(36), 2 + 5 * np.arange(times)[:, None, None]
    depth = np.where((column >= first) & (column < first + 4), 1.0 + first / 10.0, 0.0)
    return maps, window.assign(debris_flow__depth=window.debris_flow__depth * 0.0 + depth)


def test_frames_show_the_flow_where_it_is_with_one_scale(tmp_path):
    maps, moving = series()
    drawn = animate(moving, maps)
    axes = panels(drawn._fig)[0]
    for number in (0, 3):
        drawn._func(number)
        shown = np.ma.filled(values_of(axes).get_array(), np.nan)
        assert axes.get_title(loc="left") == f"Depth of the flow after {10.0 * number:.1f} s"
        assert np.nanmax(shown) == pytest.approx(1.2 + 0.5 * number) and np.isnan(shown).any()
    assert values_of(axes).get_clim() == (0.0, 2.7)
    path = save_animation(drawn, tmp_path / "depth.gif", frames_per_second=5, dpi=40)
    with Image.open(path) as image:
        assert image.n_frames >= 4


def test_long_series_are_thinned_and_a_relief_is_not_needed(tmp_path):
    _, moving = series(times=9)
    drawn = animate(moving, frames=3, contours=False)
    save_animation(drawn, tmp_path / "depth.gif", dpi=30)
    with Image.open(tmp_path / "depth.gif") as image:
        assert 3 <= image.n_frames <= 4


def test_what_cannot_be_animated_is_refused(tmp_path):
    maps, moving = series()
    with pytest.raises(InputError, match=r"no map 'dept' over time \(did you mean 'depth'\?\)"):
        animate(moving, maps, "dept")
    with pytest.raises(InputError, match="frames must lie in"):
        animate(moving, maps, frames=0)
    drawn = animate(moving, maps)
    with pytest.raises(InputError, match=r"must be .gif or .mp4, got '.avi'"):
        save_animation(drawn, tmp_path / "depth.avi")
    without = matplotlib.rc_context({"animation.ffmpeg_path": "no such program"})
    with without, pytest.raises(InputError, match="needs the program ffmpeg, which is not installed; install it"):
        save_animation(drawn, tmp_path / "depth.mp4")
    save_animation(drawn, tmp_path / "depth.gif", dpi=20)  # matplotlib warns of animations that nobody saved
    assert [path.name for path in tmp_path.iterdir()] == ["depth.gif"]


@pytest.mark.slow
def test_mp4_is_written_where_ffmpeg_is(tmp_path):
    if not FFMpegWriter.isAvailable():
        pytest.skip("ffmpeg is not installed")
    maps, moving = series()
    path = save_animation(animate(moving, maps), tmp_path / "depth.mp4", dpi=40)
    assert path.read_bytes()[4:8] == b"ftyp"
