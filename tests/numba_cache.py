"""Where compiled kernels are kept, for tests and for the pages of the site.

numba's disk cache watches only a function's own file: a kernel that inlines one of another file would
stay stale after a change there. So the cache lives in a folder named by a hash of all sources that kernels can see.
"""

import hashlib
import os
import pathlib
import tempfile

_PACKAGE = pathlib.Path(__file__).parents[1] / "landlab_debrisflow"
_HASH = hashlib.sha256()
for _room in ("core", "spatial", "terrain", "physics", "model"):  # the others have no kernels
    for _file in sorted((_PACKAGE / _room).rglob("*.py")):
        _HASH.update(_file.read_bytes())
NUMBA_CACHE = os.path.join(tempfile.gettempdir(), f"landlab_debrisflow_numba_{_HASH.hexdigest()[:16]}")
