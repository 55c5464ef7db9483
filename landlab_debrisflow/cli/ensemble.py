"""Command ensemble: many runs of a scene file, and their hazard maps."""

from pathlib import Path
from typing import Any

from ..run.files import STORE
from .exit_codes import DONE, SOME_FAILED, epilog
from .messages import messages
from .output import say
from .scene_commands import add_message_options, command


def add_command(commands) -> None:
    """Add the command to the commands of a parser."""
    parser = command(
        commands, "ensemble", _ensemble, "run the members of a scene's ensemble; given again, the missing members",
        epilog(),
    )  # fmt: skip
    parser.add_argument("scene", type=Path, help="scene file with the key ensemble")
    parser.add_argument("--members", type=int, metavar="N", help="number of members, in place of that of the scene")
    parser.add_argument(
        "--workers", type=int, metavar="N", help="processes on this machine (default: one for each processor)"
    )
    parser.add_argument("--scheduler", metavar="ADDRESS", help="dask scheduler of a cluster, such as tcp://host:8786")
    add_message_options(parser)


def _ensemble(arguments) -> int:
    from ..core.compilations import compilations
    from ..ensemble import Ensemble
    from ..hazard.of_scene import check_hazard_keys, write_scene_hazard
    from ..record.monitor import COMPILING

    with messages(arguments.quiet, arguments.verbose, arguments.log) as monitor:
        others: dict[str, Any] = {} if arguments.members is None else {"members": arguments.members}
        with compilations(lambda: monitor.say(COMPILING)):
            ensemble = Ensemble.from_file(arguments.scene, **others)
            check_hazard_keys(ensemble.scene)
            for note in ensemble.scene.notes:  # reads releases and places of output before the first run
                monitor.say(f"note: {note}")
            store = ensemble.results_directory / STORE
            results = ensemble.run(arguments.scheduler, store, workers=arguments.workers, notify=monitor.say)
            monitor.say("ensemble: writing hazard maps")
            written = write_scene_hazard(ensemble, results)
        monitor.close()
        failures = results.failures
        if not arguments.quiet:
            if results.plan is not None:
                say(str(results.plan))
            say(f"{ensemble.members - len(failures)} of {ensemble.members} members came to their end")
            for one in failures[:3]:
                values = ", ".join(f"{key} {value}" for key, value in one.values.items())
                say(f"member {one.member} failed ({values}): {one.error}")
            if len(failures) > 3:
                say(f"and {len(failures) - 3} further members failed")
            if written:
                say(f"hazard maps in {ensemble.results_directory}: {written[0].name} and {len(written) - 1} more files")
            say(f"results in {store}")
    return SOME_FAILED if failures else DONE
