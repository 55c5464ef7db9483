"""Times of erosion and consolidation of a column, and their ratio, the basal Péclet number."""

import numpy as np


def consolidation_time(thickness, coefficient_of_consolidation):
    """Return ``T_c = h^2 / c_v`` [s] (Pastor et al., 2022, section 3).

    Parameters
    ----------
    thickness : array_like
        Slope-normal [m].
    coefficient_of_consolidation : array_like
        [m2 s-1]; 0 gives inf.

    Examples
    --------
    >>> float(consolidation_time(2.0, 4e-4)), float(consolidation_time(2.0, 0.0))
    (10000.0, inf)
    """
    return _over(np.square(thickness, dtype=float), coefficient_of_consolidation)


def erosion_time(thickness, entrainment_rate):
    """Return ``T_e = h / e_R`` [s], in which erosion alone would double the column.

    Parameters
    ----------
    thickness : array_like
        Slope-normal [m].
    entrainment_rate : array_like
        Slope-normal [m s-1]; 0 gives inf.

    Examples
    --------
    >>> float(erosion_time(2.0, 0.05)), float(erosion_time(2.0, 0.0))
    (40.0, inf)
    """
    return _over(thickness, entrainment_rate)


def basal_peclet_number(entrainment_rate, thickness, coefficient_of_consolidation):
    """Return ``Pe_b = T_c / T_e = e_R h / c_v`` [-], with the present thickness.

    Parameters
    ----------
    entrainment_rate : array_like
        Slope-normal [m s-1]; without erosion the number is 0, even if nothing consolidates.
    thickness : array_like
        Slope-normal [m].
    coefficient_of_consolidation : array_like
        [m2 s-1]; 0 gives inf while the column erodes.

    Examples
    --------
    >>> basal_peclet_number([0.05, 0.0, 0.05], 3.2, [4e-4, 0.0, 0.0])
    array([400.,   0.,  inf])
    """
    return _over(np.multiply(entrainment_rate, thickness, dtype=float), coefficient_of_consolidation, 0.0)


def _over(numerator, denominator, nothing_over_nothing=np.inf):
    numerator, denominator = np.broadcast_arrays(numerator, denominator)
    undefined = np.where(numerator > 0.0, np.inf, nothing_over_nothing)
    return np.divide(numerator, denominator, out=undefined, where=denominator > 0.0)
