"""Standard output of the commands."""

import sys

from ..core.words import printable


def say(text: str) -> None:
    """Write a line, or several, to standard output, without control characters."""
    sys.stdout.write(printable(text, lines=True) + "\n")
    sys.stdout.flush()
