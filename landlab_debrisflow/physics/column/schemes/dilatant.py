"""The scheme of columns whose debris contracts or dilates: every column is advanced in every step.

A step loads the column, lets in the soil that was eroded, and advances effective stress and solid fraction implicitly
(`dilatant_solution`). Grains keep their effective stress and their solid fraction while no water moves.
"""

import numpy as np

from ....core.constants import THINNEST
from ....core.jit import allocating_kernel, inner
from ..dilatancy import DENSEST, LOOSEST
from .choices import PROPORTIONAL, UNLOADED
from .contact import IMPERMEABLE, INFLOW, SEALED, contact_of
from .dilatant_block import LANES, NOT_PRESCRIBED, Block, Rates, describe_base
from .dilatant_solution import solve_block
from .lazy.remap import cubic_between, interpolate

# places in `ColumnState.memory`: 1 once the column is known; load at the base at the end of the last step [Pa]; tangent
# of the angle of dilatancy at the base [-]; viscosity of the pore fluid there, over the mixture [Pa s]; coefficient of
# consolidation there [m2 s-1]
IS_KNOWN, LAST_LOAD, DILATANCY, FLUID, COEFFICIENT = range(5)
SIZE = 5


def advance_dilatant(columns, forcing, dt, basal_pressure, scheme, law):
    """Advance all columns by one step of the flow.

    Parameters
    ----------
    columns : ColumnState
        Written in place.
    forcing : ColumnForcing
        The step, with its shearing.
    dt : float
        Duration [s].
    basal_pressure : ndarray, shape (n,)
        Written: the excess pore pressure at the base, for friction [Pa].
    scheme : Scheme
        Choices of the law.
    law : Dilatant
        Constants of dilatancy.
    """
    # one level below the base, whose change is 0
    scratch, numbers = np.zeros((7, columns.profile.shape[1] + 1, LANES)), np.empty((5, LANES))
    block = Block(
        stress=scratch[0, :-1], fraction=scratch[1, :-1], logarithm=scratch[2], conductance=scratch[3],
        storage=scratch[4], eliminated=scratch[5], change=scratch[6],
    )  # fmt: skip
    rates = Rates(shear=numbers[0], load=numbers[1], thickness=numbers[2], most=numbers[3], prescribed=numbers[4])
    _advance(columns, forcing, dt, basal_pressure, scheme, law, block, rates)


@allocating_kernel
def _advance(columns, forcing, dt, basal_pressure, scheme, law, block, step):
    """Do the work of `advance_dilatant`; `block` and `step`, the `Rates`, are scratch, the others are its arguments."""
    # taken out of their tuples once: numba counts references at every access
    stress, fraction, _, _, _, _, _ = block
    shear, load, thickness, most, prescribed = step
    profile, fractions, memory = columns.profile, columns.solid_fraction, columns.memory
    rates, loads = forcing.shearing.rate, forcing.shearing.load
    start, soil = forcing.shearing.start_solid_fraction, forcing.shearing.soil_solid_fraction
    thicknesses, beds, bases = forcing.thickness, forcing.bed_pressure, forcing.base
    volumes, entrained, ratio = forcing.volume, forcing.entrained, forcing.water_to_buoyant
    count, levels = profile.shape
    cells = levels - 1
    work, eta = np.empty((2, levels)), np.arange(levels) / cells
    dilatancy, coefficient = np.empty(LANES), np.empty(LANES)
    for first in range(0, count, LANES):
        for b in range(LANES):
            i = min(first + b, count - 1)  # lanes beyond the last column repeat it, and are not read
            weight, volume, gained = loads[i], volumes[i], entrained[i]
            before = volume - gained
            contact = contact_of(bases[min(i, bases.size - 1)], gained, scheme.flux)
            bed = beds[min(i, beds.size - 1)]
            rest = before / volume if volume > 0.0 else 1.0
            old_load = memory[i, LAST_LOAD]
            if memory[i, IS_KNOWN] == 0.0:  # a new column: only erosion has changed its load
                old_load = weight * rest
                if fractions[i, 0] == 0.0:  # and its solid fraction is not set yet
                    fractions[i, :] = start
            shear[b], load[b], most[b] = rates[i], weight, weight * (1.0 + ratio)
            thickness[b] = max(thicknesses[i], THINNEST)
            prescribed[b] = NOT_PRESCRIBED
            if contact != IMPERMEABLE and contact < INFLOW:
                prescribed[b] = min(max(weight - bed, 0.0), most[b])
            _load(profile, fractions, i, (old_load, weight * rest), eta, scheme, work)
            if gained > 0.0:
                _take_in(work, rest, weight, bed, contact, soil)
            for j in range(levels):
                stress[j, b] = min(max(work[0, j], 0.0), most[b] * eta[j])
                fraction[j, b] = min(max(work[1, j], LOOSEST), DENSEST)
        solve_block(block, step, law, dt)
        describe_base(block, step, law, dilatancy, coefficient)
        for b in range(min(LANES, count - first)):
            i = first + b
            for j in range(levels):
                profile[i, cells - j] = loads[i] * eta[j] - stress[j, b]
                fractions[i, cells - j] = fraction[j, b]
            profile[i, cells] = 0.0
            memory[i, IS_KNOWN], memory[i, LAST_LOAD] = 1.0, loads[i]
            memory[i, DILATANCY], memory[i, COEFFICIENT] = dilatancy[b], coefficient[b]
            memory[i, FLUID] = law.viscosity * (1.0 - fraction[cells, b])
            basal_pressure[i] = profile[i, 0]


@inner
def _load(profile, fractions, i, loads, eta, scheme, work):
    """Write effective stress [Pa] and solid fraction [-] of one column under its new load, from the surface down.

    `profile`, shape (n, levels), has the pressures before [Pa], `fractions` the solid fractions; `loads` are the
    weight of the same grains before and after [Pa]; `eta`, shape (levels,), is the depth over the thickness [-].
    `work`, shape (2, levels), is written.
    """
    cells, (old_load, load) = profile.shape[1] - 1, loads
    scale = load / old_load if scheme.loading == PROPORTIONAL and old_load > 0.0 else 1.0
    gain = load - old_load if scheme.loading == UNLOADED else 0.0
    for j in range(cells + 1):
        work[0, j] = (scale * old_load + gain) * eta[j] - scale * profile[i, cells - j]
        work[1, j] = fractions[i, cells - j]


@inner
def _take_in(work, rest, load, bed, contact, soil):
    """Move the grains of one column to their new levels, and put the soil that came in below them.

    A grain keeps its depth, so that its depth over the thickness shrinks by `rest`, the volume before over the volume
    after. Between levels, stress and solid fraction are cubics without new extremes. In the half cell above the base
    the soil mixes with what is there, except that a base which the bed prescribes has the stress of the soil.

    `work`, shape (2, levels), holds effective stress [Pa] and solid fraction [-], and is changed;
    `load` is the weight of all [Pa]; `bed` is the pressure of the soil [Pa] and `soil` its solid fraction [-].
    """
    cells = work.shape[1] - 1
    # stress of the soil that came in last and first: over a base that is closed it has the pressure of the base
    entry = work[0, cells] + load * (1.0 - rest) if contact == SEALED else load - bed
    entry_before = work[0, cells] if contact == SEALED else rest * entry
    pull, base_stress, base_fraction = 1.0 / rest if rest > 0.0 else 1e300, work[0, cells], work[1, cells]
    # values and their ratios to the depth, for `interpolate`
    old, ratios = np.empty(cells + 1), np.empty(cells + 1)
    for row in range(2):
        for j in range(cells + 1):
            old[j] = work[row, j]
            ratios[j] = old[j] / max(j, 1)
        first = entry_before if row == 0 else soil
        then = entry if row == 0 else soil
        for j in range(cells + 1):
            eta = j / cells
            if eta > rest:
                work[row, j] = first + (eta - rest) / (1.0 - rest) * (then - first)
            elif row == 0:
                work[row, j] = interpolate(old, ratios, cells, min(j * pull, float(cells)))
            else:
                place = min(j * pull, float(cells))
                low = min(int(place), cells - 1)
                value = cubic_between(old, cells, low, place)
                work[row, j] = min(max(value, min(old[low], old[low + 1])), max(old[low], old[low + 1]))
    new = min(1.0, 2.0 * cells * (1.0 - rest))
    work[1, cells] = base_fraction + new * (soil - base_fraction)
    if contact == INFLOW and new < 1.0:  # the ratios of stress to depth mix
        work[0, cells] = (1.0 - new) * (base_stress / rest) + new * entry
