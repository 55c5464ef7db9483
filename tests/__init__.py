"""Tests of the whole package; the folders mirror it."""
