"""Whatever the laws and however their parameters are given: what is written is read back equal, under legal names."""

import dataclasses
import re
from datetime import UTC, datetime
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr

from landlab_debrisflow import DebrisFlow, Material, Numerics, __version__
from landlab_debrisflow.core.parameters import declared, parameter
from landlab_debrisflow.core.values import NodeValues, from_mapping
from landlab_debrisflow.physics.erosion import Growth
from landlab_debrisflow.physics.friction import Coulomb
from landlab_debrisflow.physics.registry import LAWS
from landlab_debrisflow.record.files import write_dataset
from landlab_debrisflow.record.observers import Snapshots
from validation.grids import inclined, release_slab

FEW, SHAPE = {"particle_count": 20}, (12, 30)
NODES = SHAPE[0] * SHAPE[1]
FORMS = ("number", "array", "list", "field", "none", "text")
LEGAL = re.compile("[A-Za-z][A-Za-z0-9_]*")


def scene(walled=True):
    grid = inclined(SHAPE, 5.0, 0.5, soil=1.0)
    if walled:
        grid.status_at_node[grid.x_of_node > 130.0] = grid.BC_NODE_IS_CLOSED
    release_slab(grid, (30.0, 28.0), 8.0, 1.0)
    return grid


def run(grid, **keywords):
    snapshots = Snapshots(0.25)
    flow = DebrisFlow(grid, observers=[snapshots], **({"numerics": FEW} | keywords))
    flow.run_one_step(0.5)
    return flow, snapshots


def written_and_read(flow, snapshots, folder):
    """Write maps, particles, columns, as a user would, and snapshots, as they do themselves; return what is read."""
    read = {}
    now = {"maps": flow.maps, "particles": flow.particles, "columns": flow.columns, "snapshots": snapshots.dataset}
    for what, data in now.items():
        path = folder / f"{what}.nc"
        if what == "snapshots":
            write_dataset(path, data)
        else:
            data.to_netcdf(path)
        with xr.open_dataset(path) as stored:
            xr.testing.assert_identical(stored.load(), data)
        names = [*data.variables, *data.dims, *data.attrs, *(name for v in data.variables.values() for name in v.attrs)]
        assert [name for name in names if not LEGAL.fullmatch(name)] == [], what
        assert all(data[axis].encoding["_FillValue"] is None for axis in data.coords if data[axis].dtype == float), what
        read[what] = stored
    return read


def given(law, form):
    """Return values of the parameters of a law in some form, where they may have it."""
    fields = {field.name: field for field in dataclasses.fields(law)}
    varying = [name for name, field in fields.items() if field.metadata["varies"]]
    if form == "none":
        return {name: None for name, field in fields.items() if field.default is None}
    if form == "text":
        return {name: field.metadata["choices"][-1] for name, field in fields.items() if field.metadata["choices"]}
    if form == "number":
        numbers = {name: field.default for name, field in fields.items() if isinstance(field.default, float)}
        return {name: 0.99 * value for name, value in numbers.items()}
    values = {name: np.linspace(1.0, 1.1, NODES) * (fields[name].default or 1.0) for name in varying}
    if form == "list":
        return {name: array.tolist() for name, array in values.items()}
    return {"array": values, "field": {name: f"some__{name}" for name in varying}}.get(form, {})


CASES = [
    (kind, name, form)
    for kind, laws in LAWS.items() for name, law in laws.items() for form in FORMS
    if form == "number" or given(law, form)
]  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize(("kind", "name", "form"), CASES)
def test_every_law_in_every_form(kind, name, form, tmp_path):
    grid, law = scene(), LAWS[kind][name]
    values, closed = given(law, form), grid.status_at_node == grid.BC_NODE_IS_CLOSED
    at_nodes = given(law, "array") if form in ("array", "list", "field") else {}
    if form == "field":
        for key, array in at_nodes.items():
            grid.add_field(f"some__{key}", array, at="node")
    flow, snapshots = run(grid, **{kind: {"law": name} | values})
    read = written_and_read(flow, snapshots, tmp_path)
    for stored in read.values():
        assert (stored.attrs[kind], stored.attrs[f"{kind}_law"]) == (law.__name__, name)
    for key, value in values.items():
        stored, label = read["maps"].attrs, f"{kind}_{key}"
        if value is None:
            assert label not in stored
        elif key not in at_nodes:
            assert stored[label] == value
        elif form == "field":
            assert stored[label] == f"some__{key}"
    for key, array in at_nodes.items():
        for what in ("maps", "snapshots"):  # once, not at every time
            kept = read[what][f"{kind}_{key}"]
            np.testing.assert_array_equal(kept.values.ravel(), np.where(closed, np.nan, array))
            unit = law.__dataclass_fields__[key].metadata["unit"]
            assert kept.attrs["units"] == {"deg": "degree", "-": "1"}.get(unit, unit)


@pytest.mark.slow
@pytest.mark.parametrize("form", ["number", "none", "text"])
@pytest.mark.parametrize(("keyword", "cls"), [("material", Material), ("numerics", Numerics)])
def test_material_and_numerics_in_every_form(keyword, cls, form, tmp_path):
    values = {name: value for name, value in given(cls, form).items() if name != "hold"}  # of a number to be found
    flow, snapshots = run(scene(), **{keyword: values})
    read = written_and_read(flow, snapshots, tmp_path)["maps"].attrs
    for key in values:  # a preset gives values to what is left open
        assert read.get(f"{keyword}_{key}") == getattr(cls(**values), key), key


@pytest.mark.slow
@pytest.mark.parametrize("velocity", [4.0, [4.0, 5.0, 6.0]])
def test_hydrographs(velocity, tmp_path):
    line = {
        "line_start": (20.0, 20.0),
        "line_end": (20.0, 40.0),
        "times": [0.0, 0.2, 9.0],
        "discharge": [0.0, 40.0, 0.0],
    }
    other = line | {"line_start": (60.0, 20.0), "line_end": (60.0, 40.0)}
    inflow = [line | {"velocity": velocity}, other | {"velocity": 3.0, "pressure_ratio": [0.5, 0.6, 0.7]}]
    read = written_and_read(*run(scene(), inflow=inflow), tmp_path)
    attributes = read["maps"].attrs
    np.testing.assert_array_equal(attributes["inflow_0_velocity"], velocity)
    np.testing.assert_array_equal(attributes["inflow_1_pressure_ratio"], [0.5, 0.6, 0.7])
    np.testing.assert_array_equal(attributes["inflow_1_line_start"], [60.0, 20.0])
    assert attributes["inflow_0_discharge_units"] == "m3 s-1" and "inflow_0_direction" not in attributes


@pytest.mark.slow
def test_attributes_build_the_same_law_again(tmp_path):
    law = Coulomb(basal_friction_angle=12.5, velocity_profile="parabolic")
    flow, snapshots = run(scene(), friction=law)
    read = written_and_read(flow, snapshots, tmp_path)["maps"].attrs
    names = [field.name for field in dataclasses.fields(Coulomb)]
    assert from_mapping(LAWS["friction"][read["friction_law"]], {k: read[f"friction_{k}"] for k in names}) == law
    assert read["friction_basal_friction_angle_units"] == "degree" and read["friction_viscosity_units"] == "Pa s"


# ---- laws from outside ----


class Bare:
    """The least that is a law."""

    def entrainment_rate(self, state, out):
        out[:] = 0.001 * state.speed


class Laden(Bare):
    """With all that a file cannot hold, and some of what it can."""

    def __init__(self):
        self.rate, self.name, self.on, self.none, self.few = np.float32(0.5), "mud", True, None, (1, 2.5)
        self.rate_m3_s = 3
        self.φ, self.huge, self.nothing, self.words = 0.6, 10**400, [], ["a", "b"]
        self.table, self.law, self._hidden = {"a": 1}, "not its name", 1.0
        self.function, self.complex, self.map = (lambda: 0), 1 + 2j, np.arange(float(NODES))


@dataclasses.dataclass
class Plain(Bare):
    """A dataclass without declarations."""

    coefficient: float = 0.1
    nothing: float | None = None


class Slotted(Bare):
    """A law without a dictionary."""

    __slots__ = ("rate",)


@declared
class Odd(Growth):
    """e_R = c v: a law whose names and units are of no file."""

    température: float = parameter("m½ s-1/3", "of the day", 1.0, varies=True)


OUTSIDE = {
    "bare": Bare(), "laden": Laden(), "dataclass": Plain(), "slots": Slotted(),
    "namespace": SimpleNamespace(entrainment_rate=Bare().entrainment_rate, rate=1.0),
    "odd": Odd(température=2.0), "odd array": Odd(température=np.full(NODES, 2.0)),
}  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize("which", OUTSIDE)
def test_laws_from_outside(which, tmp_path):
    law = OUTSIDE[which]
    read = written_and_read(*run(scene(), erosion=law), tmp_path)
    path = f"{type(law).__module__}.{type(law).__qualname__}"
    for stored in read.values():
        assert (stored.attrs["erosion"], stored.attrs["erosion_law"]) == (type(law).__name__, path)
    attributes = read["maps"].attrs
    if which == "laden":
        assert (
            attributes["erosion_rate"] == 0.5 and attributes["erosion_name"] == "mud" and attributes["erosion_on"] == 1
        )
        assert attributes["erosion_u3c6"] == 0.6 and attributes["erosion_few"].tolist() == [1.0, 2.5]
        assert not {"erosion_none", "erosion__hidden", "erosion_function", "erosion_table"} & set(attributes)
        np.testing.assert_array_equal(np.isnan(read["maps"].erosion_map.values), read["maps"].soil__depth.isnull())
    if which == "dataclass":
        assert attributes["erosion_coefficient"] == 0.1 and "erosion_nothing" not in attributes
    if which == "odd":
        assert attributes["erosion_tempue9rature"] == 2.0


# ---- what every file says ----


@pytest.mark.slow
def test_every_file_says_what_wrote_it_when_and_of_how_much(tmp_path):
    before = datetime.now(UTC).replace(microsecond=0)
    flow, snapshots = run(scene(), friction="voellmy")
    for what, stored in written_and_read(flow, snapshots, tmp_path).items():
        attributes = stored.attrs
        assert attributes["Conventions"] == "CF-1.10" and attributes["version"] == __version__
        assert attributes["source"] == f"landlab_debrisflow {__version__}" and attributes["number_of_particles"] == 20
        laws = {kind: attributes[f"{kind}_law"] for kind in LAWS}
        assert laws == {"flow": "one_phase", "friction": "voellmy", "erosion": "growth", "column": "ale"}
        if what in ("maps", "snapshots"):  # not of particles: the same are identical, whenever
            assert attributes["date_created"].endswith("Z")
            assert before <= datetime.fromisoformat(attributes["date_created"]) <= datetime.now(UTC)
        assert all("units" in stored[name].attrs and "long_name" in stored[name].attrs for name in stored.variables)
    maps = flow.maps.attrs
    assert (maps["elapsed_time"], maps["elapsed_time_units"]) == (0.5, "s")
    for name, volume in flow.budget.items():
        assert (maps[f"budget_{name}"], maps[f"budget_{name}_units"]) == (volume, "m3")


def test_the_version_is_said_once():
    root = Path(__file__).parents[2]
    assert f'\nversion = "{__version__}"\n' in (root / "pyproject.toml").read_text()
    assert f"\nversion: {__version__}\n" in (root / "CITATION.cff").read_text()


# ---- closed nodes ----


@pytest.mark.slow
def test_closed_nodes_are_missing_in_every_map(tmp_path):
    """A DEM of which a part is NODATA; only what runs against its faces is known there."""
    grid = scene(walled=False)
    z, outside = grid.at_node["topographic__elevation"], grid.x_of_node > 100.0
    z[outside] = -9999.0
    grid.at_node["soil__depth"][outside] = np.nan
    grid.set_nodata_nodes_to_closed(z, -9999.0)
    angle = np.where(outside, np.nan, 30.0)
    grid.add_field("some__angle", angle, at="node")
    friction = {"law": "coulomb", "basal_friction_angle": "some__angle"}
    flow, snapshots = run(grid, friction=friction, flow="two_phase")
    start = flow.maps
    flow.run_one_step(12.0)
    assert flow.budget["moving"] > 0.0 and z[outside].max() == -9999.0  # the grid itself keeps what it has
    maps = written_and_read(flow, snapshots, tmp_path)["maps"]
    closed = outside.reshape(grid.shape)
    on_walls = [name for name in maps if name.endswith(("max_impact_pressure", "max_run_up"))]
    for name, values in maps.items():
        np.testing.assert_array_equal(np.isnan(values), closed & (name not in on_walls), name)
        assert np.isnan(values.encoding["_FillValue"])
    for name in on_walls:
        assert not start[name].values[closed].any()  # nothing struck them yet: 0
        assert maps[name].values[closed].max() > 0.0


# ---- series ----


@pytest.mark.slow
def test_snapshots_whose_maps_differ_are_written(tmp_path):
    """A field that comes between two calls, and a parameter field that changes."""
    grid = inclined(SHAPE, 5.0, 0.5)
    release_slab(grid, (30.0, 28.0), 8.0, 1.0)
    grid.add_full("some__angle", 30.0, at="node")
    snapshots = Snapshots(1.0)
    friction = {"law": "coulomb", "basal_friction_angle": "some__angle", "cohesion": np.full(NODES, 10.0)}
    flow = DebrisFlow(grid, friction=friction, numerics=FEW, observers=[snapshots])
    flow.run_one_step(1.0)
    grid.add_full("soil__depth", 0.5, at="node")
    grid.at_node["some__angle"][:] = 25.0
    flow.run_one_step(1.0)
    series = written_and_read(flow, snapshots, tmp_path)["snapshots"]
    soil, angle, cohesion = (
        series[name] for name in ("soil__depth", "friction_basal_friction_angle", "friction_cohesion")
    )
    assert np.isnan(soil[0]).all() and float(soil[1].min()) <= 0.5
    assert [float(one.max()) for one in angle] == [30.0, 25.0] and cohesion.dims == ("y", "x")
    assert not [name for name in series.attrs if name.startswith(("budget", "elapsed_time"))]


@pytest.mark.slow
def test_node_values_print_as_a_file_tells_them():
    flow = DebrisFlow(scene(), friction=Coulomb(cohesion=np.linspace(0.0, 5.0, NODES)))
    assert flow.maps.attrs["friction_cohesion"] == repr(NodeValues(np.linspace(0.0, 5.0, NODES))).strip("<>")
