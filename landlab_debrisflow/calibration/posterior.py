"""Posterior of a calibration: weighted members, predictive maps, and members that are run again."""

from collections.abc import Mapping
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from ..core.checks import in_range
from ..core.errors import InputError
from ..fidelity.table import Printed, Table
from .event import Event
from .leaving_out import LeftOut, leave_out
from .prediction import Prediction, predict, rescore
from .predictive import predictive_maps
from .proposal import systematic
from .summary import posterior_table
from .weighted_members import WeightedMembers


class Posterior(Printed, WeightedMembers):
    """Posterior of a calibration; it prints itself.

    Attributes
    ----------
    sample : Sample
        Points of the unit cube, misfits and weights of all members.
    prior : Prior
    runs : tuple of EventRuns
        Events in their order.
    results : dict of str to list of EnsembleResults
        Generations by event.
    criterion : Criterion
        Likelihood of the stated errors, or tolerance of a distance.
    """

    def predictive(self, thresholds: Mapping[str, Any], event: str | None = None) -> xr.Dataset:
        """Return posterior predictive maps: means, and probabilities of exceeding thresholds.

        Parameters
        ----------
        thresholds : mapping of str to float or sequence of float
            By the name of a map, as for `predictive_maps`.
        event : str, optional
            Name of the event, where there are several.

        Returns
        -------
        xarray.Dataset
            Over ``y`` and ``x``; the attribute ``effective_sample_size`` tells how sure probabilities are.
        """
        runs = self.event(event)
        maps = predictive_maps(self.results[runs.name], self.weights, thresholds)
        return maps.assign_attrs(effective_sample_size=self.effective_size, members=self.weights.size)

    def rescore(self, particle_count: int | None = None, **options: Any) -> Prediction:
        """Run members of the posterior again with more particles, and score both runs.

        Parameters
        ----------
        particle_count : int, optional
            Number of particles; by default twice that of the scene.
        **options
            As of `rescore`: members, event, client, store, workers, notify.

        Returns
        -------
        Prediction
        """
        return rescore(self, particle_count, **options)

    def predict(self, event: Event, **options: Any) -> Prediction:
        """Run members of the posterior and of the prior in another event, and score both.

        Parameters
        ----------
        event : Event
            Event that took no part in the calibration.
        **options
            As of `predict`: members, client, store, workers, notify.

        Returns
        -------
        Prediction
        """
        return predict(self, event, **options)

    def draw(self, members: int = 64, seed: int = 0) -> xr.Dataset:
        """Draw members by their weights, as a table for an ensemble of another scene.

        Such an ensemble, `Ensemble(scene, sampling=posterior.draw())`, has the values that the event taught; values of
        the event alone, such as its volume, are left out with ``drop_vars``.

        Parameters
        ----------
        members : int
            Number of members; one of great weight is drawn more than once.
        seed : int
            Equal seeds draw equal members.

        Returns
        -------
        xarray.Dataset
            Values over ``member``.

        Raises
        ------
        InputError
            If `members` is less than 1.
        """
        in_range("calibration: members", members, 1, error=InputError)
        index = systematic(self.weights, members, np.random.default_rng(seed))
        return self.prior.design(self.sample.uniform[index]).assign_attrs(effective_sample_size=self.effective_size)

    def leave_one_out(self) -> LeftOut:
        """Weight all members by all events except one, and score the one that was left out; needs no run.

        Returns
        -------
        LeftOut

        Raises
        ------
        InputError
            If there is one event only.
        """
        return leave_out(self)

    def to_netcdf(self, path: str | Path) -> None:
        """Write values, weights and misfits of all members as a file.

        Parameters
        ----------
        path : str or Path
        """
        self.members.to_netcdf(path)

    @cached_property
    def _printed(self) -> Table:
        return posterior_table(self)

    def _table(self) -> Table:
        return self._printed
