"""The command that writes the report of a run or of an ensemble."""

from pathlib import Path

from ..run.files import STORE
from .exit_codes import DONE
from .messages import messages
from .output import say


def add_command(commands) -> None:
    """Add the command to a parser's."""
    words = "write a report of a run or an ensemble: one HTML page with its pictures, to be read, printed or sent"
    report = commands.add_parser("report", help=words, description=f"{words[0].upper()}{words[1:]}.")
    report.add_argument("directory", type=Path, help="directory of the results of a scene or of its ensemble")
    report.add_argument("--output", type=Path, metavar="FILE", help="file to be written (default: report.html there)")
    report.set_defaults(command=_report)


def _report(arguments) -> int:
    from ..report import write_ensemble_report, write_report  # matplotlib loads slowly: `info` does without

    with messages():
        write = write_ensemble_report if (arguments.directory / STORE).is_dir() else write_report
        path = write(arguments.directory, arguments.output)
    say(f"wrote {path}")
    return DONE
