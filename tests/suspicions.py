"""Listen to what the package finds odd (`landlab_debrisflow/grid/doubts.py`), where nothing should be.

With the fixtures `only_built` and `no_doubts` scenes are built and read as in a run, up to the moment in which
particles would be made, and nothing was doubted until then.
"""

import inspect
from contextlib import ExitStack, contextmanager
from unittest import mock

import pytest

from landlab_debrisflow.grid import doubts


@contextmanager
def suspicions():
    """Yield a list of everything that is doubted while the context is open."""
    said = []

    def listening(about):
        def listen(*arguments):
            words = about(*arguments)
            words = [words] if isinstance(words, str) else list(words)
            said.extend(filter(None, words))
            return words if inspect.isgeneratorfunction(about) else words[0]

        return listen

    with ExitStack() as stack:
        for name, about in vars(doubts).items():
            if name.endswith(("_doubts", "_reason")):
                stack.enter_context(mock.patch.object(doubts, name, listening(about)))
        yield said


class BuiltError(Exception):
    """All that is read before a flow moves has been read."""


def built(run, *arguments, **keywords):
    """Check that a flow is built and read when something is run."""
    with pytest.raises(BuiltError):
        run(*arguments, **keywords)
