"""Names that files and attributes allow."""

import re


def legal_name(name: str) -> str:
    """Return a name in letters, digits and underscores; other characters become ``u`` and their number in Unicode."""
    return re.sub("[^A-Za-z0-9_]", lambda other: f"u{ord(other[0]):x}", name)
