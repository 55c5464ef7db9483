"""Any release runs: three thousand random ones, each site with its own volume and particles, where it failed."""

import pytest

from .release_fields import KINDS, examine

pytestmark = pytest.mark.slow

NUMBER = 335


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.__name__)
def test_any_release(kind):
    for seed in range(NUMBER):
        examine(kind, seed)
