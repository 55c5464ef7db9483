"""State and time: moving mass, its exchange with the bed, and the loop. Knows arrays, not grids."""
