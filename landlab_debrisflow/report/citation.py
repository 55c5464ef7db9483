"""Citation of the package and its paper in a report."""

from ..core.version import __version__
from ..record.citation import PAPER

SENTENCE = (
    "If results of this run are published, cite the package with its version, the paper of the model, and the sources "
    "of the laws that are named with the parameters."
)


def bibtex(version: str = __version__, year: str = "") -> str:
    """Return the entries of package and paper.

    Parameters
    ----------
    version : str
        Version by which the run was made.
    year : str
        Year of the run.

    Returns
    -------
    str
    """
    software = "\n".join(
        (
            "@software{landlab_debrisflow,",
            "  author = {{The landlab\\_debrisflow developers}},",
            "  title = {landlab\\_debrisflow: landslides and debris flows that pick up wet ground, as a Landlab "
            "component},",
            f"  version = {{{version}}}" + (f", year = {{{year}}}" if year else ""),
            "}",
        )
    )
    return f"{software}\n\n{PAPER.strip()}"
