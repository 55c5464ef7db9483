"""Version of the package: the version of the installed distribution, which `pyproject.toml` names."""

from importlib.metadata import version

__version__ = version("landlab_debrisflow")
