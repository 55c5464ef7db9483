"""Physical constants used as defaults (SI), and the shortest of all intervals."""

import sys

GRAVITY = 9.81
"""Standard acceleration of gravity, rounded as in Pastor et al. (2022) [m s-2]."""

EVERY_STEP = sys.float_info.min
"""Interval of observers that look before the first step of a call and after each of its steps [s]: no step is so short,
so each crosses a multiple of it."""
