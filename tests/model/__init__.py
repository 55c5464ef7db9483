"""Tests of state and time."""
