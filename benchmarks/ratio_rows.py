"""Quantities that ratios.py compares, and the scenes of ratio_scenes.py that give them."""

import json
from collections.abc import Callable
from typing import Any, NamedTuple

COUNTS = (1940, 1970, 2000, 2030, 2060)
"""Numbers of particles of S-1000, within 3 % of 2000."""


class Row(NamedTuple):
    """A quantity that is compared: its name and unit, and how it follows from the answer of a scene."""

    name: str
    unit: str
    value: Callable[[Any], float] = lambda found: found
    rate: bool = False  # more is better


class Work(NamedTuple):
    """A scene: a function of ratio_scenes.py with its keywords, the rows that it gives, and how often it is run."""

    function: str
    keywords: dict[str, Any]
    rows: tuple[Row, ...]
    processes: int = 5  # how often processes are started
    turns: int = 3  # in one
    quick: bool = True  # whether it is run with --quick

    def request(self, **more) -> str:
        """Return the line that asks for it."""
        return json.dumps([self.function, self.keywords | more])


def rate_of(time: str) -> Callable[[dict], float]:
    """Return the function that takes million particle steps per second from an answer."""
    return lambda found: found["particle_steps"] / found[time] / 1e6


def short(count: int) -> str:
    """Return a power of ten as it is spoken of.

    Examples
    --------
    >>> short(100_000)
    '1e5'
    """
    return f"{count:.0e}".replace("e+0", "e")


def works() -> list[Work]:
    """Return all scenes that a process runs by itself."""
    found = []
    for count, duration, size in ((10_000, 4.0, (5, 3)), (100_000, 1.0, (4, 2)), (1_000_000, 0.2, (2, 2))):
        rows = (
            Row(f"density + force, {short(count)}", "M/s", rate_of("sums"), True),
            Row(f"whole step, {short(count)}", "M/s", rate_of("cpu"), True),
        )
        found.append(Work("cap", {"count": count, "duration": duration}, rows, *size, count < 100_000))
    for count, duration, size in ((10_000, 4.0, (5, 2)), (100_000, 0.7, (3, 2))):
        row = Row(f"whole step in the valley, {short(count)}", "M/s", rate_of("cpu"), True)
        found.append(Work("valley", {"count": count, "duration": duration}, (row,), *size, count < 100_000))
    row = Row("fixed cost of a step", "us", lambda found: 1e6 * found["start"])
    found.append(Work("fixed", {"duration": 20.0}, (row,)))
    for count in (1500, 5000):
        rows = (Row(f"valley to rest, {count}", "s", lambda found: found["cpu"]),
                Row(f"its steps, {count}", "", lambda found: found["steps"]))  # fmt: skip
        found.append(Work("to_rest", {"count": count}, rows))
    row = Row("two phases over one, 1e4", "", lambda found: found["ratio"])
    found.append(Work("phases", {"count": 10_000, "begin": 2.0, "duration": 1.0}, (row,), 4, 2))
    rows = (Row("bytes per node, after a call", "B", lambda found: found["called"]),
            Row("bytes per node, fields of the grid apart", "B", lambda found: found["own"]),
            Row("bytes per node, when made", "B", lambda found: found["made"]))  # fmt: skip
    found.append(Work("memory", {"side": 2000}, rows, 1, 1))
    for law in ("voellmy", "coulomb"):
        rows = (Row(f"S-1000 {law} to rest, five runs", "s", lambda found: sum(found["cpu"])),
                Row(f"its steps, {law}", "", lambda found: sum(found["steps"])))  # fmt: skip
        found.append(Work("s1000", {"friction": law, "counts": COUNTS}, rows, 2, 1, False))
    return found


THREADS = Work(
    "cap", {"count": 100_000, "duration": 1.0}, (Row("two threads over one, whole step, 1e5", "", rate=True),),
    4, 2, False,
)  # fmt: skip
"""Wall time of one thread over that of two."""

START = Row("cold start beyond landlab", "s")

PEERS = {4.125: (5, 2), 2.0: (2, 1)}
"""Kernel radii of com1DFA [m], which make 10 119 and 126 079 particles; starts of processes, and turns in one."""


def peer_work(particles: int, size: tuple[int, int]) -> Work:
    """Return the scene that com1DFA runs, too."""
    row = Row(f"rate over com1DFA's, {particles}", "", rate=True)
    return Work("cap", {"count": particles, "duration": 5.0}, (row,), *size)
