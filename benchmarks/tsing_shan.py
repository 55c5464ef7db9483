"""The claims of Pastor et al. (2022), section 4.2, in numbers: ``python -m benchmarks.tsing_shan``.

Both models with both coefficients of consolidation, with each source of loading, on the stand-in terrain of
`examples/tsing_shan.py`, with 1500, 5000 and 20 000 particles and several offsets of terrain and release against the
nodes. Of two runs that differ only in particles and offset, the difference is noise; it is printed beside every claim.
Keeps every pair of runs in benchmarks/results/tsing_shan.json as soon as it is there, and makes
benchmarks/tsing_shan.txt of it.

    python -m benchmarks.tsing_shan --particles 1500 --offsets 2

A long series is done in parts: ``--resume`` reads the file, and what stands there is not run again.
"""

import argparse
import itertools

import numpy as np
from rich.table import Table

from benchmarks import charts, result_files
from benchmarks.example_scripts import load
from landlab_debrisflow.scene import tsing_shan_valley

tsing_shan, record = load("tsing_shan"), load("tsing_shan_record")

OFFSETS = ((0.0, 0.0), (0.5, 0.0), (0.0, 0.5), (0.25, 0.25))
"""Of the valley against the nodes, east and north, in parts of the spacing."""

PARTICLES = (1500, 5000, 20_000)
LOADING = ("overburden", "none", "proportional")

CONSOLIDATION = (*tsing_shan.CONSOLIDATION, 4.0)
"""Those of the paper, and one with which our flow, which is ten times as fast as the paper takes its own to be, has the
basal Péclet number of the paper's second [m2 s-1]."""

LEVELS = (11, 41, 161, 321)
"""Of the columns, where their effect is looked at: c_v of the case, fewest particles, no offset."""

SHOWN = (0.0, 4.0, 8.0, 128.0)
"""Times since the front left erodible ground, of the marked particle [s]."""
COMMAND = "python -m benchmarks.tsing_shan"


def compare(c_v, loading, particles, offset, levels=tsing_shan.LEVELS):
    """Run both models and return their measures, and what belongs to the pair."""
    terrain = {"offset": offset} | tsing_shan.VALLEY
    ale, classical = (
        tsing_shan.run(tsing_shan_valley(**terrain), model, c_v, particles, loading, levels=levels)
        for model in tsing_shan.COLUMNS
    )
    return {
        "ALE": ale.measures | marked(ale), "classical": classical.measures | marked(classical),
        "apart": record.first_difference(ale, classical),
    }  # fmt: skip


def marked(run):
    """Return base and depth mean of the pressure of the marked particle over its liquefaction pressure, by time."""
    values = {}
    for since in SHOWN:
        if ("since", since) in run.snapshots:
            pressure, load = run.marked_column(("since", since))
            values[f"base {since:g}"] = pressure[0] / load
            values[f"mean {since:g}"] = 0.5 * (pressure[1:] + pressure[:-1]).mean() / load
    return values


def tables(found):
    """Yield one table of differences and noise of what was found so far, one of levels, one for each c_v and loading.

    Keys of `found` are (c_v, loading, particles, offset), or (loading, levels).
    """
    resolved = {key: pair for key, pair in found.items() if len(key) == 2}
    found = {key: pair for key, pair in found.items() if len(key) == 4}
    yield noise(found)
    if resolved:
        words = f"run-out in m against levels, c_v = {tsing_shan.CONSOLIDATION[0]:g}, {min(PARTICLES)} particles"
        table = Table(title=words, title_justify="left")
        for heading in ("loading source", "levels", *tsing_shan.COLUMNS, "difference"):
            table.add_column(heading, justify="right")
        for (loading, levels), pair in sorted(resolved.items()):
            ale, classical = (pair[model]["run-out"] for model in tsing_shan.COLUMNS)
            table.add_row(loading, str(levels), f"{ale:.1f}", f"{classical:.1f}", f"{ale - classical:.1f}")
        yield table
    for c_v, loading in dict.fromkeys(key[:2] for key in found):
        pairs = {key[2:]: pair for key, pair in found.items() if key[:2] == (c_v, loading)}
        table = Table(title=f"c_v = {c_v:g} m2/s, loading source {loading}: ALE and classical", title_justify="left")
        table.add_column("", no_wrap=True)
        for particles, offset in pairs:
            table.add_column(f"{particles}\n{offset[0]:g} {offset[1]:g}", justify="right", no_wrap=True)
        for key, (words, form) in (record.MEASURES | marked_words(pairs)).items():
            cells = (" ".join(form.format(pair[model][key]) for model in tsing_shan.COLUMNS) for pair in pairs.values())
            table.add_row(words, *cells)
        table.add_row("first difference in any bit at [s]", *(f"{pair['apart']:.1f}" for pair in pairs.values()))
        yield table


def marked_words(pairs):
    """Return words and format of the pressures of the marked particle."""
    names = [name for name in next(iter(pairs.values()))["ALE"] if name not in record.MEASURES]
    return {name: (f"marked: {name.split()[0]} / p_liq, {name.split()[1]} s after", "{:.3f}") for name in names}


COMPARED = {"run-out": ".1f", "farthest": ".1f", "centre": ".1f", "mean deposit": ".3f", "final": ".1f"}


def noise(found):
    """Return the table of differences between the models and of the noise."""
    words = (
        "ALE less classical: mean (least, largest) over particles and offsets; noise: standard deviation of one model "
        "over particles and offsets, the larger of both models"
    )
    table = Table(title=words, title_justify="left")
    for heading in ("c_v [m2/s]", "loading source", "runs", "of", "difference", "noise"):
        table.add_column(heading)
    for c_v, loading in dict.fromkeys(key[:2] for key in found):
        pairs = [pair for key, pair in found.items() if key[:2] == (c_v, loading)]
        for name, form in COMPARED.items():
            ale, classical = (np.array([pair[model][name] for pair in pairs]) for model in tsing_shan.COLUMNS)
            d, deviation = ale - classical, max(ale.std(), classical.std())
            mean, least, largest = (format(value, form) for value in (d.mean(), d.min(), d.max()))
            words, difference = record.MEASURES[name][0].strip(), f"{mean} ({least}, {largest})"
            table.add_row(
                f"{c_v:g}",
                loading,
                str(len(pairs)),
                record.MEASURES[name][0].strip(),
                difference,
                format(deviation, form),
            )
    return table


def kept() -> dict:
    """Return the pairs of the result file by (c_v, loading, particles, offset), or by (loading, levels)."""
    found = {}
    for row in result_files.read("tsing_shan")["rows"]:
        pair = {name: row[name] for name in ("ALE", "classical", "apart")}
        found[tuple(tuple(word) if isinstance(word, list) else word for word in row["key"])] = pair
    return found


def report() -> str:
    """Return the text of benchmarks/tsing_shan.txt: the comparison of the models with the noise, then every run."""

    def show(console):
        for table in tables(kept()):
            console.print(table, highlight=False, markup=False)

    return charts.printed(show, width=260)


def main(particles=PARTICLES, offsets=None, resume=False):
    """Run everything, the smallest first, and keep it after every pair.

    Parameters
    ----------
    particles : sequence of int
        Numbers of particles.
    offsets : int, optional
        How many of `OFFSETS`; all by default.
    resume : bool
        Go on with the result file, which has been begun.
    """
    found = kept() if resume else {}
    cases = {
        (c_v, loading, count, offset): (c_v, loading, count, offset)
        for count, offset, loading, c_v in itertools.product(
            sorted(particles), OFFSETS[:offsets], LOADING, CONSOLIDATION
        )
    }
    cases |= {
        (loading, levels): (CONSOLIDATION[0], loading, min(PARTICLES), OFFSETS[0], levels)
        for loading, levels in itertools.product(LOADING, LEVELS)
    }
    for key, case in cases.items():
        if key in found:
            continue
        found[key] = compare(*case)
        rows = [{"key": list(name), **pair} for name, pair in found.items()]
        result_files.keep("tsing_shan", {"rows": rows}, COMMAND)
        print(key, flush=True)
    charts.make("tsing_shan")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--particles", type=int, nargs="+", default=PARTICLES)
    parser.add_argument("--offsets", type=int, help="how many of them; by default all")
    parser.add_argument("--resume", action="store_true", help="go on with the result file")
    words = parser.parse_args()
    main(words.particles, words.offsets, words.resume)
