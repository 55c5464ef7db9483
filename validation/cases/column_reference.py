"""Converged excess pore pressure in a column: an independent reference to judge fast schemes against.

With ``xi`` = 0 at the base and 1 at the surface, ``h`` the thickness, ``e`` the erosion rate and ``D`` the
divergence rate (``dh/dt = e - D h``) it solves, as it stands and without any substitution,

    dp/dt + A (e/h) (1 - xi) dp/dxi = (c_v/h^2) d2p/dxi2 + S,    A = 1 ("ale") or 0 ("classical"),

with ``p = 0`` at the surface and, at the base, a prescribed pressure while ``e > 0`` and no flux while
``e = 0``. Space: Legendre-Gauss-Lobatto spectral elements, graded to both ends. Time: Radau IIA of high
order, restarted at every switch with steps that grow geometrically. Nothing is shared with the package.
Everything is dimensionless: ``h(0) = 1``, time in units of ``T_e = h(0) / e_0``, so ``c_v = 1 / Pe``.
``python -m validation.cases.column_reference`` computes every case at two resolutions, prints the worst difference
and writes ``column_reference.npz beside it``.
"""

import time as clock
from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import numpy as np
from numpy.polynomial import legendre
from scipy.special import roots_jacobi

PECLET = np.logspace(-3, 4, 8)
PER_UNIT = 400  # output times per T_e
FILE = Path(__file__).with_suffix(".npz")


@dataclass(frozen=True)
class Case:
    """History of a column.

    Parameters
    ----------
    erosion_rate, divergence_rate : callable
        ``e(t)`` and ``D(t)``, smooth between switches.
    base_pressure : callable
        ``p_b(t, h)``, applied while the column erodes.
    loading : {"none", "overburden", "proportional"}
        Source ``S``: 0, ``-(1 - xi) load_per_thickness D h`` or ``-D p``.
    start : {"cold", "warm", "linear"}
        0, 1, or ``start_base`` at the base falling linearly to 0 at the surface.
    law : {"ale", "classical"}
        With or without the advection by the growth of the column.
    switches : tuple of float
        Times within the run where a rate jumps; the integration is restarted there.
    period : float
        Time scale on which the rates vary between switches (infinite: constant).
    """

    name: str
    erosion_rate: Callable
    divergence_rate: Callable
    base_pressure: Callable
    loading: str = "none"
    load_per_thickness: float = 1.0
    start: str = "cold"
    law: str = "ale"
    switches: tuple = (1.0,)
    duration: float = 5.0
    start_base: float = 0.0
    period: float = np.inf


@dataclass(frozen=True)
class Resolution:
    """Degree and size of the elements, stages and size of the steps."""

    degree: int = 14
    element: float = 2.5  # width of an element over that of the front that passes it
    smallest: float = 5e-3  # smallest element over sqrt(c_v T_e); a fifth of it costs a digit to rounding
    stages: int = 10
    first: float = 1e-5  # first step after a switch
    growth: float = 0.4  # a step over the time since the switch
    passage: float = 1.5  # a step over the time a front takes to pass
    waves: float = 16.0  # steps per period of the rates


FINE, COARSE = Resolution(), Resolution(11, 3.0, 1e-2, 8, 2e-5, 0.4, 2.0, 12.0)


def _lobatto(degree):
    """Nodes, the two ends first, weights and differentiation matrix of Legendre-Gauss-Lobatto on [-1, 1]."""
    x = np.append([-1.0, 1.0], roots_jacobi(degree - 1, 1, 1)[0])
    p = legendre.Legendre.basis(degree)(x)
    d = p[:, None] / p / (x[:, None] - x + np.eye(degree + 1)) - np.eye(degree + 1)
    # the derivative of a constant is 0 to rounding only if the diagonal is minus the rest
    d -= np.diag(d.sum(axis=1))
    return x, 2.0 / (degree * (degree + 1) * p**2), d


def _radau(stages):
    """Nodes and matrix of Radau IIA on [0, 1]."""
    x = np.append(roots_jacobi(stages - 1, 1, 0)[0], 1.0)
    integral = legendre.legval(x, legendre.legint(np.eye(stages), lbnd=-1)).T
    return 0.5 * (x + 1.0), 0.5 * integral @ np.linalg.inv(legendre.legvander(x, stages - 1))


def _breaks(diffusivity, res):
    """Ends of the elements: geometric at both ends, and fine enough for a front that leaves the base."""
    # a front at xi left the base about xi T_e ago, hence its width 2 sqrt(c_v xi)
    smallest, x = res.smallest * min(np.sqrt(diffusivity), 1.0), [0.0]
    while 1.0 - x[-1] > 1.5 * smallest:
        width = min(x[-1], 0.5 * (1.0 - x[-1]), 2.0 * res.element * np.sqrt(diffusivity * x[-1]))
        x.append(x[-1] + max(smallest, width))
    return np.append(x[:-1], 1.0)


class _Column:
    """Spectral elements over ``xi`` and one implicit step of all stages at once."""

    def __init__(self, case, peclet, res):
        self.case, self.diffusivity = case, 1.0 / peclet
        breaks = _breaks(self.diffusivity, res)
        size = np.diff(breaks)[:, None]
        node, weight, derivative = _lobatto(res.degree)
        self.eta = (1.0 - breaks[1:])[:, None] + 0.5 * size * (1.0 - node)
        self.mass = 0.5 * size * weight
        self.stiffness = 2.0 / size[..., None] * (derivative.T * weight @ derivative)
        self.advection = (weight * self.eta)[..., None] * derivative
        self.nodes, self.matrix = _radau(res.stages)

    def step(self, p, h, t, dt, closed):
        """Pressures (elements, nodes, stages) and thicknesses (stages) at the stages of a step."""
        case, a, s = self.case, dt * self.matrix, len(self.nodes)
        t = t + dt * self.nodes
        e, d = (np.array([rate(x) for x in t]) for rate in (case.erosion_rate, case.divergence_rate))
        h = np.linalg.solve(np.eye(s) + a * d, h + a @ e)
        source = -case.load_per_thickness * d * h * (case.loading == "overburden")
        # mass (p_i - p) = sum_j a_ij rate_j, as (element, node, stage; node, stage)
        n, m = self.mass.shape
        unit = np.eye(s) + a * d * (case.loading == "proportional")
        system = np.einsum("nab,ij->naibj", self.mass[..., None] * np.eye(m), unit)
        system += np.einsum("nab,ij->naibj", self.stiffness, a * self.diffusivity / h**2)
        system += np.einsum("nab,ij->naibj", self.advection, a * e / h * (case.law == "ale"))
        right = self.mass[..., None] * (p[..., None] + self.eta[..., None] * (a @ source))
        # the inner nodes of every element are eliminated first, which leaves its two ends (2 s unknowns)
        both = np.concatenate([right.reshape(n, m * s, 1), system.reshape(n, m * s, m * s)], axis=2)
        kept, inner = both[..., : 2 * s + 1], both[..., 2 * s + 1 :]
        inside = np.linalg.solve(inner[:, 2 * s :], kept[:, 2 * s :])
        left = kept[:, : 2 * s] - inner[:, : 2 * s] @ inside
        whole = np.zeros((n * s + s, n * s + s + 1))  # the right side comes first
        for i in range(n):
            whole[i * s : (i + 2) * s, np.r_[0, 1 + i * s : 1 + (i + 2) * s]] += left[i]
        if not closed:
            whole[:s] = np.c_[[case.base_pressure(*x) for x in zip(t, h, strict=True)], np.eye(s, n * s + s)]
        joints = np.zeros((n + 1, s))  # stays 0 at the surface
        joints[:-1] = np.linalg.solve(whole[:-s, 1:-s], whole[:-s, 0]).reshape(n, s)
        edge = np.concatenate([joints[:-1], joints[1:]], axis=1)[..., None]
        body = (inside[..., :1] - inside[..., 1:] @ edge).reshape(n, m - 2, s)
        return np.concatenate([joints[:-1, None], joints[1:, None], body], axis=1), h


def solve(case: Case, peclet: float, times, resolution: Resolution = FINE):
    """Pressure of a column over time, ``peclet`` being ``e_0 h(0) / c_v``.

    Parameters
    ----------
    times : array_like
        Output times [T_e], 1/400 or more after a switch; a time on a switch belongs to what came before it.

    Returns
    -------
    p_base, depth_mean, thickness : ndarray
        Pressure at the base (the prescribed one while eroding), mean over the depth, thickness.
    """
    times = np.asarray(times, dtype=float)
    out, column, h = np.full((3, times.size), np.nan), _Column(case, peclet, resolution), 1.0
    p = {"cold": 0.0, "warm": 1.0, "linear": case.start_base * column.eta}[case.start] + 0.0 * column.eta
    fit = np.linalg.inv(legendre.legvander(2.0 * np.append(0.0, column.nodes) - 1.0, len(column.nodes)))
    limits = [0.0, *(x for x in case.switches if x < times.max()), times.max()]
    tiny = 1e-12  # keeps every stage on its own side of a switch
    for begin, end in pairwise(limits):
        closed, t, last = case.erosion_rate(0.5 * (begin + end)) == 0.0, begin + tiny, end - tiny
        while t < last:
            dt = min(max(resolution.first, resolution.growth * (t - begin)), case.period / resolution.waves)
            if not closed:
                dt = min(dt, max(resolution.first, 2.0 * resolution.passage * np.sqrt((t - begin) / peclet)))
            dt = last - t if last - t < 1.1 * dt else dt  # no sliver is left at the end
            stages, depths = column.step(p, h, t, dt, closed)
            known = np.concatenate([p[..., None], stages], axis=2)
            known = np.stack([known[0, 0], np.einsum("na,nas->s", column.mass, known), np.append(h, depths)])
            asked = (times > t + 2.0 * tiny) & (times <= t + dt + 2.0 * tiny)
            place = 2.0 * (times[asked] - t) / dt - 1.0
            out[:, asked] = known @ fit.T @ legendre.legvander(place, len(column.nodes)).T
            if not closed:
                out[0, asked] = [case.base_pressure(*x) for x in zip(times[asked], out[2, asked], strict=True)]
            p, h, t = stages[..., -1], depths[-1], t + dt
    return tuple(out)


def _on(*spans):
    """1 within the spans and 0 elsewhere."""
    return lambda t: float(any(a < t < b for a, b in spans))


def _cases():
    on, still = _on((0.0, 1.0)), _on()
    cold, line = {"base_pressure": lambda t, h: 1.0}, {"base_pressure": lambda t, h: 0.65 * h, "start": "linear"}
    growing = dict(line, start_base=0.3, loading="overburden")
    yield Case("A_cold", on, still, **cold)
    yield Case("A_warm", on, still, start="warm", **cold)
    yield Case("B_proportional_base", on, still, **growing)
    yield Case("C_varying_rate", lambda t: (1.0 + 0.9 * np.sin(4.0 * np.pi * t)) * on(t), still, **cold,
               duration=3.0, period=0.5)  # fmt: skip
    thrice = _on((0.0, 0.3), (0.5, 0.8), (1.0, 1.3))
    yield Case("D_switches", thrice, still, switches=(0.3, 0.5, 0.8, 1.0, 1.3), duration=2.0, **cold)
    swinging = dict(line, start_base=0.65, switches=(0.5, 1.0), duration=2.0, period=0.25)  # h: exp(-0.16 sin(8 pi t))
    for loading in ("overburden", "proportional", "none"):
        yield Case(f"E_swing_{loading}", _on((0.5, 1.0)), lambda t: 1.28 * np.pi * np.cos(8.0 * np.pi * t),
                   loading=loading, **swinging)  # fmt: skip
    thinning = dict(line, start_base=0.4, switches=(1.0, 2.0), duration=3.0, period=2.0)
    thickening = dict(thinning, start_base=0.3, switches=(1.0,))
    for loading in ("overburden", "proportional"):
        yield Case(f"F_thinning_{loading}", on, _on((1.0, 2.0)), loading=loading, **thinning)
        yield Case(f"G_loading_while_eroding_{loading}", on, lambda t: -0.5 * on(t), loading=loading, **thickening)
    yield Case("H_classical_cold", on, still, law="classical", **cold)
    yield Case("H_classical_proportional_base", on, still, law="classical", **growing)


CASES = {case.name: case for case in _cases()}


def stored_steps(case: Case) -> np.ndarray:
    """Numbers of the stored output times: the first 40 after a switch and every fifth."""
    step = np.arange(1, round(case.duration * PER_UNIT) + 1)
    starts = [round(x * PER_UNIT) for x in (0.0, *case.switches)]
    return step[(step % 5 == 0) | np.any([(step > x) & (step <= x + 40) for x in starts], axis=0)]


def main() -> None:
    """Compute, compare and write."""
    arrays = {"peclet": PECLET}
    for name, case in CASES.items():
        steps = stored_steps(case)
        fine, coarse = (np.array([solve(case, pe, steps / PER_UNIT, x) for pe in PECLET]) for x in (FINE, COARSE))
        print(f"{name} (CPU so far {clock.process_time():.0f} s): Pe, difference in p_base, depth_mean, thickness")
        for pe, worst in zip(PECLET, np.abs(fine - coarse).max(axis=2), strict=True):
            print(f"  {pe:7.0e}" + "".join(f"  {x:.1e}" for x in worst), flush=True)
        arrays |= {f"{name}/steps": steps, f"{name}/thickness": fine[0, 2]}
        arrays |= {f"{name}/p_base": fine[:, 0].T, f"{name}/depth_mean": fine[:, 1].T}
    np.savez_compressed(FILE, **arrays)
    print(f"{FILE}: {FILE.stat().st_size / 1e6:.2f} MB")


if __name__ == "__main__":
    main()
