"""Columns by themselves: the excess pore pressure below a thickness that is given, without a flow."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import xarray as xr
from numpy.typing import ArrayLike

from ..physics.column.driver import SOLID_DENSITY
from .advance import AdvancedColumns
from .arguments import read_inputs
from .dataset import dataset


def solve_column(
    thickness: ArrayLike = 1.0,
    entrainment_rate: ArrayLike | Callable[[float], ArrayLike] = 0.01,
    coefficient_of_consolidation: ArrayLike | Mapping[str, float] | None = None,
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
    dilatancy: Any = None,
    shear_rate: ArrayLike | Callable[[float], ArrayLike] = 0.0,
    solid_fraction: ArrayLike | None = None,
    soil_solid_fraction: float | None = None,
    solid_density: float = SOLID_DENSITY,
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
    coefficient_of_consolidation : float, array_like or mapping, optional
        c_v >= 0, per column, by default 1e-3 [m2 s-1]; or what it follows from, ``{"permeability": ...,
        "pore_fluid_viscosity": ..., "stiffness": ...}`` [m2, Pa s, Pa], for all columns. With `dilatancy` c_v
        follows from the state and is left out.
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
        400 steps cover the times if anything is a function of time or the scheme is not the default one. With
        dilatancy 400 steps cover them, too, and no step is longer than a strain of 1/20 or, later, 1/100 of the time.
        Rates are taken at the middle of a step, pressures of the bed at its end.
    tolerance : float, optional
        Error of the pressure, over liquefaction pressure, that laziness aims at [-]; None is that of the law. It is
        no bound: below 1e-2 the error falls more slowly than the tolerance (7e-4 for 1e-4, at worst).
    basal_pressure_ratio : float, array_like or function of time, optional
        In [0, 1], per column [-]: the pressure of the bed is this times loading times the present thickness.
    dilatancy : Dilatancy or dict, optional
        Parameters of debris that contracts or dilates as it is sheared (`laws.Dilatancy`); {} has their defaults. Needs
        a loading. The pressure is then bounded.
    shear_rate : float, array_like or function of time
        With dilatancy, >= 0, per column [s-1]; twice the mean velocity over the thickness in a flow.
    solid_fraction : float or array_like, optional
        With dilatancy, at time 0, per column, in [0.3, 0.74] [-]; by default that of `Material`.
    soil_solid_fraction : float, optional
        With dilatancy, of the soil that comes in [-]; by default that of the columns at time 0; needed where columns of
        different solid fractions erode.
    solid_density : float
        With dilatancy, of the grains [kg m-3].

    Returns
    -------
    xarray.Dataset
        ``excess_pore_pressure(time, column, level)``; over ``time`` and ``column``: ``thickness``,
        ``basal_excess_pore_pressure`` (for friction), ``basal_peclet_number``, ``front_height`` (0
        until something eroded), ``front_age`` (NaN until then), ``consolidation_time``, ``erosion_time``,
        ``clipped_pressure``; ``initial_peclet_number(column)``, the paper's Pe0. With dilatancy also
        ``solid_fraction(time, column, level)`` and, at the base, ``dilatancy_angle`` [deg] and
        ``coefficient_of_consolidation``, from which the times and numbers follow. The coordinate ``level`` is
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

    Debris half a metre thick, hydrostatic, is sheared: loose, it liquefies; dense, it gets stronger by suction.

    >>> column = solve_column(
    ...     thickness=0.5, entrainment_rate=0.0, loading=8000.0, dilatancy={"permeability": 1e-11},
    ...     solid_fraction=[0.6, 0.66], shear_rate=10.0, times=[0.0, 0.5], initial="zero",
    ... )
    >>> column.basal_excess_pore_pressure.values.round(-1)
    array([[    0.,     0.],
           [ 3990., -4040.]])
    """
    given = dict(locals())
    inputs = read_inputs(given)
    history, output = AdvancedColumns(inputs), []
    start = history.coefficient_of_consolidation()
    for time in inputs.times:
        history.advance_to(float(time))
        output.append(history.output())
    return dataset(inputs, given, output, start)
