"""Columns by themselves: the excess pore pressure below a thickness that is given, without a flow."""

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from ..physics.column.diagnostics import basal_peclet_number, consolidation_time, erosion_time
from ..physics.column.driver import Columns
from ..physics.column_contracts import BaseContact
from .arguments import History, Inputs, read_inputs, refuse
from .dataset import dataset

DRAINED, PRESCRIBED = np.int8(BaseContact.DRAINED), np.int8(BaseContact.PRESCRIBED)
# largest relative growth or strain of a column in a step; longest step over all times if inputs vary
CHANGE = 1.0 / 400.0
TOO_SHORT = 1e-13  # least step over all times: rounding would swallow a shorter one
BOUNDS = 1e-100, 1e100  # thickness [m] whose square is neither 0 nor infinite


def solve_column(
    thickness: ArrayLike = 1.0,
    entrainment_rate: ArrayLike | Callable[[float], ArrayLike] = 0.01,
    coefficient_of_consolidation: ArrayLike | Mapping[str, float] = 1e-3,
    basal_pressure: ArrayLike | Callable[[float], ArrayLike] = 1.0,
    times: ArrayLike | None = None,
    initial: str | ArrayLike = "zero",
    initial_pressure: ArrayLike | None = None,
    initial_layer_fraction: float = 0.1,
    base: str | Sequence[str] | Callable[[float], str | Sequence[str]] = "by_erosion",
    bed_contact: str = "dirichlet",
    divergence_rate: ArrayLike | Callable[[float], ArrayLike] = 0.0,
    loading: ArrayLike = 0.0,
    loading_source: str = "overburden",
    porosity_source: ArrayLike | Callable[[float], ArrayLike] = 0.0,
    source_includes_erosion: bool = False,
    bounded: bool = False,
    law: Any = "ale",
    scheme: str = "default",
    levels: int = 11,
    advance: str = "lazy",
    step: float | None = None,
    tolerance: float | None = None,
    basal_pressure_ratio: ArrayLike | Callable[[float], ArrayLike] | None = None,
) -> xr.Dataset:
    """Solve for the excess pore pressure in columns that erode, strain and consolidate.

    ``dp/dt + (e_R/h)(1 - xi) dp/dxi = (c_v/h^2) d2p/dxi2 + S`` with ``dh/dt = e_R - D h`` and p = 0 at the
    surface (Pastor et al., 2022, eq. 35). All lengths are slope-normal. "Per column" means one number, or
    one for each of n columns. The columns do not act on each other, but take the same time steps.

    Parameters
    ----------
    thickness : float or array_like, shape (column,)
        h at time 0, > 0 [m].
    entrainment_rate : float, array_like or function of time
        e_R >= 0, per column [m s-1]. A function gets the time [s] and returns one number or one per column.
    coefficient_of_consolidation : float, array_like or mapping
        c_v >= 0, per column [m2 s-1]; or what it follows from, ``{"permeability": ..., "pore_fluid_viscosity": ...,
        "stiffness": ...}`` [m2, Pa s, Pa], for all columns.
    basal_pressure : float, array_like or function of time
        Excess pore pressure of the bed, per column [Pa].
    times : array_like, shape (time,)
        Times of output, increasing [s]; the columns start at time 0. Required.
    initial : {"zero", "linear", "uniform", "basal_layer"} or array_like, shape (levels,) or (column, levels)
        Pressure at time 0: a word, or at levels, index 0 at the base and 0 at the surface [Pa]. With
        `loading`, "uniform" and "basal_layer" are capped at the liquefaction pressure of each level.
    initial_pressure : float or array_like, optional
        Pressure at the base for an `initial` given as a word, per column [Pa]; by default the bed's at time 0.
    initial_layer_fraction : float
        Thickness of the basal layer over that of the column, in [0, 1] [-].
    base : {"by_erosion", "prescribed", "impermeable", "drained"}, array_like of them or function of time
        Whether the bed prescribes the pressure of the base while the column erodes (and is impermeable
        else), always or never; "drained" prescribes 0. Per column.
    bed_contact : {"dirichlet", "flux"}
        Whether an eroding base takes the pressure of the bed, or only gains the pressure of the entrained soil.
    divergence_rate : float, array_like or function of time
        D, the strain rate at which a column spreads and thins, per column [s-1].
    loading : float or array_like
        ``rho' g cos(theta)`` >= 0, per column [Pa m-1]; liquefaction pressure is loading times thickness.
        0, in all columns, leaves the source by loading out.
    loading_source : {"overburden", "proportional", "none"}
        Source of pressure by a change of thickness through strain, if there is a loading.
    porosity_source : float, array_like or function of time
        Pressure made everywhere in the column by a change of porosity, per column [Pa s-1].
    source_includes_erosion : bool
        Load grains by soil that comes in below them too (eqs. 19 and 38 to the letter); to replicate only.
    bounded : bool
        Show the pressure between suction, with the densities of `Material`, and liquefaction (docs/theory.md#bounds).
    law : {"ale", "classical", "constant_ratio"}
        "constant_ratio" has the pressure ``basal_pressure_ratio * loading * y`` at the depth y, whatever the
        start, the base and the diffusion are.
    scheme : str
        How the equation is solved; see `ALE`.
    levels : int
        Number of levels, base and surface included, in [3, 1001].
    advance : {"lazy", "every_step"}
        Whether a column may be left alone until it is due.
    step : float, optional
        Longest time step [s]. If None, no column grows or strains by more than 1/400 in one step, and at least
        400 steps cover the times if anything is a function of time or the scheme is not the default one.
        Rates are taken at the middle of a step, pressures of the bed at its end.
    tolerance : float, optional
        Error of the pressure, over liquefaction pressure, that laziness aims at [-]; None is that of the law. It is
        no bound: below 1e-2 the error falls more slowly than the tolerance (7e-4 for 1e-4, at worst).
    basal_pressure_ratio : float, array_like or function of time, optional
        In [0, 1], per column [-]: the pressure of the bed is this times loading times the present thickness.

    Returns
    -------
    xarray.Dataset
        ``excess_pore_pressure(time, column, level)``; over ``time`` and ``column``: ``thickness``,
        ``basal_excess_pore_pressure`` (for friction), ``basal_peclet_number``, ``front_height`` (0
        until something eroded), ``front_age`` (NaN until then), ``consolidation_time``, ``erosion_time``,
        ``clipped_pressure``; ``initial_peclet_number(column)``, the paper's Pe0. The coordinate ``level`` is
        xi, 0 at the base and 1 at the surface. Units are in the attributes, as are the parameters that are
        one number or word. The base level stands for half a cell: it takes the pressure of a base that
        has just begun to be prescribed when that half cell is filled.

    Raises
    ------
    ParameterError
        If an argument is not usable or does not go with another, if a function of time returns a value that is not
        usable, or if a column thins to nothing.

    Examples
    --------
    The paper's column erodes twice its thickness: new soil fills it to 2/3, and carries the bed's pressure.

    >>> column = solve_column(entrainment_rate=0.01, coefficient_of_consolidation=1e-4, times=[0.0, 200.0])
    >>> column.basal_peclet_number.values.ravel().round(6).tolist()
    [100.0, 300.0]
    >>> column.front_height.values.ravel().round(6).tolist()
    [0.0, 0.666667]
    >>> column.excess_pore_pressure.sel(time=200.0, level=[0.0, 0.5, 1.0]).values.ravel().round(1).tolist()
    [1.0, 1.0, 0.0]
    """
    given = dict(locals())
    inputs = read_inputs(given)
    history, output = _History(inputs), []
    for time in inputs.times:
        history.advance_to(float(time))
        output.append(history.output())
    return dataset(inputs, given, output)


class _History:
    """Columns under way; their volumes are over 1 m2 at time 0, so that only erosion makes them grow.

    `inputs` are the checked arguments of `solve_column`.
    """

    def __init__(self, inputs: Inputs):
        self.inputs, self.time = inputs, 0.0
        load = inputs.liquefaction_pressure(inputs.thickness)
        self.columns = Columns(
            inputs.law, inputs.profile, inputs.thickness, liquefaction_pressure=load, bounded=inputs.bounded,
            coefficient_of_consolidation=inputs.coefficient_of_consolidation,
            **self._base(0.0, 0.0, inputs.thickness),
        )  # fmt: skip
        self.first_eroded = np.where(inputs.entrainment_rate.at(0.0) > 0.0, 0.0, np.nan)
        self.varies = any(isinstance(field, History) and field.varies for field in inputs)

    def advance_to(self, end: float) -> None:
        """Advance the columns in place by steps of which the last one ends at the time `end` [s]."""
        while self.time < end:
            left = end - self.time
            dt = self._longest_step(left)
            if dt < TOO_SHORT * self.inputs.times[-1]:
                refuse(
                    f"at t = {self.time:g} s a step of {dt:.3g} s is needed, too short for times up to "
                    f"{self.inputs.times[-1]:g} s; lower entrainment_rate or divergence_rate, or give a longer step"
                )
            steps = math.ceil(left / dt * (1.0 - 1e-9))
            self._step(end if steps == 1 else self.time + left / steps)

    def _longest_step(self, left: float) -> float:
        inputs = self.inputs
        if inputs.step is not None:
            return min(left, inputs.step)
        dt = left
        if self.varies or getattr(inputs.law, "scheme", "default") != "default":
            dt = min(dt, CHANGE * inputs.times[-1])
        for _ in range(100):  # rates are taken at the middle of the step, which moves when the step is shortened
            middle = self.time + 0.5 * dt
            growth = inputs.entrainment_rate.at(middle) / self.columns.forcing.thickness
            strain = inputs.divergence_rate.at(middle)
            fastest = max(growth.max(), np.abs(strain).max()) / CHANGE
            if dt * fastest <= 1.0 + 1e-9:
                break
            dt = 1.0 / fastest
        return dt

    def _step(self, end: float) -> None:
        """Advance to `end` [s]: thickness and volume exactly for rates that are constant in the step."""
        inputs, dt, middle, before = self.inputs, end - self.time, 0.5 * (self.time + end), self.columns.forcing
        rate, strain = inputs.entrainment_rate.at(middle), inputs.divergence_rate.at(middle) * dt
        with np.errstate(over="ignore"):  # an infinite thickness is refused below
            gain = np.divide(np.expm1(strain), strain, out=np.ones_like(strain), where=strain != 0.0)
            growth = rate * dt / before.thickness * gain  # relative growth of the volume
            thickness = before.thickness * np.exp(-strain) * (1.0 + growth)
            entrained = before.volume * growth
            volume = before.volume + entrained
        low, high = BOUNDS
        bad = np.flatnonzero(~((thickness > low) & (thickness < high) & (volume < high)))
        if bad.size:
            refuse(
                f"thickness of column {bad[0]} became {thickness[bad[0]]:g} m, without strain {volume[bad[0]]:g} m, at "
                f"t = {end:g} s; both must stay in ({low:g}, {high:g}): lower divergence_rate or entrainment_rate, or "
                "end times before that"
            )
        self.first_eroded = np.where(np.isnan(self.first_eroded) & (rate > 0.0), self.time, self.first_eroded)
        self.time = end
        self.columns.step(
            dt, entrained, volume=volume, thickness=thickness,
            liquefaction_pressure=inputs.liquefaction_pressure(thickness), **self._base(end, middle, thickness),
        )  # fmt: skip

    def _base(self, time: float, middle: float, thickness) -> dict[str, np.ndarray]:
        """Return the members of `ColumnForcing` that come from the bed, in a step that ends at `time` [s].

        `middle` is the middle of the step [s], `thickness` that at its end, shape (n,) [m].
        """
        inputs = self.inputs
        base, bed = inputs.base.at(middle), inputs.bed_pressure(time, thickness)
        drained = base == DRAINED
        return {
            "base": np.where(drained, PRESCRIBED, base),
            "bed_pressure": np.where(drained, 0.0, bed),
            "porosity_source": inputs.porosity_source.at(middle),
        }

    def output(self) -> dict[str, np.ndarray]:
        """Return the arrays of `dataset.VARIABLES` now; output does not advance a column that is left alone."""
        inputs, columns, rate = self.inputs, self.columns, self.inputs.entrainment_rate.at(self.time)
        coefficient, thickness = inputs.coefficient_of_consolidation, columns.forcing.thickness
        state = columns.synchronised()
        return {
            "excess_pore_pressure": state.profile,
            "thickness": thickness,
            # nothing has been in contact with the bed yet at time 0
            "basal_excess_pore_pressure": columns.basal_pressure.copy() if self.time > 0.0 else state.profile[:, 0],
            "basal_peclet_number": basal_peclet_number(rate, thickness, coefficient),
            "front_height": 1.0 - inputs.thickness / columns.forcing.volume,
            "front_age": self.time - self.first_eroded,
            "consolidation_time": consolidation_time(thickness, coefficient),
            "erosion_time": erosion_time(thickness, rate),
            "clipped_pressure": state.clipped,
        }
