"""Commands about scenes: new, check, run, resume, export, schema."""

import argparse
import json
from pathlib import Path

from ..core.words import grouped
from ..record.monitor import COMPILING
from .exit_codes import DONE, STILL_MOVING, epilog
from .messages import messages
from .output import say

FORMATS = ("netcdf", "zarr", "geotiff")
"""Formats of maps that were written as a run went."""


def add_commands(commands) -> None:
    """Add the commands about scenes to the commands of a parser."""
    new = command(commands, "new", _new, "write a commented scene file, of an example or of files of your own")
    new.add_argument("scene", type=Path, help="scene file to be written")
    new.add_argument(
        "--from", nargs=2, dest="files", metavar=("DEM", "RELEASE"),
        help="raster of the elevation, and polygons, a raster of depths or points of the release",
    )  # fmt: skip
    new.add_argument("--crs", help="coordinate reference system of a DEM that names none, such as EPSG:32633")
    new.add_argument("--full", action="store_true", help="with every key of every law, not only the usual ones")

    check = command(commands, "check", _check, "check a scene file and forecast its run; nothing is written")
    check.add_argument("scene", type=Path, help="scene file")
    add_message_options(check)

    run = command(commands, "run", _run, "run a scene file and write its results", epilog())
    run.add_argument("scene", type=Path, help="scene file")
    run.add_argument("--overwrite", action="store_true", help="replace results of an earlier run in its directory")
    add_message_options(run)

    resume = command(commands, "resume", _resume, "go on with a run that was interrupted", epilog())
    resume.add_argument("scene", type=Path, help="directory of its results, or scene file")
    add_message_options(resume)

    export = command(commands, "export", _export, "make one file, or GeoTIFFs, of the maps that a run wrote as it went")
    export.add_argument("directory", type=Path, help="directory of the results of a scene")
    export.add_argument("--to", choices=FORMATS, default=FORMATS[0], help="format (default: %(default)s)")

    schema = command(
        commands, "schema", _schema, "print the JSON schema of scene files, by which editors complete them"
    )
    schema.add_argument("file", nargs="?", type=Path, help="file to be written; standard output by default")


def command(commands, name: str, function, words: str, end: str | None = None):
    """Add a command to a parser of commands; return the parser of the command."""
    parser = commands.add_parser(
        name, help=words, description=f"{words[0].upper()}{words[1:]}.", epilog=end,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )  # fmt: skip
    parser.set_defaults(command=function)
    return parser


def add_message_options(parser) -> None:
    """Add the options for messages to the parser of a command."""
    parser.add_argument("--quiet", "-q", action="store_true", help="write errors only")
    parser.add_argument(
        "--verbose", "-v", action="store_true", help="write further messages of the package, besides warnings"
    )
    parser.add_argument("--log", type=Path, metavar="FILE", help="append all messages to a file, progress as well")


def _new(arguments) -> int:
    from ..scene.new_scene import new_scene

    with messages():
        path = new_scene(arguments.scene, *(arguments.files or ()), crs=arguments.crs, full=arguments.full)
    say(f"wrote {path}; next: landlab-debrisflow check {path}")
    return DONE


def _export(arguments) -> int:
    from ..run.export import export

    with messages():
        for path in export(arguments.directory, arguments.to):
            say(str(path))
    return DONE


def _schema(arguments) -> int:
    from ..record.files import write_atomically
    from ..scene.schema import scene_schema

    text = json.dumps(scene_schema(), indent=1, ensure_ascii=False) + "\n"
    if arguments.file is None:
        say(text.rstrip())
    else:
        write_atomically(arguments.file, lambda path: path.write_text(text, encoding="utf-8"))
    return DONE


def _check(arguments) -> int:
    from ..core.compilations import compilations
    from ..ensemble import Ensemble
    from ..run.check import check
    from ..run.scene import Scene

    with messages(arguments.quiet, arguments.verbose, arguments.log) as monitor:
        scene = Scene.from_file(arguments.scene)
        ensemble = None if scene.content.ensemble is None else Ensemble.of_scene(scene)
        with compilations(lambda: monitor.say(COMPILING)):
            found = check(scene, monitor.say)
        monitor.close()
        if not arguments.quiet:
            say(str(found))
            if ensemble is not None:
                say(f"ensemble: {ensemble.members} members, {ensemble.sampling}, of {', '.join(ensemble.keys)}")
    return DONE


def _run(arguments) -> int:
    from ..run.runner import run_scene  # landlab loads slowly: `info` does without
    from ..run.scene import Scene

    with messages(arguments.quiet, arguments.verbose, arguments.log) as monitor:
        scene = Scene.from_file(arguments.scene)
        return _tell(run_scene(scene, overwrite=arguments.overwrite, monitor=monitor), arguments.quiet)


def _resume(arguments) -> int:
    from ..run.resume import resume

    with messages(arguments.quiet, arguments.verbose, arguments.log) as monitor:
        return _tell(resume(arguments.scene, monitor=monitor), arguments.quiet)


def _tell(results, quiet: bool) -> int:
    """Print the place of the results and the volumes; return the exit code."""
    if not quiet:
        budget = results.budget
        state = "at rest" if results.at_rest else "still moving"
        released = budget["released"] + budget["inflow"]
        say(
            f"{state} at {results.elapsed_time:.6g} s: {grouped(released)} m3 released, {grouped(budget['eroded'])} m3 "
            f"eroded, {grouped(budget['deposited'])} m3 deposited, {grouped(budget['outflow'])} m3 left the grid"
        )
        if results.record.plan is not None:
            say(results.report)
        say(f"results in {results.directory}")
        if not results.at_rest:
            say("to go on: a longer max_duration in the scene, and landlab-debrisflow resume")
    return DONE if results.at_rest else STILL_MOVING
