"""The command line: ``landlab-debrisflow demo`` and ``landlab-debrisflow info``."""

import argparse
import dataclasses
import inspect
import math
import sys
from pathlib import Path

from rich.console import Console
from rich.table import Table

from . import __version__
from .core.errors import InputError, ParameterError
from .model.hydrograph import Hydrograph
from .model.numerics import Numerics
from .model.physics import LAWS
from .physics.material import Material

USER_ERROR = 2


def main(argv=None) -> int:
    """Run a command.

    Parameters
    ----------
    argv : sequence of str, optional
        Words of the command line without the program; those of the process by default.

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

    info = commands.add_parser("info", help="list all laws and parameters with units, defaults and bounds")
    info.set_defaults(command=_info)
    return parser


def _demo(arguments):
    from .demo import run_demo  # matplotlib and landlab load slowly: `info` does without

    run_demo(arguments.particles, arguments.output_dir, Console())


def _info(_):
    console = Console()
    for kind, laws in LAWS.items():
        for number, (name, law) in enumerate(laws.items()):
            default = " (default)" if number == 0 else ""
            _show(console, f"{kind}: {name}{default}", law)
    _show(console, "material", Material)
    _show(console, "numerics", Numerics)
    _show(console, "inflow", Hydrograph)


def _show(console, title, declared):
    """Print the parameters of a declared class and the first paragraph of what it says of itself."""
    parameters = dataclasses.fields(declared)
    words = " ".join(inspect.cleandoc(declared.__doc__ or "").split("\n\n")[0].split())
    console.print(f"[bold]{title}[/bold]  {words}", highlight=False)
    if not parameters:
        console.print("  no parameters\n", highlight=False)
        return
    table = Table(box=None, pad_edge=True, header_style="dim")
    for heading in ("parameter", "unit", "default", "allowed", "meaning"):
        table.add_column(heading, overflow="fold", no_wrap=heading == "parameter")  # names stay whole
    for parameter in parameters:
        meta = parameter.metadata
        table.add_row(parameter.name, meta["unit"], _plain(parameter.default), _allowed(meta), meta["meaning"])
    console.print(table, "", highlight=False)


def _allowed(meta):
    if meta["choices"]:
        return ", ".join(meta["choices"])
    if meta["kind"] is bool:
        return "true, false"
    low, high = meta["bounds"]
    if high < math.inf:
        return f"{low:g} to {high:g}"
    return f"{low:g} or more" if low > -math.inf else "any"


def _plain(value):
    if value is None:
        return "not set"
    if isinstance(value, bool):
        return str(value).lower()
    return value if isinstance(value, str) else f"{value:.6g}"


if __name__ == "__main__":
    sys.exit(main())
