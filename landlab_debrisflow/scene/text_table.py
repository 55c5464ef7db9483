"""Tables in text files, as spreadsheets and scripts write them."""

import csv
import io
from pathlib import Path

from ..core.errors import InputError
from ..geo.names import find_file

MOST_BYTES = 5_000_000


def table_rows(path: Path, wanted: str) -> list[tuple[int, list[str]]]:
    r"""Return number and cells of every line of a table that is not empty and no comment (#).

    Columns are separated by semicolons, tabs, commas or blanks, the first of these that the first line has.

    Parameters
    ----------
    path : Path
    wanted : str
        What the table should hold, for messages.

    Returns
    -------
    list of (int, list of str)
        At least one line; cells without blanks around them.

    Raises
    ------
    InputError
        If the file cannot be read as text, is empty or is larger than 5 MB.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder) / "members.csv"
    ...     _ = path.write_text("# of the survey\nangle; factor\n25,5; 1\n")
    ...     table_rows(path, "a line for each member")
    [(2, ['angle', 'factor']), (3, ['25,5', '1'])]
    """
    try:
        path, _ = find_file(path)
        if path.stat().st_size > MOST_BYTES:
            raise InputError(f"cannot read {path}: it has more than {MOST_BYTES / 1e6:g} MB; give {wanted}")
        text = path.read_text(encoding="utf-8-sig")
    except (OSError, UnicodeDecodeError, ValueError) as error:
        if isinstance(error, InputError):
            raise
        reason = getattr(error, "strerror", None) or "it is no text in UTF-8"
        raise InputError(f"cannot read {path}: {reason}; give {wanted}") from error
    if "\0" in text:
        raise InputError(f"cannot read {path}: it is no text; give {wanted}")
    lines = [(k, line) for k, line in enumerate(text.splitlines(), 1) if line.strip() and not line.startswith("#")]
    if not lines:
        raise InputError(f"{path} is empty; give {wanted}")
    mark = next((mark for mark in (";", "\t", ",") if mark in lines[0][1]), None)
    if mark is None:
        return [(k, line.split()) for k, line in lines]
    try:
        return [
            (k, [cell.strip() for cell in next(csv.reader(io.StringIO(line), delimiter=mark, skipinitialspace=True))])
            for k, line in lines
        ]
    except csv.Error as error:
        raise InputError(f"cannot read {path} as a table: {error}") from error
