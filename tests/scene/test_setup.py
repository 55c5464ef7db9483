"""A setup is a value: by way of plain mappings, YAML, files and other processes it stays equal, and no other is."""

import dataclasses
import os
import pickle
import subprocess
import sys
from collections.abc import Mapping

import numpy as np
import pytest
import xarray as xr
import yaml

from landlab_debrisflow import DebrisFlow, Hydrograph, Material, Numerics, ParameterError, Setup
from landlab_debrisflow.physics.friction import Coulomb, Voellmy
from landlab_debrisflow.physics.registry import LAWS
from tests.record.test_files_read_back import CASES, NODES, OUTSIDE, given, run, scene, written_and_read

SURGES = [
    {
        "line_start": [20.0, 20.0], "line_end": [20.0, 40.0], "times": [0.0, 0.1, 9.0], "discharge": [0.0, 40.0, 0.0],
        "velocity": velocity, "pressure_ratio": ratio,
    }
    for velocity, ratio in ((4.0, None), ([4.0, 5.0, 6.0], [0.5, 0.6, 0.7]))
]  # fmt: skip
ALL_IN_IT = {
    "flow": {"law": "two_phase", "drag": "anderson_jackson", "hydraulic_conductivity": 1e-17 + 1e-3},
    "friction": {"law": "voellmy", "basal_friction_angle": "some__angle", "cohesion": np.linspace(0.1, 0.3, 7)},
    "erosion": {"law": "shear_excess", "erosion_rate": 0.1 + 0.2},
    "column": {"law": "classical", "levels": 21, "tolerance": 1e-5},
    "material": {"porosity": 1.0 / 3.0, "bed_porosity": 0.5, "initial_pressure_profile": "uniform"},
    "numerics": {"particle_count": 123, "settle": False, "rest_energy": 1e-300},
    "inflow": SURGES,
}


def is_plain(value):
    if isinstance(value, Mapping):
        return all(type(key) is str and is_plain(one) for key, one in value.items())
    return all(map(is_plain, value)) if type(value) is list else type(value) in (int, float, str, bool)


def by_yaml(mapping):
    return yaml.safe_load(yaml.safe_dump(mapping))


DERIVED = {"permeability": 5e-9 / 3.0, "pore_fluid_viscosity": 0.005, "stiffness": 1.0 / 2e-6}


@pytest.mark.parametrize(
    "keywords", [{}, ALL_IN_IT, {"material": {"coefficient_of_consolidation": DERIVED}}],
    ids=["defaults", "everything", "derived"],
)  # fmt: skip
def test_it_comes_back_from_plain_values_and_from_yaml(keywords):
    setup = Setup(**keywords)
    mapping = setup.to_mapping()
    assert is_plain(mapping)
    for again in (mapping, by_yaml(mapping), vars(setup)):
        other = Setup.from_mapping(again)
        assert other == setup and hash(other) == hash(setup) and other.digest() == setup.digest()
        assert other.to_mapping() == mapping


@pytest.mark.parametrize(("kind", "name", "form"), CASES)
def test_every_law_in_every_form_comes_back_from_yaml(kind, name, form):
    setup = Setup(**{kind: {"law": name} | given(LAWS[kind][name], form)})
    again = Setup.from_mapping(by_yaml(setup.to_mapping()))
    assert again == setup and again.digest() == setup.digest()
    assert (getattr(again, kind) == LAWS[kind][name]()) == (setup == Setup(**{kind: name}))


@pytest.mark.slow
@pytest.mark.parametrize(("kind", "name", "form"), CASES)
def test_every_law_in_every_form_comes_back_from_files(kind, name, form, tmp_path):
    """Also what is given at nodes that the grid has closed."""
    grid, values = scene(), given(LAWS[kind][name], form)
    if form == "field":
        for key, array in given(LAWS[kind][name], "array").items():
            grid.add_field(f"some__{key}", array, at="node")
    flow, snapshots = run(grid, **{kind: {"law": name} | values}, inflow=SURGES)
    read = written_and_read(flow, snapshots, tmp_path)
    for what in ("maps", "snapshots"):
        setup = Setup.from_dataset(read[what])
        assert setup == flow.setup and setup.digest() == flow.setup.digest() == read[what].attrs["setup_digest"]
    arrays = flow.setup.node_arrays()
    assert len(arrays) == (len(values) if form in ("array", "list") else 0)
    for variable, array in arrays.items():
        key = variable.removeprefix(f"{kind}__")
        np.testing.assert_array_equal(read["maps"][variable].values.ravel(), values[key])
        assert read["maps"][variable].dims == ("y", "x") and variable in read["maps"].attrs["setup"]
        assert read["maps"][variable].attrs["units"] == {"deg": "degree", "-": "1"}.get(array.unit, array.unit)


@pytest.mark.slow
@pytest.mark.parametrize("which", OUTSIDE)
def test_laws_from_outside_are_told_but_not_built(which, tmp_path):
    flow, snapshots = run(scene(), erosion=OUTSIDE[which])
    path = f"{type(OUTSIDE[which]).__module__}.{type(OUTSIDE[which]).__qualname__}"
    told = flow.setup.to_mapping()["erosion"]
    assert told["law"] == path and is_plain(flow.setup.to_mapping()) and " at 0x" not in told.get("repr", "")
    assert ("repr" in told) != which.startswith("odd")  # of what is declared there are the parameters
    for read in written_and_read(flow, snapshots, tmp_path).values():
        if "setup" in read.attrs:
            with pytest.raises(ParameterError, match=r"unknown law .*; give an object of that class, or put the class"):
                Setup.from_dataset(read)
    assert flow.setup.digest() == flow.maps.attrs["setup_digest"]


def test_a_law_from_outside_with_a_name_is_built(monkeypatch, tmp_path):
    monkeypatch.setitem(LAWS, "erosion", LAWS["erosion"] | {"odd": type(OUTSIDE["odd"])})
    flow, snapshots = run(scene(), erosion=OUTSIDE["odd array"])
    assert Setup.from_dataset(written_and_read(flow, snapshots, tmp_path)["snapshots"]) == flow.setup


def test_a_flow_is_run_again_by_its_setup():
    flow, _ = run(scene(), friction={"law": "voellmy", "cohesion": np.linspace(0.0, 50.0, NODES)})
    again = DebrisFlow(scene(), **vars(Setup.from_dataset(flow.maps)))
    again.run_one_step(0.5)
    assert again.setup == flow.setup
    xr.testing.assert_identical(again.particles, flow.particles)


# ---- digests ----


def variants():
    """Yield setups of which no two are equal."""
    yield from (Setup(), Setup(**ALL_IN_IT), Setup(inflow=SURGES), Setup(inflow=SURGES[::-1]), Setup(inflow=SURGES[0]))
    for kind, laws in LAWS.items():
        yield from (Setup(**{kind: name}) for name in list(laws)[1:])
    for cls, keyword in ((Material, "material"), (Numerics, "numerics")):
        for field in dataclasses.fields(cls):
            if isinstance(field.default, float) and field.metadata["bounds"][0] < field.default:
                yield Setup(**{keyword: {field.name: np.nextafter(field.default, 0.0)}})
    angles = np.linspace(10.0, 30.0, 50)
    yield from (Setup(friction=Coulomb(basal_friction_angle=angle)) for angle in ("one", "other", angles, angles[:-1]))
    yield Setup(friction=Voellmy(basal_friction_angle=angles))
    other = angles.copy()
    other[7] = np.nextafter(other[7], 0.0)
    yield Setup(friction=Coulomb(basal_friction_angle=other))
    yield from (Setup(erosion=law) for law in OUTSIDE.values())
    yield Setup(erosion=Rate(1.0))
    yield Setup(erosion=Rate({"a", "b", "c"}))
    yield Setup(erosion=Rate(np.arange(3.0)))
    yield Setup(erosion=Rate(np.arange(4.0)))


class Rate:
    """A law that is not declared."""

    def __init__(self, rate):
        self.rate = rate

    def entrainment_rate(self, state, out):
        out[:] = 0.0


class Circular(Rate):
    """A law that holds itself."""

    def __init__(self):
        super().__init__([self])


def test_no_two_setups_have_the_same_digest():
    digests = [setup.digest() for setup in variants()]
    assert len(set(digests)) == len(digests) > 40
    assert all(len(one) == 32 and int(one, 16) >= 0 for one in digests)


def test_equal_setups_have_the_same_digest():
    nan = np.array([np.nan, -0.0, 1.0])
    other = -np.copysign(nan, [1.0, -1.0, -1.0])
    assert np.signbit(other).tolist() != np.signbit(nan).tolist()
    one, two = (Setup(friction=Coulomb(cohesion=values)) for values in (nan, other))
    assert one == two and one.digest() == two.digest()
    assert Setup(friction=Coulomb(cohesion=0.0)).digest() == Setup(friction=Coulomb(cohesion=-0.0)).digest()
    assert Setup(erosion=Circular()).digest() == Setup(erosion=Circular()).digest() != Setup(erosion=Rate(1)).digest()


@pytest.mark.slow
def test_a_digest_is_the_same_in_every_process():
    expected = [setup.digest() for setup in variants()]
    code = "from tests.scene.test_setup import variants; print(*(setup.digest() for setup in variants()))"
    for seed in ("1", "2"):
        environment = os.environ | {"PYTHONHASHSEED": seed}
        found = subprocess.run(
            [sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=True
        )
        assert found.stdout.split() == expected


def test_it_pickles():
    for setup in variants():
        again = pickle.loads(pickle.dumps(setup)) if "laden" not in repr(setup).lower() else setup
        assert again.digest() == setup.digest()


# ---- refusals ----


@pytest.mark.parametrize(
    ("mapping", "words"),
    [
        ({"frction": "voellmy"}, "Setup: unknown key 'frction' (did you mean 'friction'?); allowed: flow, friction"),
        (["voellmy"], "Setup: a mapping is needed, got ['voellmy']"),
        ({"friction": {"cohesion": 1.0}}, "friction: a mapping needs the key 'law'"),
        ({"numerics": {"particles": 10}}, "Numerics: unknown key 'particles'"),
        ({"material": 3.0}, "material must be a Material or a mapping, got 3.0"),
        ({"inflow": "surge"}, "inflow must be a Hydrograph, a mapping, or a list of them, got 'surge'"),
    ],
)
def test_what_is_no_setup(mapping, words):
    with pytest.raises(ParameterError) as refusal:
        Setup.from_mapping(mapping)
    assert words in str(refusal.value)


def test_a_dataset_without_a_setup_or_a_variable():
    flow, snapshots = run(scene(), friction=Coulomb(cohesion=np.zeros(NODES)))
    with pytest.raises(ParameterError, match="the Dataset has no attribute 'setup'"):
        Setup.from_dataset(flow.particles)
    with pytest.raises(ParameterError, match="friction: cohesion is in the variable 'friction__cohesion', which"):
        Setup.from_dataset(snapshots.dataset[["topographic__elevation"]])


def test_it_is_frozen():
    with pytest.raises(dataclasses.FrozenInstanceError):
        Setup().friction = Voellmy()
    assert Setup(inflow=None).inflow == () and Setup(inflow=Hydrograph(**SURGES[0])).inflow[0].volume > 0.0
    assert not Setup().two_phases and Setup(flow="two_phase").two_phases


@pytest.mark.parametrize(("attributes", "words"), [({}, "no attribute 'setup'"), ({"setup": "{no json"}, "is no JSON")])
def test_a_dataset_without_a_setup_is_refused(attributes, words):
    with pytest.raises(ParameterError, match=f"Setup: .*{words}.*; give the maps or snapshots of a flow"):
        Setup.from_dataset(xr.Dataset(attrs=attributes))
