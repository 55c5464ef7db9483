"""Figures made of Datasets."""

from .animation import animate, save_animation
from .column import draw_column
from .comparison import Layer, draw_maps
from .files import save_figure
from .hydrographs import draw_gauges, draw_hydrographs
from .maps import draw_map
from .overview import draw_overview
from .probability import draw_danger_levels, draw_probability
from .section import draw_section
from .thalweg import trace_thalweg
from .time_distance import draw_time_distance
from .tracks import draw_tracks
from .volumes import draw_volumes

__all__ = [
    "Layer",
    "animate",
    "draw_column",
    "draw_danger_levels",
    "draw_gauges",
    "draw_hydrographs",
    "draw_map",
    "draw_maps",
    "draw_overview",
    "draw_probability",
    "draw_section",
    "draw_time_distance",
    "draw_tracks",
    "draw_volumes",
    "save_animation",
    "save_figure",
    "trace_thalweg",
]
