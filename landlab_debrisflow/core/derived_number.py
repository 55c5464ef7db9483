"""Number that followed from other parameters."""

from collections.abc import Mapping


class DerivedNumber(float):
    """Number that followed from other parameters: a float that keeps them, for output.

    Attributes
    ----------
    parameters : dict of str to float
        Parameters from which the number followed, by name.

    Examples
    --------
    >>> number = DerivedNumber(0.5, {"permeability": 1e-9})
    >>> number, number == 0.5, number.parameters
    (0.5, True, {'permeability': 1e-09})
    """

    parameters: dict[str, float]

    def __new__(cls, value: float, parameters: Mapping[str, float]) -> "DerivedNumber":
        """Make the number."""
        number = super().__new__(cls, value)
        number.parameters = dict(parameters)
        return number

    def __getnewargs__(self):
        return float(self), self.parameters
