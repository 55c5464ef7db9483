"""Every parameter at its bounds: a short run ends with numbers, in balance, or is refused in words."""

import dataclasses
import math

import numpy as np
import pytest

from landlab_debrisflow import DebrisFlow
from landlab_debrisflow.core.values import flat_keys_of
from landlab_debrisflow.model.numerics import Numerics
from landlab_debrisflow.physics.material import Material
from landlab_debrisflow.physics.registry import LAWS
from validation.grids import inclined, release_slab
from validation.watch import FINITE

pytestmark = pytest.mark.slow

INFINITE = 1e6
"""Stands for a bound that is infinite: far beyond any use, as a length, rate, angle or number."""

TOO_FINE = {"particle_count": 3000, "particle_spacing": 0.3}
"""Bounds that only memory limits: the number of particles without an upper one, the spacing of 1e-6 m."""

SHORT = {"courant_number": 1e-5, "advective_courant_number": 0.02, "gravity": 0.5}
"""Duration where a bound makes steps tiny or falls fast [s]; elsewhere 2 s."""


REFUSED = {
    "solid_density": 1.0, "water_density": 1e5, "stiffness": 0.0,
    "static_friction_angle": 89.0, "limiting_friction_angle": 0.0,
}  # fmt: skip
"""Bounds that do not go with other defaults: grains must be heavier than water, a drag needs its stiffness, and the
friction of the inertial law rises."""


def bounds():
    """Yield keyword, law, parameter and value for all bounds, choices and switches that are declared."""
    laws = [("numerics", None, Numerics), ("material", None, Material)]
    laws += [(kind, name, law) for kind, known in LAWS.items() for name, law in known.items()]
    for keyword, name, law in laws:
        for key, field in flat_keys_of(law).items():
            meta = field.metadata
            if dataclasses.is_dataclass(meta["kind"]):  # its parameters follow, with a dot in their keys
                continue
            if meta["kind"] is bool:
                values = (False, True)
            elif meta["choices"]:
                values = meta["choices"]
            else:
                values = [meta["kind"](b if math.isfinite(b) else INFINITE) for b in meta["bounds"]]
            for value in values:
                if field.name in TOO_FINE and value in (INFINITE, 1e-6) and not (
                    field.name == "particle_spacing" and value == INFINITE
                ):  # fmt: skip
                    value = TOO_FINE[field.name]
                yield pytest.param(keyword, name, key, value, id=f"{name or keyword}-{key}-{value}")


@pytest.mark.parametrize(("keyword", "law", "parameter", "value"), list(bounds()))
def test_at_its_bound(keyword, law, parameter, value):
    grid = inclined((20, 60), 5.0, 0.5, soil=1.0, foot=150.0)
    release_slab(grid, (30.0, 48.0), 8.0, 1.0)
    outer, _, inner = parameter.partition(".")
    values = {outer: {inner: value} if inner else value} | ({"law": law} if law else {})
    keywords = {"numerics": {"particle_count": 60}, keyword: values}
    if keyword == "numerics" and not parameter.startswith("particle"):
        keywords["numerics"] = {"particle_count": 60, **values}
    if keyword == "numerics" and parameter in ("tolerance", "hold"):  # of a number that is to be found
        keywords["numerics"] = {"particle_count": "auto", **values}
        assert DebrisFlow(grid, **keywords).setup.numerics.automatic
        return
    if parameter in REFUSED and REFUSED[parameter] == value:  # not with the default of another: said in words
        with pytest.raises(ValueError, match=parameter):
            DebrisFlow(grid, **keywords)
        return
    flow = DebrisFlow(grid, **keywords)
    flow.run_one_step(SHORT.get(parameter, 2.0))  # the balance is checked in every call (conftest)
    p = flow.particles
    assert [name for name in FINITE if not np.isfinite(p[name].values).all()] == []
    undefined = [n for n in grid.at_node if not np.isfinite(grid.at_node[n]).all()]
    # without consolidation the Péclet number of what erodes is infinite
    expected = parameter in ("coefficient_of_consolidation", "dilatancy.permeability") and value == 0.0
    assert all(expected and name.endswith("basal_peclet_number") for name in undefined)
    # the fall from the top of the release, and twice the celerity of what is 1 m deep
    gravity = value if parameter == "gravity" else 9.81
    most = math.sqrt(2.0 * gravity * 75.0) + 2.0 * math.sqrt(gravity * 1.12)
    assert grid.at_node["debris_flow__max_speed"].max() < most
