"""Setup of a run as a value, and ready-made terrains."""
