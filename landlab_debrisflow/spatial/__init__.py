"""Mathematics of particles and rasters: cell lists, SPH sums, transfer between particles and nodes."""
