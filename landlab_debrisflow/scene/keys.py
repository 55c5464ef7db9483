"""Keys of a scene file: `terrain`, `release`, `output`; other keys are the attributes of `Setup`."""

from .output_keys import OutputKeys
from .release_keys import ReleaseKeys
from .terrain_keys import TerrainKeys

__all__ = ["OutputKeys", "ReleaseKeys", "TerrainKeys"]
