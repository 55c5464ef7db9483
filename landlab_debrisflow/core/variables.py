"""Declaration of a particle variable, from which arrays, output and files follow."""

from typing import NamedTuple


class Variable(NamedTuple):
    """Variable of particles: one number per particle, some components of it, or one per level of its column.

    Attributes
    ----------
    name : str
        Attribute of the particles.
    unit : str
        Unit as Landlab writes it, such as "m s-1".
    long_name : str
        Meaning in a few words.
    dtype : type
        Type of one number.
    initial : float
        Value of a new particle [unit].
    written : bool
        Whether it appears in output.
    scratch : bool
        Whether every step that needs it finds it anew.
    per_level : bool
        Whether there is one number per level of the column: shape (n, levels).
    components : int
        Components of a vector: shape (components, n); 0: no vector.
    width : int or None
        Numbers side by side: shape (n, width); None: one number, shape (n,).

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
    written: bool = True
    scratch: bool = False
    per_level: bool = False
    components: int = 0
    width: int | None = None

    def shape(self, count: int, levels: int) -> tuple[int, ...]:
        """Return the shape of the array of all particles.

        Parameters
        ----------
        count : int
            Number of particles.
        levels : int
            Number of levels of a column.

        Returns
        -------
        tuple of int
        """
        if self.components:
            return self.components, count
        width = levels if self.per_level else self.width
        return (count,) if width is None else (count, width)

    @property
    def axis(self) -> int:
        """Axis of the array along which particles are counted: 1 for a vector, else 0."""
        return 1 if self.components else 0
