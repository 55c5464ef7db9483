"""Names of files, with a layer, variable or band after a colon."""

from pathlib import Path

from ..core.errors import InputError
from ..core.hints import did_you_mean


def find_file(name: str | Path) -> tuple[Path, str | None]:
    """Return the file that a name means, and the word after a colon at its end.

    Parameters
    ----------
    name : str or Path
        Such as ``dem.tif``, ``map.gpkg:buildings``, ``dem.nc:elevation`` or ``bands.tif:2``.

    Returns
    -------
    path : Path
    choice : str or None
        Layer, variable or band that was asked for.

    Raises
    ------
    InputError
        If there is no such file, or the file is empty.
    """
    path, choice = Path(name), None
    try:
        if not path.exists() and ":" in path.name:
            head, _, choice = str(name).rpartition(":")
            path = Path(head)
        if not path.exists():
            raise InputError(f"cannot read {name}: there is no such file{_similar(path)}")
        if not (path.is_file() or path.is_dir()):
            raise InputError(f"cannot read {path}: it is a device or a pipe; give the name of a file")
        if path.is_file() and path.stat().st_size == 0:
            raise InputError(f"cannot read {path}: the file is empty")
    except (OSError, ValueError) as error:  # the name is too long or holds a zero byte
        if isinstance(error, InputError):
            raise
        raise InputError(f"cannot read {name}: {error}") from error
    return path, choice


def _similar(path: Path) -> str:
    """Return the question after a file of the same directory, or the note that the directory is missing."""
    if not path.parent.is_dir():
        return f" (nor the directory {path.parent})"
    return did_you_mean(path.name, [other.name for other in path.parent.iterdir()])


def said(notes: list[str] | None, note: str) -> None:
    """Append a note to the list of notes, if there is one."""
    if notes is not None:
        notes.append(note)


def reason_of(error: BaseException) -> str:
    """Return the message of the first cause of a failure, in one line and without advice on the library."""
    while error.__cause__ is not None:
        error = error.__cause__
    return " ".join(str(error).split("; It might help")[0].split()).rstrip(". ") or type(error).__name__


def import_error(error: ImportError) -> InputError:
    """Return the refusal for a library of the extra `geo` that is not installed."""
    return InputError(f'files of a GIS need {error.name}: pip install "landlab_debrisflow[geo]"')
