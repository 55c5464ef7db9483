"""Columns of `solve_column` under way: the lengths of their steps, and their state at the times of output."""

import math

import numpy as np

from ..physics.column.diagnostics import basal_peclet_number, consolidation_time, erosion_time
from ..physics.column.driver import Columns
from ..physics.column_contracts import BaseContact, is_dilatant
from .arguments import Inputs
from .history import History, refuse

DRAINED, PRESCRIBED = np.int8(BaseContact.DRAINED), np.int8(BaseContact.PRESCRIBED)
# largest relative growth or strain of a column in a step; longest step over all times if inputs vary
CHANGE = 1.0 / 400.0
# with dilatancy, of a step: shear strain; or, if longer, its fraction of the time since the start
STRAIN, FRACTION = 0.05, 0.01
TOO_SHORT = 1e-13  # least step over all times: rounding would swallow a shorter one
BOUNDS = 1e-100, 1e100  # thickness [m] whose square is neither 0 nor infinite


class AdvancedColumns:
    """Columns under way; their volumes are over 1 m2 at time 0, so that only erosion makes them grow.

    `inputs` are the checked arguments of `solve_column`.
    """

    def __init__(self, inputs: Inputs):
        self.inputs, self.time = inputs, 0.0
        load = inputs.liquefaction_pressure(inputs.thickness)
        self.columns = Columns(
            inputs.law, inputs.profile, inputs.thickness, liquefaction_pressure=load, bounded=inputs.bounded,
            coefficient_of_consolidation=inputs.coefficient_of_consolidation, shear_rate=inputs.shear_rate.at(0.0),
            solid_fraction=inputs.solid_fraction, soil_solid_fraction=inputs.soil_solid_fraction,
            solid_density=inputs.solid_density,
            **self._base(0.0, 0.0, inputs.thickness),
        )  # fmt: skip
        self.first_eroded = np.where(inputs.entrainment_rate.at(0.0) > 0.0, 0.0, np.nan)
        self.varies = any(isinstance(field, History) and field.varies for field in inputs)
        self.is_dilatant = is_dilatant(inputs.law)

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
        if self.varies or self.is_dilatant or getattr(inputs.law, "scheme", "default") != "default":
            dt = min(dt, CHANGE * inputs.times[-1])
        if self.is_dilatant:
            fastest = inputs.shear_rate.at(self.time).max()
            dt = min(dt, max(STRAIN / max(fastest, STRAIN / dt), FRACTION * self.time))
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
            dt, entrained, inputs.shear_rate.at(middle), volume=volume, thickness=thickness,
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

    def coefficient_of_consolidation(self) -> np.ndarray:
        """Return c_v now, of a law with dilatancy at the base, shape (column,) [m2 s-1]."""
        if not self.is_dilatant:
            return self.inputs.coefficient_of_consolidation
        return self.columns.at_base().coefficient_of_consolidation.copy()

    def output(self) -> dict[str, np.ndarray]:
        """Return the arrays of `dataset.VARIABLES` now; output does not advance a column that is left alone."""
        inputs, columns, rate = self.inputs, self.columns, self.inputs.entrainment_rate.at(self.time)
        coefficient, thickness = self.coefficient_of_consolidation(), columns.forcing.thickness
        state = columns.synchronised()
        dilatant = {}
        if self.is_dilatant:
            angle = np.degrees(np.arctan(columns.at_base().dilatancy))
            dilatant = {
                "solid_fraction": state.solid_fraction, "dilatancy_angle": angle,
                "coefficient_of_consolidation": coefficient,
            }  # fmt: skip
        return dilatant | {
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
