"""Physical constants used as defaults (SI)."""

GRAVITY = 9.81
"""Standard acceleration of gravity, rounded as in Pastor et al. (2022) [m s-2]."""
