"""Keys of an ensemble in a scene file."""

from typing import Any, ClassVar

from ..core.errors import ParameterError
from ..core.parameters import declared, parameter
from .output_keys import MAPS

SAMPLINGS = ("latin_hypercube", "random", "sobol", "saltelli", "factorial")
"""Methods by which the members of an ensemble are drawn."""
KEPT_MAPS = ("max_depth", "max_speed", "max_impact_pressure", "arrival_time", "deposit_depth", "eroded_depth")
"""Maps of a member that are kept by default."""
SCALES = ("none", "swiss")
"""Scales of hazard classes by name."""
FIDELITIES = ("scene", "auto")
"""Where number of particles, column and steps of the members come from."""


@declared
class EnsembleKeys:
    """Many runs of a scene: values that vary, their distributions, and the members drawn from these."""

    keyword: ClassVar = "ensemble"

    vary: Any = parameter(
        "-", "distributions by the dotted name of a value: friction.basal_friction_angle: {normal: {mean: 28, sd: 2}}",
        None, kind=dict,
    )  # fmt: skip
    table: str | None = parameter(
        "-", "file (CSV) of the members instead of distributions, with a column for each dotted name", None, kind=str,
        file=True,
    )  # fmt: skip
    members: int | None = parameter(
        "-", "number of runs; by default 256, of factorial and of a table all", None, (1, 1_000_000), kind=int
    )
    sampling: str = parameter("-", "how members are drawn", SAMPLINGS[0], choices=SAMPLINGS)
    seed: int = parameter("-", "equal seeds give equal members", 0, (0, 2**63 - 1), kind=int)
    replicates: int | None = parameter(
        "-", "independent samples of which latin_hypercube and sobol consist, by whose scatter the sampling error is "
        "told; by default 8", None, (1, None), kind=int,
    )  # fmt: skip
    correlation: Any = parameter("-", "rank correlations of pairs of values: {first: {second: 0.5}}", None, kind=dict)
    fidelity: str = parameter(
        "-", "particles, column and steps: of the scene, or found by pilot runs of some members", FIDELITIES[0],
        choices=FIDELITIES,
    )  # fmt: skip
    maps: Any = parameter("-", "maps of the members that are kept", KEPT_MAPS, kind=tuple, choices=MAPS)
    thresholds: Any = parameter(
        "-", "thresholds of the hazard maps by map, in its unit: {max_depth: [0.5, 1, 2]}; by default three of each "
        "kept map", None, kind=dict,
    )  # fmt: skip
    quantiles: Any = parameter("-", "quantiles of the hazard maps; by default 0.05, 0.5 and 0.95", None, kind=tuple)
    hazard_scale: str = parameter("-", "hazard classes whose probabilities are wanted", SCALES[0], choices=SCALES)
    batch: int = parameter("-", "members that are computed and written together", 8, (1, 10_000), kind=int)
    directory: str | None = parameter(
        "-", "directory of the results, by default the name of the scene with _ensemble", None, kind=str, file=True
    )

    def _agree(self):
        if not self.maps:
            raise ParameterError(f"ensemble: maps is empty; name at least one of {', '.join(MAPS)}")
        if self.table is not None and self.members is not None:
            raise ParameterError("ensemble: a table has its own members; leave members out")
