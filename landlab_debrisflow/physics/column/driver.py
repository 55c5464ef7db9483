"""Columns without a flow: a law advanced by a history of thickness, load and erosion that is given."""

import numpy as np

from ..column_contracts import BaseContact, ColumnForcing, ColumnState, DilatantBase, Shearing, is_dilatant
from ..material import Material

WATER_TO_BUOYANT = Material().water_density / Material().buoyant_density
"""Lower bound of the pressure ratio with the densities of `Material` [-]."""

PER_COLUMN = {"volume", "thickness", "liquefaction_pressure", "entrained"}
SWITCHES = {"water_to_buoyant", "bounded", "shearing"}

SOLID_DENSITY = Material().solid_density
"""Density of the grains, if none is given [kg m-3]."""

PACKED = 1.0 - Material().porosity
"""Solid fraction of columns of a law with dilatancy, if none is given [-]."""


def forcing_at_rest(
    volume, thickness, liquefaction_pressure, *, coefficient_of_consolidation=0.0, bed_pressure=0.0,
    base=BaseContact.BY_EROSION, porosity_source=0.0, water_to_buoyant=WATER_TO_BUOYANT, bounded=True, shearing=None,
) -> ColumnForcing:  # fmt: skip
    """Return the forcing of columns without inflow of soil.

    Parameters
    ----------
    volume : array_like, shape (n,)
        Volume of the particles [m3].
    thickness : array_like, shape (n,)
        Slope-normal [m].
    liquefaction_pressure : array_like, shape (n,)
        Load of the columns [Pa].
    coefficient_of_consolidation, bed_pressure, base, porosity_source : float or array_like, shape (n,), optional
        Members of `ColumnForcing`.
    water_to_buoyant : float, optional
        Density of water over buoyant density [-].
    bounded : bool, optional
        Whether pressure above liquefaction is taken off, and seen as no less than suction.
    shearing : Shearing, optional
        Shear of the columns of a law with dilatancy; not copied.

    Returns
    -------
    ColumnForcing
        Forcing with arrays of its own.
    """
    members = {
        "volume": volume,
        "thickness": thickness,
        "liquefaction_pressure": liquefaction_pressure,
        "entrained": 0.0,
        "bed_pressure": bed_pressure,
        "base": base,
        "porosity_source": porosity_source,
        "coefficient_of_consolidation": coefficient_of_consolidation,
        "water_to_buoyant": water_to_buoyant,
        "bounded": bounded,
        "shearing": shearing,
    }
    arrays = _arrays(members, np.size(volume))
    return ColumnForcing(**{name: value.copy() if name not in SWITCHES else value for name, value in arrays.items()})


def _arrays(members, count: int) -> dict:
    """Return members of `ColumnForcing` in their type and shape; arrays that have these already are not copied."""
    arrays = {}
    for name, value in members.items():
        if name not in SWITCHES:
            value = np.asarray(value, np.int8 if name == "base" else float)
            if name in PER_COLUMN and value.shape != (count,):
                value = np.full(count, value)
            elif value.ndim == 0:
                value = value.reshape(1)
        arrays[name] = value
    return arrays


def _per_column(values, count: int) -> np.ndarray:
    """Return one number, or one per column, as an array of shape (n,)."""
    return np.array(np.broadcast_to(np.asarray(values, dtype=float), (count,)))


class Columns:
    """Columns of one law and the forcing of their last step.

    Parameters
    ----------
    law : ColumnLaw
        Advances the columns.
    profile : array_like, shape (n, levels)
        Excess pore pressure at the start, index 0 at the base; copied [Pa].
    thickness : array_like, shape (n,)
        Slope-normal, at the start [m].
    volume : array_like, shape (n,), optional
        At the start [m3]; the thickness if None, as over one square metre.
    liquefaction_pressure : array_like, shape (n,)
        At the start [Pa].
    solid_fraction : float or array_like, shape (n,) or (n, levels), optional
        At the start, of a law with dilatancy [-].
    soil_solid_fraction : float, optional
        Of the soil that comes in [-]; the same, if it is one number.
    solid_density : float, optional
        Density of the grains [kg m-3].
    shear_rate : float or array_like, shape (n,), optional
        At the start, read by a law with dilatancy [s-1].
    **forcing
        Other arguments of `forcing_at_rest`.

    Attributes
    ----------
    state : ColumnState
        Columns in the law's own form.
    forcing : ColumnForcing
        Forcing of the last step.
    basal_pressure : ndarray, shape (n,)
        Excess pore pressure at the base, for friction [Pa].

    Examples
    --------
    >>> from landlab_debrisflow.physics.column import ConstantRatio
    >>> columns = Columns(ConstantRatio(ratio=0.5), [[0.0, 0.0]], [1.0], liquefaction_pressure=[1e4])
    >>> columns.step(1.0, entrained=1.0), columns.forcing.thickness
    (array([10000.]), array([2.]))
    """

    def __init__(
        self, law, profile, thickness, *, liquefaction_pressure, volume=None, solid_fraction=PACKED,
        soil_solid_fraction=None, solid_density=SOLID_DENSITY, shear_rate=0.0, **forcing,
    ):  # fmt: skip
        profile = np.array(profile, dtype=float)
        count, fractions = profile.shape[0], None
        volume = thickness if volume is None else volume
        self.law, self.forcing = law, forcing_at_rest(volume, thickness, liquefaction_pressure, **forcing)
        if is_dilatant(law):
            given = np.asarray(solid_fraction, dtype=float)
            fractions = np.array(np.broadcast_to(given[:, None] if given.ndim == 1 else given, profile.shape))
            first = fractions.flat[0] if count else PACKED
            soil = float(first if soil_solid_fraction is None else soil_solid_fraction)
            shearing = Shearing(
                rate=_per_column(shear_rate, count), load=self.forcing.liquefaction_pressure,
                start_solid_fraction=PACKED, soil_solid_fraction=soil, solid_density=solid_density,
            )  # fmt: skip
            self.forcing = self.forcing._replace(shearing=shearing)
        self.state = ColumnState(profile, np.zeros((count, law.memory_size)), np.zeros(count), fractions)
        self.basal_pressure = np.zeros(count)
        law.advance(self.state, self.forcing, 0.0, self.basal_pressure)

    def step(self, dt: float, entrained=0.0, shear_rate=None, **changes) -> np.ndarray:
        """Advance the columns by one step.

        Parameters
        ----------
        dt : float
            Duration [s].
        entrained : float or array_like, shape (n,), optional
            Volume that comes in at the base [m3].
        shear_rate : float or array_like, shape (n,), optional
            Of a law with dilatancy [s-1]; as before if None.
        **changes
            Members of `ColumnForcing` that are not as before. Without them the thickness grows as the volume does, and
            the liquefaction pressure as the thickness. Arrays are kept, not copied: they must not change any more.

        Returns
        -------
        ndarray, shape (n,)
            Excess pore pressure at the base, for friction [Pa].
        """
        old = self.forcing
        changes = _arrays({"entrained": entrained, **changes}, old.volume.size)
        if "volume" not in changes:
            changes["volume"] = old.volume + changes["entrained"]
        if "thickness" not in changes:
            changes["thickness"] = old.thickness * (changes["volume"] / old.volume)
        if "liquefaction_pressure" not in changes:
            changes["liquefaction_pressure"] = old.liquefaction_pressure * (changes["thickness"] / old.thickness)
        if old.shearing is not None:
            rate = old.shearing.rate if shear_rate is None else _per_column(shear_rate, old.volume.size)
            changes["shearing"] = old.shearing._replace(rate=rate, load=changes["liquefaction_pressure"])
        self.forcing = old._replace(**changes)
        self.law.advance(self.state, self.forcing, dt, self.basal_pressure)
        return self.basal_pressure.copy()

    def synchronise(self) -> None:
        """Turn all columns into pressures at levels as they are now, in place."""
        self.law.synchronise(self.state, self.forcing._replace(entrained=np.zeros_like(self.basal_pressure)))

    def synchronised(self) -> ColumnState:
        """Return a copy of the columns as pressures at levels; the columns themselves are left alone."""
        state = self.state.copy()
        self.law.synchronise(state, self.forcing._replace(entrained=np.zeros_like(self.basal_pressure)))
        return state

    def profile(self) -> np.ndarray:
        """Return the excess pore pressure at the levels, shape (n, levels) [Pa]."""
        return self.synchronised().profile

    def at_base(self) -> DilatantBase:
        """Return the debris at the base of columns of a law with dilatancy: views of the present values."""
        return self.law.at_base(self.state.memory)

    def content(self) -> np.ndarray:
        """Return the excess pore pressure integrated over the thickness, shape (n,) [Pa m]."""
        return depth_mean(self.profile()) * self.forcing.thickness


def depth_mean(profile) -> np.ndarray:
    """Return the mean of profiles over the depth, trapezoidal as the laws count it, shape (n,) [Pa]."""
    return (profile[:, 1:-1].sum(axis=1) + 0.5 * (profile[:, 0] + profile[:, -1])) / (profile.shape[1] - 1)
