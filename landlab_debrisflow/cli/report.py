"""The command that writes the report of a run."""

from pathlib import Path

from .exit_codes import DONE
from .messages import messages
from .output import say


def add_command(commands) -> None:
    """Add the command to a parser's."""
    words = "write a report of a run: one HTML page with its pictures, to be read, printed or sent"
    report = commands.add_parser("report", help=words, description=f"{words[0].upper()}{words[1:]}.")
    report.add_argument("directory", type=Path, help="directory of the results of a scene")
    report.add_argument("--output", type=Path, metavar="FILE", help="file to be written (default: report.html there)")
    report.set_defaults(command=_report)


def _report(arguments) -> int:
    from ..report import write_report  # matplotlib loads slowly: `info` does without

    with messages():
        path = write_report(arguments.directory, arguments.output)
    say(f"wrote {path}")
    return DONE
