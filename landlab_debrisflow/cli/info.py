"""The command that lists laws and parameters."""

import sys

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from ..core.errors import ParameterError
from ..core.hints import did_you_mean, same_word
from ..physics.registry import LAWS
from ..scene.law_entries import HEADINGS, law_entries, other_entries
from . import laws


def add_command(commands) -> None:
    """Add the command to the commands of a parser."""
    info = commands.add_parser("info", help="list laws and parameters with formula, source, units, defaults and bounds")
    info.add_argument(
        "law", nargs="?", help="law, kind of law (friction, erosion, column, flow) or other keyword; by default all"
    )
    info.add_argument("--markdown", action="store_true", help="as the page docs/laws.md")
    info.set_defaults(command=_info)


def _info(arguments) -> None:
    if arguments.markdown:
        sys.stdout.write(laws.markdown())
        return
    console = Console()
    for entry, remark in _chosen(arguments.law):
        _show(console, entry, remark)


def _chosen(word: str | None) -> list:
    """Return entries with a remark: of a kind, of a name, or of every law if there is no word."""
    entries = [
        (entry, " (default)" if number == 0 else "")
        for kind in LAWS for number, entry in enumerate(law_entries(kind))
    ] + [(entry, "") for entry in other_entries()]  # fmt: skip
    if word is None:
        return entries
    names = dict.fromkeys(name for entry, _ in entries for name in (*entry.title.split(": "), entry.title))
    if (name := same_word(word.replace(".", ": "), names)) is None:
        raise ParameterError(
            f"info: no law or keyword {word!r}{did_you_mean(word, names)}; there are "
            f"{', '.join(name for name in names if ': ' not in name)}"
        )
    return [(entry, remark) for entry, remark in entries if name in (*entry.title.split(": "), entry.title)]


def _show(console, entry, remark=""):
    """Print formula, source and parameters of a declared class.

    `console` is of rich, `entry` an `Entry` of scene/law_entries.py, `remark` text behind its title.
    """
    words = ": ".join(filter(None, (entry.formula, entry.summary)))
    console.print(f"[bold]{entry.title}{remark}[/bold]  {escape(words)}", highlight=False)
    if entry.source:
        console.print(f"  [dim]{escape(entry.source)}[/dim]", highlight=False)
    if not entry.rows:
        console.print("  no parameters\n", highlight=False)
        return
    table = Table(box=None, pad_edge=True, header_style="dim")
    for heading in HEADINGS:
        table.add_column(heading, overflow="fold", no_wrap=heading == "parameter")  # names of parameters are not broken
    for row in entry.rows:
        table.add_row(*map(escape, row))
    console.print(table, "", highlight=False)
