"""The command that draws the results of a run."""

from pathlib import Path

from .exit_codes import DONE
from .messages import messages
from .output import say

FORMATS, ANIMATIONS = ("png", "pdf", "svg"), ("gif", "mp4", "none")


def add_command(commands) -> None:
    """Add the command to a parser's."""
    words = "draw the results of a run: maps, long section, hydrographs, animation"
    plot = commands.add_parser("plot", help=words, description=f"{words[0].upper()}{words[1:]}.")
    plot.add_argument("directory", type=Path, help="directory of the results of a scene, or a file of it (maps.nc)")
    plot.add_argument(
        "--maps", nargs="+", metavar="NAME",
        help="maps to be drawn, such as max_depth, or all (default: an overview, its maps, and those of the scene)",
    )  # fmt: skip
    plot.add_argument("--format", choices=FORMATS, default="png", help="format of pictures (default: %(default)s)")
    plot.add_argument(
        "--animation", choices=ANIMATIONS,
        help="format of the animation of maps that were written as the run went (default: gif, if there are such maps)",
    )  # fmt: skip
    plot.add_argument("--output", type=Path, metavar="DIR", help="directory of the pictures (default: pictures there)")
    plot.add_argument("--dpi", type=int, default=150, help="dots per inch (default: %(default)s)")
    plot.set_defaults(command=_plot)


def _plot(arguments) -> int:
    from ..run.pictures import draw_pictures  # matplotlib and landlab load slowly: `info` does without

    with messages():
        for path in draw_pictures(
            arguments.directory, arguments.maps, form=arguments.format, animation=arguments.animation,
            to=arguments.output, dpi=arguments.dpi,
        ):  # fmt: skip
            say(f"wrote {path}")
    return DONE
