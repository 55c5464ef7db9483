"""Files of a GIS as plain arrays and shapes, and back."""
