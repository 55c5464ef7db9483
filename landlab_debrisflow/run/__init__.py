"""Scenes as runs: files to a grid, a flow, and its results."""
