"""Tables of docs/accuracy.md on the cost of earlier versions and on the rules of steps, for page_tables.py."""

from benchmarks import erosion_order, result_files, step_rules


def ratios() -> tuple[list[str], list[list[str]]]:
    """Return heads and rows: this version, and how many times as fast, cheap or small it is."""
    from benchmarks.ratios import speed_up

    found = result_files.read("ratios")
    rows = []
    for row in found["rows"]:
        gains = (speed_up(row, name) for name in found["revisions"])
        here = f"{row['here']:.3g} {row['unit']}".strip()
        rows.append([row["row"], here, *(f"{middle:.2f} ({low:.2f} – {high:.2f})" for low, middle, high in gains)])
    return ["cost", "now", *(f"gain over {name}" for name in found["revisions"])], rows


def rules() -> tuple[list[str], list[list[str]]]:
    """Return heads and rows: cost and errors with each rule switched off."""
    found = result_files.read("step_rules")
    name = found["revision"]
    heads = ["scene", "variant", f"steps over {name}", f"CPU time over {name}"]
    heads += [f"error of the {words}" for words in ("run-out [m]", "centre [m]", "eroded volume [m³]")]
    return heads, [step_rules.cells(row) for row in found["rows"]]


def orders() -> tuple[list[str], list[list[str]]]:
    """Return heads and rows: differences to the shortest steps."""
    rows = result_files.read("erosion_order")["rows"]
    shown = [row for row in rows if row["shorter"] != erosion_order.FINEST]
    return list(erosion_order.HEADS), [erosion_order.cells(row, rows) for row in shown]
