"""The run of a scene with all kinds of output for a moment, and its report."""

from landlab_debrisflow import Scene
from landlab_debrisflow.report import write_report

OUTLINE = [[400020, 5200145], [400040, 5200145], [400040, 5200165], [400020, 5200165]]
SCENE = {
    "terrain": {"example": "gully", "window": [400000, 5200100, 400120, 5200210], "soil_depth": 1.0},
    "release": {"polygons": [OUTLINE], "depth": 1.5},
    "numerics": {"particle_count": 12},
    "output": {
        "max_duration": 1.2, "interval": 0.5, "series_interval": 0.4, "columns": 1,
        "gauges": {"a": [400045, 5200155]}, "sections": {"b": [[400045, 5200130], [400045, 5200180]]},
        "thalweg": [[400025, 5200155], [400110, 5200160]], "exposure": {"c": OUTLINE},
    },
}  # fmt: skip


def test_a_scene_runs_and_is_reported(tmp_path):
    results = Scene.from_mapping(SCENE, tmp_path, name="moment").run()
    text = write_report(results).read_text(encoding="utf-8")
    shown = (
        "maps",
        "sections",
        "series",
        "columns",
        "exposure",
        "volumes",
        "input",
        "scene",
        "parameters",
        "provenance",
    )
    assert [name for name in shown if f'<section id="{name}"' not in text] == []
    assert "It was still moving when the computation ended after 1.2" in text
    assert text.count("data:image/png") == 12 and text.count("data:image/gif") == 1
    assert results.before is not None and float(results.before.debris_flow__release_depth.max()) > 1.0
