"""Arguments of `solve_column` for debris that contracts or dilates, and contradictions between these and others."""

from typing import Any

import numpy as np

from .declarations import NUMBERS, SINGLE_NUMBERS
from .history import History, refuse


def refuse_contradictions(given: dict[str, Any], histories: dict[str, History]) -> None:
    """Refuse arguments that need `dilatancy`, or do not go with it.

    Parameters
    ----------
    given : dict
        Arguments of `solve_column` by name; those of `columns.declarations.CHOICES` are checked.
    histories : dict of str to History
        Numbers among them, checked.
    """
    if given["dilatancy"] is None:
        usual = {"shear_rate": NUMBERS, "solid_fraction": NUMBERS}
        usual |= {"soil_solid_fraction": SINGLE_NUMBERS, "solid_density": SINGLE_NUMBERS}
        for name, declared in usual.items():
            if _differs(given[name], declared[name].default):
                refuse(f"{name} needs dilatancy, got {given[name]!r} without it; dilatancy={{}} has its defaults")
        return
    if (coefficient := given["coefficient_of_consolidation"]) is not None:
        refuse(
            f"coefficient_of_consolidation must be left out with dilatancy, got {coefficient!r}: it follows from "
            "permeability and compressibility; give dilatancy={'permeability': ...}"
        )
    if given["law"] != "ale":
        refuse(f"dilatancy needs law='ale', got {given['law']!r}; leave one of the two out")
    if not histories["loading"].value.any():
        refuse("dilatancy needs loading > 0 Pa m-1, got loading=0; give loading=rho' g cos(theta)")
    if _differs(given["porosity_source"], 0.0):
        refuse(
            f"porosity_source must be left out with dilatancy, got {given['porosity_source']!r}: dilatancy makes the "
            "pressure of changes of porosity by itself"
        )
    fractions = histories["solid_fraction"].value
    if given["soil_solid_fraction"] is None and np.ptp(fractions) > 0.0 and _differs(given["entrainment_rate"], 0.0):
        refuse(
            f"soil_solid_fraction must be given where columns of different solid_fraction erode, got {fractions}; "
            "entrainment_rate=0.0 has no erosion"
        )


def _differs(value, usual) -> bool:
    """Return whether an argument is something else than its default."""
    return callable(value) or (value is not None and bool(np.any(np.not_equal(value, usual))))
