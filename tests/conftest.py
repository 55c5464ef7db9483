"""Set-up shared by all tests.

numba's disk cache watches only a function's own file: a kernel that inlines one of another file would
stay stale after a change there. So the cache lives in a folder named by a hash of all sources.
"""

import hashlib
import os
import pathlib
import tempfile

_PACKAGE = pathlib.Path(__file__).parents[1] / "landlab_debrisflow"
_HASH = hashlib.sha256()
for _file in sorted(_PACKAGE.rglob("*.py")):
    _HASH.update(_file.read_bytes())
os.environ["NUMBA_CACHE_DIR"] = os.path.join(
    tempfile.gettempdir(), f"landlab_debrisflow_numba_{_HASH.hexdigest()[:16]}"
)

import pytest  # noqa: E402  numba must not be imported before the line above

from .grids import inclined, release_slab  # noqa: E402


@pytest.fixture
def slope():
    """A wet slope of 27 degrees with one metre of soil and 225 m3 about to fail: erodes, leaves nothing."""
    grid = inclined((20, 60), 5.0, 0.5, soil=1.0)
    release_slab(grid, (30.0, 48.0), 8.0, 1.0)
    return grid


@pytest.fixture
def valley():
    """The same slope running out on a flat: everything comes to rest inside."""
    grid = inclined((20, 80), 5.0, 0.5, soil=1.0, foot=150.0)
    release_slab(grid, (30.0, 48.0), 8.0, 1.0)
    return grid
