"""Cases of two phases in one dimension: exact, or to be compared with a converged reference.

``case.run(count, times)`` runs one by `rivals.finite_volume_two_phase`; at time 0 it gives the start for another
scheme. In each the speeds of the equations stay real (`is_hyperbolic`), so that there is a limit to converge to.
``python -m validation.cases.two_phase`` prints errors and costs of finite volumes.
"""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial

import numpy as np

from landlab_debrisflow.exact import flows
from validation.rivals.finite_volume_two_phase import NO_DRAG, Mixture, TwoPhaseResult, solve

COUNTS = (250, 500, 1000, 2000, 4000)
REFERENCE = 8000
THICK = 1e-3  # phases thinner than this are not asked for their speeds [m]


def dam_break(count: int, times, depth: float = 1.0, ahead: float = 0.0, porosity: float = 0.4,
              porosity_ahead: float | None = None, half_width: float | None = None, mixture: Mixture = NO_DRAG,
              slope: float = 0.0, v_s: float = 0.0, v_w: float = 0.0) -> TwoPhaseResult:  # fmt: skip
    """Dam at x = 0, or a parabolic cap around it, in a domain whose ends the flow does not reach.

    Parameters
    ----------
    count : int
        Cells; a multiple of 10 puts the dam between two of them.
    times : array_like
        When to record, ascending [s].
    depth, porosity, v_s, v_w : float
        Of the reservoir, at x < 0, or of the top of the cap [m, -, m/s, m/s].
    ahead, porosity_ahead : float
        Of the layer at rest at x > 0 [m, -]; by default dry, and of the same porosity.
    half_width : float, optional
        Of a cap ``depth (1 - (x/half_width)^2)`` instead of a dam [m].
    slope : float
        Of the plane, down x; not negative [rad].
    """
    if porosity_ahead is None:
        porosity_ahead = porosity
    last, wide = np.max(times), 0.0 if half_width is None else half_width
    celerity = math.sqrt(flows.GRAVITY * math.cos(slope) * depth)
    drift = 0.5 * flows.GRAVITY * math.sin(slope) * last**2
    fastest, slowest = max(v_s, v_w, 0.0), min(v_s, v_w, 0.0)
    front = wide + (2.0 * celerity + fastest) * last + drift
    back = wide + ((2.0 if wide else 1.0) * celerity - slowest) * last
    share = min(9, math.ceil(10.0 * back / (back + front))) / 10.0
    length = 1.05 * max(back / share, front / (1.0 - share))
    faces = length * (np.arange(count + 1) / count - share)
    x = 0.5 * (faces[1:] + faces[:-1])
    if half_width is None:
        h, n = np.where(x < 0.0, depth, ahead), np.where(x < 0.0, porosity, porosity_ahead)
    else:
        clipped = np.clip(faces, -half_width, half_width)
        # means over cells, so that volume is the same for all sizes of them
        h = depth * np.diff(clipped - clipped**3 / (3.0 * half_width**2)) * count / length
        n = np.full(count, porosity)
    moves = (x < 0.0) | (half_width is not None)
    return solve(x, (1.0 - n) * h, n * h, v_s * moves, v_w * moves, times, mixture, slope)


def hump(count: int, times, mixture: Mixture = NO_DRAG, porosity: float = 0.4, rise: float = 0.2,
         width: float = 2.0, half_length: float = 15.0) -> TwoPhaseResult:  # fmt: skip
    """A level layer of 1 m at rest, with a smooth hump ``rise exp(-(x/width)^2)`` of porosity: no kink, no shock.

    The hump is 4 % of the volume of solid that errors are relative to.
    """
    x = half_length * ((2.0 * np.arange(count) + 1.0) / count - 1.0)
    n = porosity + rise * np.exp(-((x / width) ** 2))
    return solve(x, 1.0 - n, n, 0.0, 0.0, times, mixture)


@dataclass(frozen=True)
class Case:
    """``run(count, times)``, time of comparison [s], and depth and velocity ``(x, time)`` where both are exact.

    Exact ones are those of one phase, of porosity 0.4.
    """

    run: Callable
    time: float
    mixture: Mixture
    slope: float = 0.0
    exact: Callable | None = None


@dataclass(frozen=True)
class Row:
    """Relative L1 errors of h_s, h_w, h_s v_s and h_w v_w on a number of cells, and what they cost."""

    cells: int
    steps: int
    cpu: float
    errors: tuple
    slip: float
    complex_share: float


def _dam(time, mixture, exact_solution=None, **keywords):
    run = partial(dam_break, mixture=mixture, **keywords)
    return Case(run, time, mixture, keywords.get("slope", 0.0), exact_solution)


def _cases():
    r20, r22, r25, r30 = (math.radians(a) for a in (20.0, 22.0, 25.0, 30.0))
    loose, tight = Mixture("anderson_jackson", terminal_velocity=5.0), Mixture("darcy", conductivity=1e-7)
    sliding = Mixture("darcy", conductivity=0.1, friction_angle=r25)
    rubbing = Mixture("darcy", conductivity=1e-7, friction_angle=r25)
    falling = partial(flows.mangeney, slope=r22, friction=rubbing.apparent_friction(0.4))
    mixing = Mixture("anderson_jackson", terminal_velocity=2.0)
    settling = Mixture("darcy", conductivity=1e-3, friction_angle=r30)
    return {
        "dry": _dam(2.0, loose, flows.ritter),
        "wet": _dam(2.0, loose, partial(flows.stoker, depth_ahead=0.5), ahead=0.5),
        "tight": _dam(2.0, tight, flows.ritter),
        "tight_friction": _dam(2.0, rubbing, falling, slope=r22),
        "hump": Case(partial(hump, mixture=loose), 2.0, loose),
        "porosity_dam": _dam(2.0, mixing, ahead=0.5, porosity_ahead=0.6),
        "cap": _dam(2.0, sliding, half_width=5.0, slope=r20),
        "collapse": _dam(2.0, settling, half_width=3.0, depth=1.5),
    }


CASES = _cases()


def is_hyperbolic(h_s, h_w, v_s, v_w, ratio: float, gravity: float) -> np.ndarray:
    """Whether all four speeds c of the equations are real, where both phases are; ``ratio`` is rho_w/rho_s.

    They are the roots of ``((c - v_s)^2 - A)((c - v_w)^2 - B) - C`` with A = g (h_s + (1 - ratio) h_w/2), B = g h_w
    and C = g^2 h_s h_w (1 + ratio)/2. It is negative at v_s +- A^(1/2) and v_w +- B^(1/2), and midway between the
    velocities it is (d^2 - a^2)(d^2 - b^2) of half their difference d and the celerities a < b: not negative unless
    a < d < b, so that all are real there.
    """
    h_s, h_w, v_s, v_w = np.broadcast_arrays(h_s, h_w, v_s, v_w)
    h, matrix = h_s + h_w, np.zeros((*h_s.shape, 4, 4))  # of h_s, h_w, v_s, v_w
    for k, (depth, velocity) in enumerate(((h_s, v_s), (h_w, v_w))):
        matrix[..., k, k] = matrix[..., 2 + k, 2 + k] = velocity
        matrix[..., k, 2 + k] = depth
    matrix[..., 2, 0] = gravity * (0.5 * (1.0 - ratio) * (h + h_s) / h_s + ratio)
    matrix[..., 2, 1] = gravity * 0.5 * (1.0 + ratio)
    matrix[..., 3, :2] = gravity
    # a double speed is known to the root of rounding
    return abs(np.linalg.eigvals(matrix).imag).max(axis=-1) < 1e-6 * np.sqrt(gravity * h)


def slip_and_complex(found: TwoPhaseResult, mixture: Mixture, slope: float = 0.0) -> tuple[float, float]:
    """Greatest |v_w - v_s| over twice the slower celerity, and share of the cells whose speeds are not all real."""
    both = (found.h_s > THICK) & (found.h_w > THICK)
    ratio, gravity = mixture.water_density / mixture.solid_density, flows.GRAVITY * math.cos(slope)
    h_s, h_w, v_s, v_w = (a[both] for a in (found.h_s, found.h_w, found.v_s, found.v_w))
    slip = abs(v_w - v_s) / (2.0 * np.sqrt(0.5 * (1.0 - ratio) * gravity * h_w))
    return float(slip.max()), float(1.0 - is_hyperbolic(h_s, h_w, v_s, v_w, ratio, gravity).mean())


def _conserved(found):
    return found.h_s[-1], found.h_w[-1], (found.h_s * found.v_s)[-1], (found.h_w * found.v_w)[-1]


def errors(case: Case, found: TwoPhaseResult, reference: TwoPhaseResult | None = None) -> tuple:
    """Relative L1 errors of h_s, h_w, h_s v_s, h_w v_w at the last time.

    Against the exact solution at the centres, or the means of ``reference`` over the cells, its number of which is a
    multiple.
    """
    if case.exact is not None:
        h, u = case.exact(found.x, case.time)
        truth = 0.6 * h, 0.4 * h, 0.6 * h * u, 0.4 * h * u
    else:
        truth = (a.reshape(found.x.size, -1).mean(axis=1) for a in _conserved(reference))
    return tuple(float(abs(a - b).sum() / abs(b).sum()) for a, b in zip(_conserved(found), truth, strict=True))


def convergence(case: Case, counts=COUNTS, count: int = REFERENCE) -> Iterator[Row]:
    """One row for each number of cells; ``count`` of them in the reference."""
    times = case.time * np.linspace(0.05, 1.0, 20)
    reference = None if case.exact else case.run(count, times)
    case.run(counts[0], times)  # loads or compiles
    for cells in counts:
        found = case.run(cells, times)
        yield Row(cells, found.steps, found.cpu, errors(case, found, reference),
                  *slip_and_complex(found, case.mixture, case.slope))  # fmt: skip


def main() -> None:
    """Print errors and costs of finite volumes on all cases."""
    print(f"relative L1 errors at the last time, against the exact solution or {REFERENCE} cells; order: from the line")
    print("above; slip: greatest |v_w - v_s| over twice the slower celerity, and share of cells with complex speeds")
    names = ("h_s", "h_w", "h_s v_s", "h_w v_w")
    print(f"{'case':16s}{'cells':>6s}{'steps':>6s}{'CPU s':>8s}" + "".join(f"{n:>9s}" for n in names) + "  order" +
          " " * 19 + "slip  complex")  # fmt: skip
    for name, case in CASES.items():
        last = None
        for row in convergence(case):
            text = f"{name:16s}{row.cells:6d}{row.steps:6d}{row.cpu:8.2g}" + "".join(f"{e:9.1e}" for e in row.errors)
            orders = (math.log2(a / b) for a, b in zip(last, row.errors, strict=True)) if last else ()
            text += "".join(f"{order:6.2f}" for order in orders).ljust(24)
            print(text + f"{row.slip:8.3f}{row.complex_share:8.4f}", flush=True)
            last = row.errors


if __name__ == "__main__":
    main()
