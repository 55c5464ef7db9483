"""The border to Landlab: all that touches a RasterModelGrid. Nothing of Landlab passes further down."""
