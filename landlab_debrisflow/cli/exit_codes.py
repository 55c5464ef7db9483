"""Exit codes of the commands."""

DONE, INTERNAL_ERROR, USER_ERROR, STILL_MOVING, CANNOT_WRITE, DIVERGED, SOME_FAILED = range(7)
SIGNALLED = 128
"""Added to the number of the signal that ended a run: 130 after Ctrl-C, 143 after SIGTERM."""

MEANING = {
    DONE: "done",
    INTERNAL_ERROR: "an error of the program; please report it",
    USER_ERROR: "an argument, file or key cannot be used",
    STILL_MOVING: "results are written, but the flow still moved after max_duration",
    CANNOT_WRITE: "a file cannot be written, the disk is full perhaps; computed results are kept",
    DIVERGED: "the computation failed; the last checkpoint is kept",
    SOME_FAILED: "results are written, but members of the ensemble failed",
    SIGNALLED + 2: "interrupted by Ctrl-C; the run can be resumed",
    SIGNALLED + 15: "ended by SIGTERM; the run can be resumed",
}


def epilog() -> str:
    """Return the exit codes as the end of a help text."""
    return "exit codes:\n" + "\n".join(f"  {code:3d}  {words}" for code, words in MEANING.items())
