"""Scene files as mappings of plain values."""

from pathlib import Path
from typing import Any

from ..core.errors import InputError


def read_yaml(path: str | Path) -> dict[str, Any]:
    """Read a YAML file that holds a mapping.

    Parameters
    ----------
    path : str or Path

    Returns
    -------
    dict

    Raises
    ------
    InputError
        If the file cannot be read or is no mapping.
    """
    import yaml

    path = Path(path)
    try:
        mapping = yaml.safe_load(path.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError, yaml.YAMLError) as error:
        raise InputError(f"cannot read {path}: {error}") from error
    if not isinstance(mapping, dict):
        raise InputError(f"{path}: a scene is a mapping with the key terrain, got {type(mapping).__name__}")
    return mapping
