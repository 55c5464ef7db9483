"""Rules and constants of the package, replaced for a comparison."""

import importlib
from unittest import mock


def replaced(module: str, name: str, value):
    """Return a context in which a name of a module of the package, such as ``"model.entrainment"``, has a value."""
    return mock.patch.object(importlib.import_module(f"landlab_debrisflow.{module}"), name, value)
