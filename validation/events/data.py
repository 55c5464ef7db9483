"""Places of measured data: $DEBRISFLOW_DATA, else ../shared/data beside the checkout. None is in the repository."""

import os
from pathlib import Path

from landlab_debrisflow.core.errors import InputError

BESIDE = Path(__file__).parents[3] / "shared" / "data"


def find_file(folder: str, name: str) -> Path:
    """Return the path of a file of measured data.

    Parameters
    ----------
    folder : str
        Folder of an event below the data, such as ``s1000``.
    name : str
        Name of the file.

    Raises
    ------
    InputError
        If the file is absent; the message tells where it was expected.
    """
    if reason := absence(folder, name):
        raise InputError(reason)
    return _place() / folder / name


def absence(folder: str, name: str) -> str:
    """Return why a file of measured data is absent, or an empty text if it is there."""
    path = _place() / folder / name
    if path.is_file():
        return ""
    origin = "$DEBRISFLOW_DATA" if os.environ.get("DEBRISFLOW_DATA") else "$DEBRISFLOW_DATA is not set, by default"
    return f"no measured data: {origin} {path.parent.parent} has no file {folder}/{name}; set DEBRISFLOW_DATA"


def _place() -> Path:
    return Path(os.environ.get("DEBRISFLOW_DATA") or BESIDE)
