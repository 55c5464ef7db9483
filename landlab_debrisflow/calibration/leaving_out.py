"""Leave-one-out over several events: members weighted by all events except one, which is then scored."""

from typing import NamedTuple

from ..core.errors import InputError
from ..fidelity.table import Printed, Table
from .criteria import Level
from .sampler import TARGET
from .scores import Score, score_members
from .weighted_members import WeightedMembers


class LeftOutEvent(NamedTuple):
    """Event that was left out.

    Attributes
    ----------
    level : Level
        Weights by the other events.
    scores : list of Score
        Scores of the members so weighted, of those weighted by all events, and of the prior.
    """

    level: Level
    scores: list[Score]


class LeftOut(Printed):
    """Scores of events, each by members that were weighted without it; it prints itself.

    Attributes
    ----------
    events : dict of str to LeftOutEvent
    """

    def __init__(self, events: dict[str, LeftOutEvent]) -> None:
        self.events = events

    def _table(self) -> Table:
        rows = []
        for name, one in self.events.items():
            rows.append((name, f"left out; effective sample size of the others {one.level.size:.0f}"))
            rows += [(f"  {score.name}", score.words()) for score in one.scores]
        return Table(title="Leave one out", rows=rows)


def leave_out(posterior: WeightedMembers) -> LeftOut:
    """Weight the members of a posterior by all events except one, in turn, and score the one that was left out.

    The prior over the mixture of proposals is as in the calibration: only the likelihood changes, so that no run is
    needed.

    Parameters
    ----------
    posterior : WeightedMembers

    Returns
    -------
    LeftOut

    Raises
    ------
    InputError
        If there is one event only.
    """
    if len(posterior.runs) < 2:
        raise InputError("calibration: one event alone cannot be left out; calibrate several by calibrate_events")
    sample, found = posterior.sample, {}
    first = int((sample.generation == 0).sum())
    for runs in posterior.runs:
        others = [one for one in posterior.runs if one is not runs]
        columns = [k for one in others for k in range(*posterior.columns_of(one.name).indices(sample.misfits.shape[1]))]
        criterion = posterior.criterion.of_observations(columns)
        level = criterion.final(sample.misfits[:, columns], sample.log_ratio, TARGET * first)
        sets = {"left out": level.weights, "all events": posterior.weights, "prior": posterior.prior_weights}
        members = {name: posterior.members_of(runs.name, weights) for name, weights in sets.items()}
        found[runs.name] = LeftOutEvent(level, score_members(runs, members))
    return LeftOut(found)
