"""A run whose scene has all kinds of output, and names that a browser would obey."""

import json

import pytest

from landlab_debrisflow.report import write_report
from landlab_debrisflow.run.scene import Scene

NAME = "<script>alert('name')<b>"
HOUSE = "<img src=x onerror=alert(1)>"
OUTLINE = [[400020, 5200145], [400050, 5200145], [400050, 5200170], [400020, 5200170]]
LINE = [[400035, 5200157], [400150, 5200157], [400250, 5200142], [400340, 5200150], [400690, 5200150]]
SCENE = {
    "terrain": {"example": "gully", "soil_depth": 2.0},
    "release": {"polygons": [OUTLINE], "depth": 1.5},
    "friction": {"law": "voellmy", "turbulent_coefficient": 300.0},
    "material": {
        "coefficient_of_consolidation": {"permeability": 2e-12, "pore_fluid_viscosity": 1e-3, "stiffness": 2e5},
    },
    "numerics": {"particle_count": 60},
    "output": {
        "max_duration": 9.0, "interval": 3.0, "gauges": {"Müh<le": [400060, 5200157]},
        "sections": {"apex": [[400100, 5200110], [400100, 5200190]]}, "thalweg": LINE, "columns": 2,
        "exposure": {HOUSE: [[x + 40, y] for x, y in OUTLINE], "far": [[x + 600, y - 100] for x, y in OUTLINE]},
    },
}  # fmt: skip


@pytest.fixture(scope="session")
def results(tmp_path_factory):
    """Results of a run of a second, for reading only."""
    folder = tmp_path_factory.mktemp("report")
    path = folder / f"{NAME}.yaml"
    path.write_text(json.dumps(SCENE), encoding="utf-8")
    return Scene.from_file(path).run()


@pytest.fixture(scope="session")
def page(results, tmp_path_factory):
    """Path of the report of the run."""
    return write_report(results, tmp_path_factory.mktemp("page") / "report.html")
