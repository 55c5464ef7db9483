"""The pore pressure of the bed itself, which the weight of the flow raises and drainage takes away.

    d(dp)/dt = B dL/dt - dp/T,    L = rho g_n h_n,    dp >= 0

B is the part of a load that pore water takes up at once (Skempton 1954; undrained loading: Hutchinson & Bhandari
1971), T the time in which it drains. Between two calls of `carry` L is taken to change linearly, for which the step is
exact. Soil that is eroded has the pressure ratio r_b = dp / p_liq, at most 1, p_liq being that of the flow on the node.
Only nodes under the flow, or just left by it, are updated; the drainage of all others is made up for later.
"""

from copy import copy
from typing import NamedTuple

import numpy as np

from ..core.jit import kernel
from ..core.structs import struct
from ..spatial.footprints import Footprints, on_nodes
from ..spatial.raster import Raster
from ..spatial.transfer import scatter


@struct
class BedResponse(NamedTuple):
    """Response of the pore pressure of the bed to a load.

    Attributes
    ----------
    loading : float
        B, part of a change of the load that the pore water takes [-].
    drainage_time : float
        T, in which the pressure falls to 1/e by drainage [s]; infinite: no drainage.
    area : float
        Map area of a node [m2].
    """

    loading: float
    drainage_time: float
    area: float


@struct
class NodePressure(NamedTuple):
    """Pore pressure of the bed at the nodes of a raster, changed in place.

    Attributes
    ----------
    pressure : ndarray, shape (nodes,)
        Excess pore pressure [Pa].
    ratio : ndarray, shape (nodes,)
        Pressure over that at which the bed liquefies, r_b [-].
    load : ndarray, shape (nodes,)
        L, load by the flow [Pa].
    age : ndarray, shape (nodes,)
        Time since the start to which each node was brought [s].
    """

    pressure: np.ndarray
    ratio: np.ndarray
    load: np.ndarray
    age: np.ndarray


class BedPressure:
    """Excess pore pressure of the bed over one call.

    Parameters
    ----------
    raster : Raster
        Nodes, their statuses and spacing [m].
    pressure : ndarray, shape (nodes,)
        Excess pore pressure now [Pa], >= 0, changed in place.
    loading : float
        B [-].
    drainage_time : float
        T [s], may be infinite.
    time : float
        Now [s].
    """

    def __init__(self, raster: Raster, pressure, loading: float, drainage_time: float, time: float):
        self._raster, self._pressure, self._start = raster, pressure, time
        self._loading, self._drainage_time = loading, drainage_time
        count = raster.status.size
        self.ratio = np.zeros(count)  # r_b; 0 where there is no flow [-]
        self._load = np.zeros(count)  # [Pa]
        self._age = np.zeros(count)  # time to which `pressure` was brought, since the start [s]
        self._under = np.zeros(0, np.int64)  # nodes with a load
        self._sums, self._scratch = np.zeros((count, 2)), np.empty(count, np.int64)

    def copy(self) -> "BedPressure":
        """Return loads and times of its own for the same array of pressures."""
        other = copy(self)
        other.ratio, other._load, other._age = self.ratio.copy(), self._load.copy(), self._age.copy()
        return other

    def variables(self) -> dict:
        """Return loads and times by name, as dimensions and values, without the pressures, which belong to the grid."""
        return {
            "start": ((), self._start), "ratio": ("node", self.ratio), "load": ("node", self._load),
            "age": ("node", self._age), "under": ("loaded", self._under),
        }  # fmt: skip

    def set_variables(self, variables) -> None:
        """Restore loads and times that `variables` returned, values by name."""
        self._start, self._under = float(variables["start"]), variables["under"]
        self.ratio[:], self._load[:], self._age[:] = (variables[name] for name in ("ratio", "load", "age"))

    def carry(self, footprints: Footprints, force, time: float, dt: float) -> None:
        """Load the bed with the flow at `time`, after a step of `dt` [s].

        Parameters
        ----------
        footprints : Footprints
            Nodes on which each of the n particles lies.
        force : ndarray, shape (n, 2)
            Slope-normal stress on the bed times map area: total, and less hydrostatic pressure [N].
        """
        self._bear(footprints, force, time, dt, self._loading)

    def stand(self, footprints: Footprints, force, time: float) -> None:
        """Note the load on the bed at the start, which raises no pressure.

        `footprints` and `force`, shape (n, 2) [N], are as in `carry`; `time` is in s.
        """
        self._bear(footprints, force, time, 0.0, 0.0)

    def _bear(self, footprints, force, time, dt, loading):
        at = scatter(on_nodes(footprints), force, self._sums, self._scratch).copy()
        response = BedResponse(loading=loading, drainage_time=self._drainage_time, area=self._raster.area)
        nodes = NodePressure(pressure=self._pressure, ratio=self.ratio, load=self._load, age=self._age)
        _respond(self._under, at, self._sums, response, nodes, time - self._start, dt)
        self._under = at

    def drain(self, time: float, nodes: slice) -> None:
        """Bring the pressure of some nodes to `time` [s]."""
        age = time - self._start
        if np.isfinite(self._drainage_time):
            self._pressure[nodes] *= np.exp((self._age[nodes] - age) / self._drainage_time)
            self._age[nodes] = age

    def finish(self, time: float, nodes: slice) -> None:
        """Drain the whole bed to `time` [s] at the end, outside `nodes`, which no flow ever loaded, by one factor."""
        self.drain(time, nodes)
        if np.isfinite(self._drainage_time):
            for others in (slice(0, nodes.start), slice(nodes.stop, None)):
                self._pressure[others] *= np.exp((self._start - time) / self._drainage_time)

    @property
    def draining(self):
        """The arrays that `finish` changes, at nodes that the flow never reached, too."""
        return [self._pressure, self._age]


@kernel
def _respond(left, reached, sums, response, nodes, age, dt):
    """Bring the pore pressure of the bed to the present, and clear the sums.

    Parameters
    ----------
    left, reached : ndarray of int, shape (k,)
        Nodes with flow before the step, of which some may still have it, and nodes with flow now.
    sums : ndarray, shape (nodes, 2)
        Force on the bed, total and less hydrostatic pressure [N]; 0 where there is no flow.
    response : BedResponse
        Response of the bed to a load.
    nodes : NodePressure
        Pore pressure at the nodes, changed in place.
    age, dt : float
        Time since the start, and length of the step that ends now [s].
    """
    loading, drainage_time, area = response
    pressure, ratio, load, ages = nodes
    drained = dt / drainage_time
    kept = np.exp(-drained)
    gained = loading * (-np.expm1(-drained) / drained if drained > 0.0 else 1.0)
    for k in range(left.size + reached.size):
        n = left[k] if k < left.size else reached[k - left.size]
        if k < left.size and sums[n, 0] > 0.0:
            continue
        idle = age - dt - ages[n]  # since its last update the node has had the same load
        if idle > 0.0:
            pressure[n] *= np.exp(-idle / drainage_time)
        new_load, liquefied = sums[n, 0] / area, sums[n, 1] / area
        pressure[n] = max(0.0, pressure[n] * kept + gained * (new_load - load[n]))
        load[n], ages[n] = new_load, age
        ratio[n] = min(1.0, pressure[n] / liquefied) if liquefied > 0.0 else 0.0
        sums[n, 0], sums[n, 1] = 0.0, 0.0
