"""Scores of S-1000: measures, the noise of each, and quoted scores of other models."""

import numpy as np

CHANGED = 0.2
"""Least change of elevation that counts [m]."""

MEASURES = {
    "released": ("released [m3]", "{:.0f}"),
    "eroded": ("eroded, all passes [m3]", "{:.0f}"),
    "eroded outside": ("  of it outside the source [m3]", "{:.0f}"),
    "lowered outside": ("lowered outside the source [m3]", "{:.0f}"),
    "raised": ("raised [m3]", "{:.0f}"),
    "net": ("net change [m3]", "{:.0f}"),
    "in scar": ("left in the scar [m3]", "{:.0f}"),
    "outflow": ("left the grid [m3]", "{:.0f}"),
    "residual": ("residual of the balance [m3]", "{:.1e}"),
    "run-out": ("run-out along the path [m]", "{:.0f}"),
    "run-out error": ("run-out error [m]", "{:+.0f}"),
    "csi": ("CSI, |dz| > 0.2 m", "{:.3f}"),
    "csi outside": ("CSI outside the source", "{:.3f}"),
    "csi 0.5": ("CSI, |dz| > 0.5 m", "{:.3f}"),
    "csi 0.5 outside": ("CSI outside, |dz| > 0.5 m", "{:.3f}"),
    "csi erosion": ("CSI of erosion", "{:.3f}"),
    "csi deposition": ("CSI of deposition", "{:.3f}"),
    "correlation": ("correlation of dz outside", "{:+.2f}"),
    "duration": ("duration of the event [s]", "{:.0f}"),
    "cpu": ("CPU time, warm [s]", "{:.1f}"),
    "memory": ("peak memory so far [MB]", "{:.0f}"),
}
"""Words and format of each measure."""

NOISE = {
    **dict.fromkeys(("csi", "csi outside", "csi 0.5", "csi 0.5 outside"), "±.02"),
    **dict.fromkeys(("csi erosion", "csi deposition", "correlation"), "±.02"),
    **dict.fromkeys(("eroded", "eroded outside", "lowered outside"), "±10 %"),
    **dict.fromkeys(("run-out", "run-out error"), "±15"),
}
"""Differences that are not significant: spread between runs that differ in the discretisation only."""

QUOTED = {
    '"Mass- Wasting- Runout"': {
        "lowered outside": 4652.0, "run-out error": -38.0, "csi": 0.510, "csi outside": 0.461, "csi 0.5": 0.470,
        "csi erosion": 0.46, "csi deposition": 0.34, "correlation": 0.39, "cpu": "1.4-1.9",
    },
    '"prototype, Coulomb"': {
        "lowered outside": "5150-20300", "run-out error": 100.0, "csi": 0.33, "csi outside": ".26-.29",
        "correlation": "-.16-+.19", "cpu": "3",
    },
    '"prototype, Voellmy"': {
        "lowered outside": "4500-6700", "run-out error": -38.0, "csi": ".46-.47", "csi outside": ".41-.42",
        "correlation": "+.57-+.60",
    },
}  # fmt: skip
"""Quoted, not rerun."""


class ObservedPath:
    """The observed path in plan: mean column of the changed cells of every row, smoothed, from the crown down.

    The event runs southwards without turning back, so rows order it. Below the last changed row the
    path goes on straight, in the direction of its last 100 m.

    Parameters
    ----------
    observed : xarray.DataArray
        Change of elevation over ``y`` and ``x`` [m].
    """

    def __init__(self, observed):
        changed = abs(observed.values) > CHANGED
        x, y = observed.x.values, observed.y.values
        rows = np.flatnonzero(changed.any(axis=1))[::-1]
        centre = np.array([x[changed[row]].mean() for row in rows])
        every = np.arange(rows[0], rows[-1] - 1, -1)
        centre = np.interp(-every, -rows, centre)
        centre = np.convolve(np.pad(centre, 2, mode="edge"), np.full(5, 0.2), mode="valid")
        end = np.array([centre[-1], y[every[-1]]])
        ahead = end - np.array([centre[-11], y[every[-11]]])
        points = np.column_stack([centre, y[every]])
        self.points = np.vstack([points, end + np.arange(1, 31)[:, None] * ahead / 10.0])
        self.distance = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(self.points, axis=0).T))])
        self._x, self._y = np.meshgrid(x, y)

    def run_out(self, change) -> float:
        """Return how far along the path the farthest changed cell projects [m]; 0 if nothing changed."""
        changed = abs(change) > CHANGED
        away_x = self._x[changed][:, None] - self.points[:, 0]
        away_y = self._y[changed][:, None] - self.points[:, 1]
        nearest = np.argmin(np.hypot(away_x, away_y), axis=1)
        return float(self.distance[nearest].max()) if nearest.size else 0.0


def measure(change, observed, release, path) -> dict[str, float]:
    """Return the measures of a change of elevation, shape (rows, columns) [m], against the observed one.

    `observed` and `release` are maps over ``y`` and ``x`` [m], `path` is the ObservedPath.
    """
    cell = float(observed.x[1] - observed.x[0]) * float(observed.y[1] - observed.y[0])
    seen, inside = observed.values, release.values > 0.0
    outside = ~inside
    released = float(release.sum()) * cell
    scores = {}
    for limit, words in ((0.2, "csi"), (0.5, "csi 0.5")):
        scores[words] = success(abs(change) > limit, abs(seen) > limit)
        scores[f"{words} outside"] = success((abs(change) > limit) & outside, (abs(seen) > limit) & outside)
    either = ((abs(change) > CHANGED) | (abs(seen) > CHANGED)) & outside
    return scores | {
        "released": released,
        "lowered outside": float(np.maximum(-change, 0.0)[outside].sum()) * cell,
        "raised": float(np.maximum(change, 0.0).sum()) * cell,
        "net": round(float(change.sum()) * cell) + 0,  # the balance itself has a row of its own
        "in scar": float(change[inside].sum()) * cell + released,
        "run-out": path.run_out(change),
        "run-out error": path.run_out(change) - path.run_out(seen),
        "csi erosion": success(change < -CHANGED, seen < -CHANGED),
        "csi deposition": success(change > CHANGED, seen > CHANGED),
        "correlation": float(np.corrcoef(change[either], seen[either])[0, 1]),
        "too deep": int(np.sum(seen[outside] < -1.2)),
    }


def success(modelled, observed) -> float:
    """Return the critical success index of two maps of yes and no."""
    return float(np.sum(modelled & observed) / max(1, np.sum(modelled | observed)))


def dig_and_spread(observed, release, path):
    """Return the change if the source were spread evenly along the observed path, three cells wide [m].

    This needs no model: the score of a model must be better, above all outside the source.

    Parameters
    ----------
    observed, release : xarray.DataArray
        Change of elevation and thickness released over ``y`` and ``x`` [m].
    path : ObservedPath
        Where to spread it.
    """
    end = path.distance <= path.run_out(observed.values)
    column = np.rint((path.points[end, 0] - float(observed.x[0])) / float(observed.x[1] - observed.x[0])).astype(int)
    row = np.rint((path.points[end, 1] - float(observed.y[0])) / float(observed.y[1] - observed.y[0])).astype(int)
    on_path = np.zeros(observed.shape, bool)
    for side in (-1, 0, 1):
        on_path[row, column + side] = True
    return np.where(on_path, release.values.sum() / on_path.sum(), 0.0) - release.values
