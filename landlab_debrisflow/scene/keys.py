"""Keys of a scene file: `terrain`, `release`, `output`, `ensemble`; other keys are the attributes of `Setup`."""

from .ensemble_keys import EnsembleKeys
from .output_keys import OutputKeys
from .release_keys import ReleaseKeys
from .terrain_keys import TerrainKeys

__all__ = ["EnsembleKeys", "OutputKeys", "ReleaseKeys", "TerrainKeys"]
