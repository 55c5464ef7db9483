"""The Landlab component: fields of the grid on one side, the model on the other."""

import logging
from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

import xarray as xr
from landlab import Component, RasterModelGrid
from landlab.core.model_component import classproperty

from .grid import checks, doubts
from .grid.call import GridCall
from .grid.fields import NODE_FIELDS, no_new_fields
from .model.diagnostics import Diagnostics
from .model.inflow.hydrograph import Hydrograph
from .model.inflow.inflow import Inflow
from .model.numerics import Numerics
from .model.simulation import Simulation
from .physics.material import Material
from .planning import Planning
from .record import summary
from .record.attributes import moment_attributes
from .record.citation import PAPER
from .record.datasets import columns_dataset, maps_dataset, particles_dataset
from .restart import Restart
from .scene.setup import Setup

log = logging.getLogger("landlab_debrisflow")


class DebrisFlow(Planning, Restart, Component):
    """Landslides and debris flows that pick up wet ground on their way.

    Depth-integrated SPH on the terrain with a column of pore pressure under every particle, which moves
    with the flow while new soil enters from below (Pastor et al., 2022).

    Output fields start at 0, arrival time at -1, whatever stood in them. With several components on one grid they hold
    the outputs of the one that was built or called last; `maps` and `budget` are always a component's own.

    Parameters
    ----------
    grid : RasterModelGrid
        With ``topographic__elevation`` [m]; give ``soil__depth`` [m] to let the bed erode and
        ``debris_flow__release_depth`` [m] to let ground fail.
    friction, erosion, column, flow : law, str or mapping, optional
        A law object, its name in any case, or plain values: ``{"law": "voellmy", "turbulent_coefficient": 500.0}``.
    material : Material or mapping, optional
        Densities, porosity, consolidation, initial pore pressure.
    numerics : Numerics or mapping, optional
        Number of particles, threads, settling.
    inflow : Hydrograph, mapping or a sequence of them, optional
        Inflow across lines: discharge, velocity and pore pressure against `elapsed_time`.
    observers : observer or sequence of them, optional
        Objects with an ``interval`` [s] and a method ``observe(flow)``, called after every step that crosses a multiple
        of the interval and when the event comes to rest. Observers change no result
        (`landlab_debrisflow.record.observers`).
    continues : DebrisFlow, optional
        The component before on the same grid, at rest and settled: its maps, budget and elapsed time go on.

    Raises
    ------
    InputError (a ValueError), ParameterError (a ValueError), landlab.FieldError
        If the grid, a boundary, a law or a parameter is not usable; the grid has no new field then.

    Notes
    -----
    Input that can be computed but is hardly meant, such as coordinates in degrees or a density in g/cm3, is logged once
    as a warning by the logger "landlab_debrisflow".

    Examples
    --------
    >>> import numpy as np
    >>> from landlab import RasterModelGrid
    >>> from landlab_debrisflow import DebrisFlow
    >>> grid = RasterModelGrid((20, 60), xy_spacing=5.0)
    >>> z = grid.add_field("topographic__elevation", np.maximum(0.0, 75.0 - 0.5 * grid.x_of_node), at="node")
    >>> soil = grid.add_full("soil__depth", 1.0, at="node")
    >>> release = grid.add_zeros("debris_flow__release_depth", at="node")
    >>> release[(abs(grid.x_of_node - 30) < 8) & (abs(grid.y_of_node - 48) < 8)] = 1.0
    >>> flow = DebrisFlow(grid, numerics={"particle_count": 200})
    >>> flow.run_until_rest()
    True
    >>> flow.budget["released"]
    225.0
    >>> bool(abs(flow.budget["residual"]) < 1e-12 * 225.0)
    True
    """

    _name = "DebrisFlow"
    _unit_agnostic = False
    _cite_as = PAPER
    _info: ClassVar = {field.name: field.info for field in NODE_FIELDS}

    def __init__(
        self,
        grid: RasterModelGrid,
        *,
        friction: Any = None,
        erosion: Any = None,
        column: Any = None,
        flow: Any = None,
        material: Material | Mapping[str, Any] | None = None,
        numerics: Numerics | Mapping[str, Any] | None = None,
        inflow: Hydrograph | Mapping[str, Any] | Sequence[Hydrograph | Mapping[str, Any]] | None = None,
        observers: Any = (),
        continues: "DebrisFlow | None" = None,
    ) -> None:
        if not isinstance(grid, RasterModelGrid):
            raise checks.InputError(f"DebrisFlow needs a RasterModelGrid, got {type(grid).__name__}")
        self._setup = setup = Setup(
            flow=flow, friction=friction, erosion=erosion, column=column, material=material, numerics=numerics,
            inflow=inflow,
        )  # fmt: skip
        self._observers = checks.check_observers(observers)
        checks.check_phases(setup)
        checks.check_types(grid)
        with no_new_fields(grid):
            super().__init__(grid)
            checks.check_boundaries(grid)
            found = [*doubts.coordinate_doubts(grid), *doubts.elevation_doubts(grid)]
            found += doubts.name_doubts(grid, setup)
            entering = Inflow(setup.inflow, setup.numerics, grid.xy_of_lower_left)
            if continues is not None:
                if not isinstance(continues, DebrisFlow):
                    raise checks.InputError(
                        f"continues must be the DebrisFlow before on the same grid, got {continues!r}"
                    )
                checks.check_continued(continues, grid, entering)
            self._simulation = Simulation(setup, entering)
            self._call: GridCall = GridCall(self, None if continues is None else continues._call)
        for doubt in (*found, *doubts.parameter_doubts(grid, setup)):
            log.warning("%s", doubt)

    def __repr__(self):
        return summary.text(self)

    def _repr_html_(self):
        return summary.html(self)

    @classproperty
    @classmethod
    def input_var_names(cls) -> tuple[str, ...]:
        """Names of the optional input fields, sorted: the fields that `wrap_as_bmi` lets a caller set.

        Landlab's own list leaves out all that is optional.
        """
        return tuple(sorted(name for name, entry in cls._info.items() if "in" in entry["intent"]))

    # ---- calls by the user ----

    def run_one_step(self, dt: float) -> None:
        """Advance exactly `dt` seconds.

        Values > 0 in ``debris_flow__release_depth`` are taken first; mass at rest at the end is laid into the terrain,
        unless ``numerics={"settle": False}``.

        Parameters
        ----------
        dt : float
            Duration [s], whatever unit other components use; 0 does nothing.

        Raises
        ------
        InputError
            If `dt` or a field is not usable, or if an observer calls; nothing was changed.
        SimulationError
            If the state stopped being finite; grid and flow are as they were before the call, and whatever else fails
            in a step leaves them so, too.
        KeyboardInterrupt, or what an observer raised
            After the step. The state after this step is kept, no mass settles, and `elapsed_time` tells the time. If
            the grid is not changed, the next call goes on as if there had been no interruption: to end at the same
            time, ask for the rest of `dt`. Ctrl-C for the second time interrupts the step and undoes the call.
        """
        self._refuse_open_count()
        if (dt := checks.check_duration(dt)) > 0.0:
            self._call.run(dt, stop_at_rest=False)

    def run_until_rest(self, max_duration: float = 3600.0) -> bool:
        """Run the event until everything is at rest and no inflow is left, or for a longest time.

        Parameters
        ----------
        max_duration : float
            Longest time to simulate [s].

        Returns
        -------
        bool
            True if the flow is at rest (and settled). False if it still moves; then no mass settles, a warning tells
            how much moves and how fast, and another call goes on.

        Raises
        ------
        As `run_one_step`
            After Ctrl-C, or an observer that failed, call again to go on.
        """
        if (duration := checks.check_duration(max_duration, "max_duration")) > 0.0:
            self._find_count(duration)
            self._call.run(duration, stop_at_rest=True)
        return self.at_rest

    def settle(self) -> None:
        """Lay the mass at rest into elevation and soil; the particles go.

        Raises
        ------
        InputError
            If something still moves.
        """
        if not self.at_rest:
            reason = "something has yet to flow in" if self._simulation.idle else "the flow still moves"
            raise checks.InputError(f"settle() lays down mass at rest, but {reason}; run_until_rest() first")
        self._call.settle()

    def new_event(self) -> None:
        """Start the maps of peaks (``max_...``) and the arrival time anew.

        Erosion, deposit, budget and elapsed time, which arrival time counts, go on. Call it between two events.

        Raises
        ------
        InputError
            If something still moves or has yet to flow in.
        """
        if not self.at_rest:
            raise checks.InputError(
                "new_event() starts peaks and arrival time anew, but the last event is not over: something still moves "
                "or has yet to flow in; run_until_rest() first"
            )
        self._call.restart_peaks()

    @property
    def setup(self) -> Setup:
        """Laws, material, numerics and inflow, as they were checked: a `Setup`."""
        return self._setup

    @property
    def elapsed_time(self) -> float:
        """Time simulated so far [s], in all calls, and by the component that this one continues."""
        return self._simulation.time

    @property
    def at_rest(self) -> bool:
        """Whether the whole flow is at rest."""
        return self._simulation.at_rest

    @property
    def budget(self) -> dict[str, float]:
        """Volumes so far [m3]: released + inflow + eroded = moving + deposited + outflow, up to the residual.

        Each is measured on its own: release field, hydrographs, soil field, particles, elevation field,
        particles that left. ``moving`` counts all particles, also those at rest but not settled.
        """
        return self._call.budget

    @property
    def budget_by_phase(self) -> dict[str, dict[str, float]]:
        """Volume budget so far of ``"solid"`` and ``"water"`` [m3]: grains, and pore fluid (water if saturated).

        The porosities divide released, inflowing and eroded volume among the phases.
        """
        return self._call.budget_by_phase

    @property
    def outflow_by_edge(self) -> dict[str, float]:
        """Volume that left over each side of the grid, or over open nodes inside it [m3]."""
        return self._simulation.state.outflow.by_edge(*self.grid.shape)

    @property
    def diagnostics(self) -> Diagnostics:
        """Cost of the run so far: number of steps, smallest step [s], share of particles asleep, CPU seconds by stage.

        A `model.diagnostics.Diagnostics`, of all calls of this component.
        """
        return self._simulation.diagnostics

    @property
    def particles(self) -> xr.Dataset:
        """The particles now: a Dataset over ``particle`` with map coordinates of the grid."""
        sim = self._simulation
        return particles_dataset(sim.particles, self.grid.xy_of_lower_left, self._setup, self.elapsed_time)

    @property
    def columns(self) -> xr.Dataset:
        """Excess pore pressure over ``particle`` and ``level`` (0 at the base, 1 at the surface), column states."""
        sim = self._simulation
        c_v = sim.phases.coefficient_of_consolidation(sim.particles, slice(None))
        return columns_dataset(sim.columns_now(), sim.particles, c_v, self._setup, self.elapsed_time)

    @property
    def maps(self) -> xr.Dataset:
        """Elevation, soil and outputs as a Dataset over ``y`` and ``x``, with units, budget and all parameters.

        Closed nodes are missing (NaN), except in the maps of impact pressure and run-up, which show the impact of the
        flow on them, and where debris was left before they were closed.
        """
        shown = self._call.maps()
        moment = moment_attributes(self.elapsed_time, self._simulation.particles, self.budget)
        return maps_dataset(self.grid, shown, self._setup, moment)
