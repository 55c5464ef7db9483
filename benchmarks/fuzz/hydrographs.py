"""Tables of discharge against time."""

from pathlib import Path

import numpy as np

from . import ground
from .odd import HOSTILE, damaged, one
from .scenes import write_mapping

CELLS = (
    "",
    "nan",
    "inf",
    "-1",
    "1e400",
    "1e-320",
    "ten",
    "1,5",
    "1;5",
    '"',
    '"5',
    "0x1",
    "5 m3/s",
    "#",
    "--",
    "1e9",
    *HOSTILE,
)
HEADERS = (
    "",
    "t;q",
    "time",
    "Time,Q",
    "q,t",
    "time,time",
    "zeit,abfluss",
    "t [min],q [l/s]",
    "time discharge",
    "#time,discharge",
)
NAMES = ("surge.csv", "surge.txt", "surge.tsv")


def write(rng: np.random.Generator, folder: Path, form: str) -> str:
    """Write a scene with a hydrograph of some form; return the change as text."""
    ground.write_files(folder)
    name = one(rng, NAMES)
    points = {"points": [[ground.WEST + 25.0, ground.SOUTH + 35.0]], "hydrograph": name, "speed": 4.0, "width": 15.0}
    terrain = {"elevation": "dem.asc", "crs": f"EPSG:{ground.CODE}"}
    write_mapping(folder / "scene.yaml", {"terrain": terrain, "release": points, "numerics": {"particle_count": 60}})
    times = np.cumsum(rng.integers(1, 60, rng.integers(3, 8)))
    rows = [[f"{t}", f"{q:.4g}"] for t, q in zip(times, rng.random(len(times)) * 20.0 + 0.1, strict=True)]
    header, mark, done = one(rng, ("time [s],discharge [m3/s]", "t,q", None)), one(rng, ",;\t "), "nothing"
    if form == "one change":
        k, column, way = int(rng.integers(len(rows))), int(rng.integers(2)), int(rng.integers(6))
        if way < 2:
            rows[k][column] = one(rng, CELLS)
            done = f"row {k} column {column} = {rows[k][column]!r:.60}"
        elif way == 2:
            rows[k].append(one(rng, CELLS))
            done = f"row {k} longer"
        elif way == 3:
            rows[k].pop()
            done = f"row {k} shorter"
        elif way == 4:
            header = one(rng, HEADERS)
            done = f"header {header!r}"
        else:
            choices = (
                (rows[::-1], "backwards"), (rows[:1], "one row"), ([], "no rows"), (rows * 2, "twice"),
                ([["0", "0"]] * 3, "zeros"),
            )  # fmt: skip
            rows, done = one(rng, choices)
    lines = [mark.join(row) for row in rows]
    if header is not None:
        lines.insert(0, header.replace(" [", "_[").replace(",", mark) if mark == " " else header.replace(",", mark))
    data = one(rng, ("\n", "\r\n")).join([*lines, ""]).encode(errors="surrogateescape")
    if form == "bytes":
        data, done = damaged(rng, data)
    (folder / name).write_bytes(data)
    return done
