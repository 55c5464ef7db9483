"""Citation of the package and of the paper."""

PAPER = """
@article{pastor2022ale,
  author = {Pastor, Manuel and others},
  title = {An {ALE} finite difference--{SPH} depth integrated model for pore pressure evolution on
           landslides over erodible terrains},
  journal = {International Journal for Numerical and Analytical Methods in Geomechanics},
  volume = {46}, pages = {1127--1153}, year = {2022}, doi = {10.1002/nag.3339}
}
"""
