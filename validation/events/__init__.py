"""Measured events, modelled: set-ups, parameters with their sources, scores (``python -m validation.events``).

Every folder holds one event; docs/events.md shows them.
"""

import importlib
from pathlib import Path

from landlab_debrisflow.core.errors import InputError
from landlab_debrisflow.core.hints import did_you_mean

from . import record
from .event import Event

FOLDER = Path(__file__).parent
ORDER = ("flume", "flume_entrainment", "s1000", "cascade2009", "olivares")
"""Order of the events on the page."""
EVENTS = tuple(name for name in ORDER if (FOLDER / name / "__init__.py").is_file())
"""Names of the events."""


def find_event(name: str) -> Event:
    """Return the event of a name.

    Raises
    ------
    InputError
        If there is none.
    """
    if name not in EVENTS:
        raise InputError(f"there is no event {name!r}{did_you_mean(name, EVENTS)}; there are {', '.join(EVENTS)}")
    return importlib.import_module(f"{__name__}.{name}").EVENT


def chart(name: str):
    """Return the figure of an event, drawn from its result.nc alone."""
    event = find_event(name)
    return event.draw(record.read_result(event))
