"""Fill the tables of docs/accuracy.md from result files."""


def fill():
    """Write tables between markers; yield the pages that changed."""
    return iter(())
