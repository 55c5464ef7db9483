"""Drive columns whose debris contracts or dilates."""

import numpy as np

from landlab_debrisflow.physics.column import ALE, driver
from landlab_debrisflow.physics.column.dilatancy import Dilatancy

WATER_TO_BUOYANT = driver.WATER_TO_BUOYANT
LOADING = 990.0 * 9.81
SOLID_DENSITY = 2700.0


def dilatant_columns(dilatancy, thickness, solid_fraction, shear_rate=0.0, profile=None, **given):
    """Return `Columns` of the ALE law, hydrostatic if no profile is given [Pa], under a load of 990 kg/m3.

    Parameters
    ----------
    dilatancy : dict
        Parameters of `Dilatancy`.
    thickness : array_like, shape (n,)
        [m].
    solid_fraction, shear_rate
        As of `driver.Columns`.
    profile : array_like, shape (n, levels), optional
        [Pa].
    **given
        Parameters of `ALE` that it has, else other arguments of `driver.Columns`.
    """
    parameters = {name: given.pop(name) for name in ("levels", "loading_source", "bed_contact") if name in given}
    law, thickness = ALE(dilatancy=dilatancy, **parameters), np.atleast_1d(np.asarray(thickness, dtype=float))
    profile = np.zeros((thickness.size, law.levels)) if profile is None else profile
    return driver.Columns(
        law, profile, thickness, liquefaction_pressure=LOADING * thickness, solid_fraction=solid_fraction,
        shear_rate=shear_rate, solid_density=SOLID_DENSITY, **given,
    )  # fmt: skip


def stresses(columns):
    """Return the effective stress at the levels, index 0 at the base, shape (n, levels) [Pa]."""
    load = columns.forcing.liquefaction_pressure[:, None]
    return load * np.linspace(1.0, 0.0, columns.state.profile.shape[1]) - columns.profile()


def conductivity(dilatancy, solid_fraction):
    """Return k_w = k exp((0.6 - m)/0.04)/mu by the formula [m2 Pa-1 s-1]."""
    law = Dilatancy(**dilatancy)
    return law.permeability / law.pore_fluid_viscosity * np.exp((0.6 - solid_fraction) / 0.04)


def fluxes(dilatancy, before, columns):
    """Return the flux of water up through the faces, base first, from fractions `before` and pressures now [m s-1].

    Shape (n, levels - 1): face j lies between the levels j and j + 1; the surface has the fraction of the level below.
    """
    fraction = before.copy()
    fraction[:, -1] = fraction[:, -2]
    mean = 0.5 * (fraction[:, 1:] + fraction[:, :-1])
    cells = before.shape[1] - 1
    width = columns.forcing.thickness[:, None] / cells
    return -conductivity(dilatancy, mean) * np.diff(columns.profile(), axis=1) / width


def mean(values):
    """Return the depth mean of values at levels, the last axis, trapezoidal."""
    return (values[..., 1:-1].sum(axis=-1) + 0.5 * (values[..., 0] + values[..., -1])) / (values.shape[-1] - 1)
