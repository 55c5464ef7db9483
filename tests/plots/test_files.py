"""Figures are written whole, or refused."""

import pytest

from landlab_debrisflow import InputError
from landlab_debrisflow.plots import draw_map, save_figure

from .drawing import event


def test_figure_is_saved_or_refused(tmp_path):
    figure = draw_map(event()[0])
    starts = {"png": b"\x89PNG", "pdf": b"%PDF", "svg": b"<?xml"}
    for suffix, start in starts.items():
        assert save_figure(figure, tmp_path / f"map.{suffix}", dpi=50).read_bytes().startswith(start)
    with pytest.raises(InputError, match="does not exist"):
        save_figure(figure, tmp_path / "missing" / "map.png")
    with pytest.raises(InputError, match=r"got '.docx'; take .png, .pdf or .svg"):
        save_figure(figure, tmp_path / "map.docx")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["map.pdf", "map.png", "map.svg"]
