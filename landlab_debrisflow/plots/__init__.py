"""Figures made of Datasets."""

from .maps import Layer, draw_maps, save_figure

__all__ = ["Layer", "draw_maps", "save_figure"]
