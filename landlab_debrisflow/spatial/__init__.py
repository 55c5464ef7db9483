"""Mathematics without debris: cell lists, SPH sums, transfer between particles and nodes."""
