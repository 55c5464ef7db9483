"""Draw the figures of docs/ from result files: ``python -m benchmarks.charts [NAME ...]``, all of them by default.

A figure is drawn in seconds from what its command has measured in minutes or hours and kept in benchmarks/results.
The tables of benchmarks/*.txt and of docs/accuracy.md are written from the same files, by the same command. With
--measure the commands of the figures that are named are run, and the files made anew.
"""

import argparse
import contextlib
import importlib
import io
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

from PIL import Image
from rich.console import Console

from benchmarks import result_files, style
from landlab_debrisflow.core.hints import did_you_mean
from landlab_debrisflow.plots import save_figure
from landlab_debrisflow.record import write_atomically
from validation import events
from validation.events import page

FIGURES = result_files.ROOT / "docs" / "figures"
TEXTS = Path(__file__).parent
LARGE = 250_000
"""Size from which a figure is written with 256 colours, which maps of relief halve without a visible loss [bytes]."""


class Chart(NamedTuple):
    """A figure: the function that draws it, the files it is drawn from, the command that measures them.

    Files without a suffix are results of `benchmarks.result_files`, others paths in the repository.
    """

    module: str
    results: tuple[str, ...]
    command: str
    function: str = "chart"
    dpi: int = style.DPI

    def draw(self):
        """Return the figure."""
        return getattr(importlib.import_module(f"benchmarks.{self.module}"), self.function)()

    def absence(self) -> str:
        """Return why it cannot be drawn from the files of the repository alone; an empty text if it can."""
        return ""

    def files(self) -> list[Path]:
        """Return the files it is drawn from."""
        return [result_files.ROOT / name if "/" in name else result_files.path_of(name) for name in self.results]


class EventChart(Chart):
    """The figure of a measured event, drawn from its result.nc; `module` is the name of the event."""

    def draw(self):
        """Return the figure."""
        return events.chart(self.module)

    def absence(self) -> str:
        """Return why the measured data that it needs, too, is absent; an empty text if it is there."""
        return events.find_event(self.module).absence()


FIDELITY = ("benchmarks/fidelity/results/after.jsonl", "benchmarks/fidelity/results/before.jsonl")
CAMPAIGN = "python -m benchmarks.fidelity campaign --label after --processes 2"

CHARTS = {
    "column": Chart("column", ("column",), "python -m benchmarks.column"),
    "column_stability": Chart("column_stability", ("column_stability",), "python -m benchmarks.column_stability"),
    "dilatancy_stability": Chart("dilatancy_stability", ("dilatancy_stability",),
                                 "python -m benchmarks.dilatancy_stability"),
    "convergence": Chart("fidelity.__main__", FIDELITY, CAMPAIGN, "chart_of_convergence"),
    "failure_surfaces": Chart("failure_surfaces", ("failure_surfaces",), "python -m benchmarks.failure_surfaces"),
    "fidelity": Chart("fidelity.__main__", FIDELITY[:1], CAMPAIGN, "chart_of_cost"),
    "flow": Chart("flow", ("flow", "flow_com1dfa"), "python -m benchmarks.flow", dpi=90),
    "flow_stability": Chart("flow_stability", ("flow_stability",), "python -m benchmarks.flow_stability"),
    "lazy_scheme": Chart("lazy_figure", ("lazy_scheme",), "python -m benchmarks.lazy_figure"),
    "paper_columns": Chart("paper_columns", ("paper_columns",), "python -m benchmarks.paper_columns", dpi=80),
    "ratios": Chart("ratios", ("ratios",), "python -m benchmarks.ratios"),
    "s1000_valley": Chart("s1000", ("s1000",), "python -m benchmarks.s1000", "chart_of_valley", 80),
    "s1000": Chart("s1000", ("s1000", "s1000_scores"), "python -m benchmarks.s1000"),
    "speed": Chart("speed", ("speed",), "python -m benchmarks.speed"),
    "step_stability": Chart("step_stability", ("step_stability",), "python -m benchmarks.step_stability"),
    "tsing_shan_columns": Chart("tsing_shan_event", ("tsing_shan_columns",), "python -m benchmarks.tsing_shan_event",
                                "chart_of_columns", 100),
    "tsing_shan_flow": Chart("tsing_shan_event", ("tsing_shan_flow", "tsing_shan_maps"),
                             "python -m benchmarks.tsing_shan_event", "chart_of_flow", 80),
    "tsing_shan_maps": Chart("tsing_shan_event", ("tsing_shan_maps",), "python -m benchmarks.tsing_shan_event",
                             "chart_of_maps", 90),
    "two_phase": Chart("two_phase", ("two_phase", "two_phase_errors"), "python -m benchmarks.two_phase"),
    "valley_accuracy": Chart("valley_accuracy", ("valley_accuracy",), "python -m benchmarks.valley_accuracy"),
    "when_ale_matters": Chart("when_ale_matters", ("when_ale_matters",), "python -m benchmarks.when_ale_matters"),
} | {
    f"event_{name}": EventChart(name, (f"validation/events/{name}/result.nc",), f"python -m validation.events {name}")
    for name in events.EVENTS
}  # fmt: skip
"""Figures of docs/figures by name; beside them stand those of `RUNS`."""

REPORTS = {
    name: name
    for name in (
        "column", "erosion_order", "flow", "flow_stability", "paper_speed", "ratios", "speed", "step_rules",
        "step_stability", "tsing_shan", "two_phase", "when_ale_matters",
    )
}  # fmt: skip
"""Texts of benchmarks/, and the module whose `report` makes them of a result file."""


def make(*names: str, say: Callable[[str], object] = print) -> None:
    """Draw figures, write texts and fill the tables of pages; all by default.

    Parameters
    ----------
    names : str
        Of figures or texts.
    say : callable
        Given one line for each file.
    """
    for name in names or dict.fromkeys((*CHARTS, *REPORTS, *RUNS)):
        if name in RUNS:
            say(f"Wrote {_short(_drawn_by_run(name))}")
        if name in CHARTS:
            chart = CHARTS[name]
            if reason := chart.absence():
                say(f"{name}.png stays as it is: {reason}")
            else:
                path = save_figure(chart.draw(), FIGURES / f"{name}.png", chart.dpi)
                reduce_colours(path)
                say(f"Wrote {_short(path)}")
        if name in REPORTS:
            text = importlib.import_module(f"benchmarks.{REPORTS[name]}").report()
            path = write_atomically(TEXTS / f"{name}.txt", lambda path, text=text: path.write_text(text, "utf-8"))
            say(f"Wrote {_short(path)}")
    from benchmarks import page_tables

    for path in (*page_tables.fill(), *page.fill()):
        say(f"Wrote {_short(path)}")


def reduce_colours(path: Path) -> None:
    """Write a PNG file of more than `LARGE` bytes anew with 256 colours."""
    if path.stat().st_size > LARGE:
        with Image.open(path) as image:
            reduced = image.convert("RGB").quantize(256, dither=Image.Dither.NONE)
        write_atomically(path, lambda place: reduced.save(place, "png", optimize=True))


def demo(folder: Path) -> Path:
    """Run the demo in a folder; return its figure."""
    from landlab_debrisflow.cli.demo import run_demo

    run_demo(1500, folder, Console(quiet=True))
    return folder / "demo.png"


def first_map(folder: Path) -> Path:
    """Run the code of the README in a copy of examples/scenes; return its figure."""
    (block,) = re.findall(r"```python\n(.*?)```", (result_files.ROOT / "README.md").read_text("utf-8"), re.DOTALL)
    scenes = shutil.copytree(result_files.ROOT / "examples" / "scenes", folder / "scenes")
    with contextlib.chdir(scenes):
        exec(compile(block, "README.md", "exec"), {})
    return scenes / "max_depth.png"


RUNS = {"demo": demo, "first_map": first_map}
"""Figures without a result file: a run of seconds draws them."""


def _drawn_by_run(name: str) -> Path:
    with tempfile.TemporaryDirectory() as folder:
        drawn = RUNS[name](Path(folder)).read_bytes()
    return write_atomically(FIGURES / f"{name}.png", lambda path: path.write_bytes(drawn))


def measure(names: list[str]) -> None:
    """Run the commands that measure what figures are drawn from, each once."""
    commands = [CHARTS[name].command if name in CHARTS else f"python -m benchmarks.{REPORTS[name]}" for name in names]
    for command in dict.fromkeys(commands):
        subprocess.run([sys.executable, *command.split()[1:]], check=True, cwd=result_files.ROOT)


def printed(show: Callable[[Console], object], width: int) -> str:
    """Return what `show` prints, without spaces at the ends of lines."""
    console = Console(file=io.StringIO(), width=width, color_system=None)
    show(console)
    lines = [line.rstrip() for line in console.file.getvalue().splitlines()]
    return "\n".join(lines) + "\n"


def _short(path) -> str:
    return str(Path(path).resolve().relative_to(result_files.ROOT))


def main(arguments: list[str] | None = None) -> int:
    """Draw figures by name."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("names", nargs="*", metavar="NAME", help="of a figure or text; by default all")
    parser.add_argument("--measure", action="store_true", help="run the commands that make the result files of NAME")
    options = parser.parse_args(arguments)
    names = [name.removesuffix(".png").removesuffix(".txt") for name in options.names]
    known = list(dict.fromkeys([*CHARTS, *REPORTS, *([] if options.measure else RUNS)]))
    for name in names:
        if name not in known:
            parser.error(f"there is no figure {name!r}{did_you_mean(name, known)}; there are {', '.join(known)}")
    if options.measure and not names:
        parser.error(f"name what is to be measured, it takes minutes to hours: {', '.join(known)}")
    if options.measure:
        measure(names)
    else:
        make(*names)
    return 0


if __name__ == "__main__":
    sys.exit(main())
