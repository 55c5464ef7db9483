"""The command line ``landlab-debrisflow``: its commands, errors and exit codes."""

import argparse
import os
import sys
from collections.abc import Callable
from pathlib import Path

from .. import __version__
from ..core.errors import InputError, OutputError, ParameterError, SimulationError
from ..core.words import printable
from . import ensemble, info, plot, report, scene_commands
from .exit_codes import CANNOT_WRITE, DIVERGED, DONE, INTERNAL_ERROR, SIGNALLED, USER_ERROR, epilog
from .signals import ending_signals


def main(argv=None) -> int:
    """Run a command.

    Parameters
    ----------
    argv : sequence of str, optional
        Words of the command line without the program; by default from the process.

    Returns
    -------
    int
        Exit code, of `exit_codes`; if it is not 0, one line on standard error says why.
    """
    arguments = _parser().parse_args(argv)
    return exit_code(lambda: arguments.command(arguments))


def exit_code(command: Callable[[], int | None]) -> int:
    """Return the exit code of a command that is called; print its failure, if it fails, in one line.

    Parameters
    ----------
    command : callable
        Returns an exit code, or None if it did all.

    Returns
    -------
    int
    """
    with ending_signals() as ending:
        try:
            return command() or DONE
        except OutputError as error:
            return _fail(error, CANNOT_WRITE)
        except (InputError, ParameterError) as error:
            return _fail(error, USER_ERROR)
        except SimulationError as error:
            return _fail(error, DIVERGED)
        except BrokenPipeError:  # the reader of standard output has ended, as `head` does
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
            return DONE
        except OSError as error:
            return _fail(error, CANNOT_WRITE)
        except KeyboardInterrupt as error:
            return _fail(error, SIGNALLED + ending.number)
        except MemoryError as error:
            return _fail(error, USER_ERROR, "not enough memory; take a coarser spacing, a window or fewer particles")
        except Exception as error:
            if os.environ.get("LANDLAB_DEBRISFLOW_TRACEBACK"):
                raise
            words = f"internal error, {type(error).__name__}: {error}; set LANDLAB_DEBRISFLOW_TRACEBACK=1 to see where"
            return _fail(error, INTERNAL_ERROR, words)


def _fail(error: BaseException, code: int, words: str = "") -> int:
    """Print an error in one line on standard error; return the exit code."""
    if isinstance(error, KeyboardInterrupt):
        words = "interrupted"
    elif isinstance(error, OSError) and not words:
        place = f" {error.filename}" if error.filename else ""
        words = f"cannot write or read{place}: {error.strerror or error}"
    text = ", ".join([words or str(error), *getattr(error, "__notes__", ())])
    print(f"landlab-debrisflow: {printable(text)}", file=sys.stderr)
    return code


def _parser():
    parser = argparse.ArgumentParser(
        prog="landlab-debrisflow", description="Debris flows that pick up wet ground on their way.", epilog=epilog(),
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )  # fmt: skip
    parser.add_argument("--version", action="version", version=f"%(prog)s {__version__}")
    commands = parser.add_subparsers(required=True, metavar="command")
    scene_commands.add_commands(commands)
    ensemble.add_command(commands)
    plot.add_command(commands)
    report.add_command(commands)
    info.add_command(commands)

    demo = commands.add_parser("demo", help="run a valley like Tsing Shan with two models and compare them")
    demo.add_argument("--particles", type=int, default=1500, help="number of particles (default: %(default)s)")
    demo.add_argument("--output-dir", type=Path, default=Path(), help="where demo.nc and demo.png go (default: here)")
    demo.set_defaults(command=_demo)
    return parser


def _demo(arguments):
    from rich.console import Console

    from ..core.compilations import compilations
    from ..record.monitor import COMPILING
    from .demo import run_demo  # matplotlib and landlab load slowly: `info` does without

    with compilations(lambda: print(COMPILING, file=sys.stderr, flush=True)):
        run_demo(arguments.particles, arguments.output_dir, Console())


if __name__ == "__main__":
    sys.exit(main())
