"""Outflow of the grid: volume by exit node."""

import numpy as np


class Outflow:
    """An account of volume.

    Examples
    --------
    >>> outflow = Outflow()
    >>> outflow.count(np.array([3, 11]), np.array([2.0, 1.0]), np.array([1.0, 0.5]))
    >>> outflow.total, outflow.solid, outflow.by_edge(rows=3, columns=4)["east"]
    (3.0, 1.5, 3.0)
    """

    def __init__(self):
        self._at, self.solid = {}, 0.0  # volume by node, that of the grains [m3]

    def count(self, nodes, volume, solid) -> None:
        """Add volumes [m3], and the volumes of their grains `solid`, to the accounts of exit nodes."""
        for node, part in zip(nodes.tolist(), volume.tolist(), strict=True):
            self._at[node] = self._at.get(node, 0.0) + part
        self.solid += float(np.sum(solid))

    @property
    def total(self) -> float:
        """Total outflow [m3]."""
        return float(sum(self._at.values()))

    def by_edge(self, rows: int, columns: int) -> dict[str, float]:
        """Return the volume that left over each side, or over open nodes inside the grid [m3].

        `rows` and `columns` are the shape of the raster.
        """
        edges = dict.fromkeys(("west", "east", "south", "north", "inside"), 0.0)
        for node, volume in self._at.items():
            r, c = divmod(node, columns)
            sides = {"west": c == 0, "east": c == columns - 1, "south": r == 0, "north": r == rows - 1}
            edges[next((side for side, on in sides.items() if on), "inside")] += volume
        return edges

    def copy(self) -> "Outflow":
        """Return an independent copy."""
        other = Outflow()
        other._at, other.solid = dict(self._at), self.solid
        return other
