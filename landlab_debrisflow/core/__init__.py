"""Tools that all layers share: declared parameters, units, errors, numba's decorators."""
