"""Write the report of a run."""

import os
from pathlib import Path

from ..record.files import check_writable, write_atomically
from ..run.files import PAGE
from ..run.results import Results
from .content import gather_content
from .page import render_page


def write_report(results: str | os.PathLike[str] | Results, output: str | os.PathLike[str] | None = None) -> Path:
    """Write the report of a run as one HTML page: summary, input, parameters, maps, volumes, versions, citation.

    Pictures and styles are in the page itself; it loads nothing from a network or a disk, and runs no script. The
    report of an unfinished run says so at its head.

    Parameters
    ----------
    results : str, os.PathLike or Results
        Directory of the results of a scene, or the results as `Scene.run` returns them.
    output : str or os.PathLike, optional
        The file; by default ``report.html`` in the directory of the results. It is replaced if it exists.

    Returns
    -------
    pathlib.Path
        Where the page is.

    Raises
    ------
    InputError
        If the directory holds no run, or a file of it is damaged.
    OutputError, OSError
        If the page cannot be written.
    """
    if not isinstance(results, Results):
        results = Results(Path(results))
    path = check_writable(results.directory / PAGE if output is None else output)
    page = render_page(gather_content(results))
    return write_atomically(path, lambda temporary: temporary.write_text(page, encoding="utf-8"))
