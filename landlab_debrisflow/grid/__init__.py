"""The border to Landlab: code that touches a RasterModelGrid. Only plain arrays and numbers pass further down."""
