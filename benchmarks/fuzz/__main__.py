"""``python -m benchmarks.fuzz``: see `benchmarks.fuzz.command`."""

import os
import sys


def run() -> int:
    """Run the command with one thread of OpenMP: threads do not survive that a process is copied."""
    os.environ["OMP_NUM_THREADS"] = "1"  # before landlab is loaded
    from .command import main

    return main()


sys.exit(run())
