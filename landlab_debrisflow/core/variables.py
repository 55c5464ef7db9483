"""Declaration of a particle variable, from which arrays, output and files follow."""

from typing import NamedTuple


class Variable(NamedTuple):
    """One number per particle, some components of it, or one per level of its column.

    Examples
    --------
    >>> Variable("rate", "m s-1", "erosion rate").shape(5, levels=11)
    (5,)
    >>> Variable("velocity", "m s-1", "velocity", components=3).shape(5, levels=11)
    (3, 5)
    """

    name: str
    unit: str
    long_name: str
    dtype: type = float
    initial: float = 0.0
    written: bool = True  # appears in output
    scratch: bool = False  # found anew by every step that needs it
    per_level: bool = False
    components: int = 0  # of a vector, (components, n)
    width: int | None = None  # numbers side by side, (n, width)

    def shape(self, count: int, levels: int) -> tuple[int, ...]:
        """Return the shape of the array of some particles with columns of some levels."""
        if self.components:
            return self.components, count
        width = levels if self.per_level else self.width
        return (count,) if width is None else (count, width)

    @property
    def axis(self) -> int:
        """Axis of the array along which particles are counted."""
        return 1 if self.components else 0
