"""Closed-form solutions, reached through the component."""
