"""The version of the package, for all that writes it down; `pyproject.toml` and `CITATION.cff` name the same."""

__version__ = "0.1.0"
