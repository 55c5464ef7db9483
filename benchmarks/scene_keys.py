"""Bring the tables of keys in docs/scenes.md up to date with their declarations.

python -m benchmarks.scene_keys
"""

from pathlib import Path

from landlab_debrisflow.scene.key_tables import with_tables

PAGE = Path(__file__).parents[1] / "docs" / "scenes.md"

if __name__ == "__main__":
    PAGE.write_text(with_tables(PAGE.read_text(encoding="utf-8")), encoding="utf-8")
