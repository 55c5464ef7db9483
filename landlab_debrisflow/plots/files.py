"""Files of figures."""

import os
from pathlib import Path

from matplotlib.figure import Figure

from ..core.errors import InputError
from ..record.files import check_writable, write_atomically


def save_figure(figure: Figure, path: str | os.PathLike[str], dpi: int = 150) -> Path:
    """Write a figure to a file, atomically; return the path.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
        As the functions of this module return it.
    path : str or os.PathLike
        The file; its suffix chooses the format, such as ``.png``, ``.pdf`` or ``.svg``.
    dpi : int
        Dots per inch of what is not drawn as lines.

    Returns
    -------
    pathlib.Path
        Where the file is.

    Raises
    ------
    InputError
        If the file cannot be written, or figures have no such format.
    """
    path = check_writable(path)
    formats = figure.canvas.get_supported_filetypes()
    if path.suffix.lower().removeprefix(".") not in formats:
        raise InputError(
            f"save_figure: the suffix of {path.name} must be that of a format of figures, got {path.suffix!r}; take "
            ".png, .pdf or .svg"
        )
    # a figure is written again to the same bytes
    metadata = {"pdf": {"CreationDate": None}, "svg": {"Date": None}}.get(path.suffix.lower().removeprefix("."))
    return write_atomically(path, lambda temporary: figure.savefig(temporary, dpi=dpi, metadata=metadata))
