"""The command line: ``landlab-debrisflow demo`` and ``landlab-debrisflow info``."""

import argparse
import sys
from pathlib import Path

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from .. import __version__
from ..core.errors import InputError, ParameterError
from ..physics.registry import LAWS
from . import laws

USER_ERROR = 2


def main(argv=None) -> int:
    """Run a command.

    Parameters
    ----------
    argv : sequence of str, optional
        Words of the command line without the program; by default from the process.

    Returns
    -------
    int
        0; or 2 if an argument or a file is not usable, with one line on standard error saying why.
    """
    arguments = _parser().parse_args(argv)
    try:
        arguments.command(arguments)
    except (InputError, ParameterError) as error:
        print(f"landlab-debrisflow: {' '.join(str(error).split())}", file=sys.stderr)
        return USER_ERROR
    return 0


def _parser():
    parser = argparse.ArgumentParser(
        prog="landlab-debrisflow", description="Debris flows that pick up wet ground on their way."
    )
    parser.add_argument("--version", action="version", version=f"%(prog)s {__version__}")
    commands = parser.add_subparsers(required=True, metavar="command")

    demo = commands.add_parser("demo", help="run a valley like Tsing Shan with two models and compare them")
    demo.add_argument("--particles", type=int, default=1500, help="number of particles (default: %(default)s)")
    demo.add_argument("--output-dir", type=Path, default=Path(), help="where demo.nc and demo.png go (default: here)")
    demo.set_defaults(command=_demo)

    info = commands.add_parser(
        "info", help="list all laws and parameters with formula, source, units, defaults and bounds"
    )
    info.add_argument("--markdown", action="store_true", help="as the page docs/laws.md")
    info.set_defaults(command=_info)

    run = commands.add_parser("run", help="run a scene file and write its maps")
    run.add_argument("scene", type=Path, help="the scene file")
    run.set_defaults(command=_run)
    return parser


def _run(arguments):
    from ..run.runner import run_scene
    from ..run.scene import Scene

    print(run_scene(Scene.from_file(arguments.scene)))


def _demo(arguments):
    from .demo import run_demo  # matplotlib and landlab load slowly: `info` does without

    run_demo(arguments.particles, arguments.output_dir, Console())


def _info(arguments):
    if arguments.markdown:
        sys.stdout.write(laws.markdown())
        return
    console = Console()
    for kind in LAWS:
        for number, entry in enumerate(laws.law_entries(kind)):
            _show(console, entry, " (default)" if number == 0 else "")
    for entry in laws.other_entries():
        _show(console, entry)


def _show(console, entry, remark=""):
    """Print formula, source and parameters of a declared class.

    `console` is of rich, `entry` an `Entry` of cli/laws.py, `remark` text behind its title.
    """
    words = ": ".join(filter(None, (entry.formula, entry.summary)))
    console.print(f"[bold]{entry.title}{remark}[/bold]  {escape(words)}", highlight=False)
    if entry.source:
        console.print(f"  [dim]{escape(entry.source)}[/dim]", highlight=False)
    if not entry.rows:
        console.print("  no parameters\n", highlight=False)
        return
    table = Table(box=None, pad_edge=True, header_style="dim")
    for heading in laws.HEADINGS:
        table.add_column(heading, overflow="fold", no_wrap=heading == "parameter")  # names stay whole
    for row in entry.rows:
        table.add_row(*map(escape, row))
    console.print(table, "", highlight=False)


if __name__ == "__main__":
    sys.exit(main())
