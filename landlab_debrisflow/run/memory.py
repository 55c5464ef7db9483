"""Memory of this process."""

import sys


def peak_memory() -> float:
    """Return the largest memory that this process has had so far [bytes]; NaN where the system does not tell."""
    try:
        import resource
    except ImportError:  # Windows
        return float("nan")
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return float(peak if sys.platform == "darwin" else 1024 * peak)
