"""A scene that is run, or gone on with, by the commands, for `benchmarks.kill`: writes what it came to, as digests.

python -m benchmarks.kill_scene FOLDER
"""

import hashlib
import json
import sys
from pathlib import Path

import rasterio
import xarray as xr

from landlab_debrisflow.cli.main import main as command

DATES = ("date_created", "started", "written", "scene_file")
CHECKPOINT, RESULT = "checkpoint.nc", "result.json"
SCENE = """\
terrain: {{example: gully, soil_depth: 2.0}}
release:
  - {{polygons: [[400020, 5200145], [400050, 5200145], [400050, 5200170], [400020, 5200170]], depth: 1.5}}
  - {{polygons: [[400060, 5200145], [400080, 5200145], [400080, 5200165], [400060, 5200165]], depth: 1.0, time: 9.0}}
numerics: {{particle_count: 1500}}
output:
  directory: {folder}
  max_duration: 300.0
  interval: 2.0
  checkpoint_interval: 0.1
  gauges: {{apex: [400340, 5200150]}}
  sections: {{apex: [[400340, 5200110], [400340, 5200190]]}}
  thalweg: [[400037, 5200157], [400340, 5200150], [400690, 5200150]]
  tracks: 5
"""


def digests(folder: Path) -> dict[str, str]:
    """Return a digest of every file in a directory of results, without dates."""
    found = {}
    for path in sorted(path for path in folder.rglob("*") if path.is_file() and path.name != RESULT):
        if path.suffix == ".nc":
            with xr.open_dataset(path, decode_coords=False) as data:
                words = {key: value for key, value in data.attrs.items() if key not in DATES}
                parts = [str(sorted(words.items())).encode()]
                for name, variable in sorted(data.variables.items()):
                    parts += [str(name).encode(), variable.values.tobytes()]
        elif path.suffix == ".tif":
            with rasterio.open(path) as data:
                words = {key: value for key, value in data.tags().items() if key not in DATES}
                parts = [str(sorted(words.items())).encode(), data.read(1).tobytes()]
        elif path.suffix == ".json":
            values = json.loads(path.read_text(encoding="utf-8"))
            values["scene"]["output"].pop("directory")
            values["files"].sort()
            values = {key: value for key, value in values.items() if key not in (*DATES, "digest")}
            parts = [json.dumps(values, sort_keys=True).encode()]
        elif path.suffix == ".yaml":
            continue  # names the directory
        else:
            parts = [path.read_bytes()]
        found[path.relative_to(folder).as_posix()] = hashlib.blake2b(b"\0".join(parts)).hexdigest()
    return found


def main() -> int:
    folder = Path(sys.argv[1]).resolve()
    scene = folder.with_name(f"{folder.name}.yaml")
    scene.write_text(SCENE.format(folder=folder), encoding="utf-8")
    word = "resume" if (folder / "run.json").exists() else "run"
    if (code := command([word, str(scene), "--quiet"])) not in (0, 3):
        return code
    scene.unlink()
    found = digests(folder)
    (folder / RESULT).write_text(json.dumps(found))
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
