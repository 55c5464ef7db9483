"""Debris that flows in over lines: hydrographs, and the rows of particles made of them."""
