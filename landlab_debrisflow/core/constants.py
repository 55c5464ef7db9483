"""Physical constants used as defaults (SI)."""

GRAVITY = 9.81
"""Standard acceleration of gravity, rounded as in Pastor et al. (2022) [m s-2]."""

THINNEST = 1e-6
"""Least thickness by which a rate of shear or a flux is divided, a grain of clay [m]: never 0."""
