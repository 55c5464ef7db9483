"""Keys of a scene file beside the ones of `Setup`: `terrain`, `release`, `output`."""

from .output_keys import OutputKeys
from .release_keys import ReleaseKeys
from .terrain_keys import TerrainKeys

__all__ = ["OutputKeys", "ReleaseKeys", "TerrainKeys"]
