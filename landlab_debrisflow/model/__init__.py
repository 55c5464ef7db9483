"""State and time: what moves, what it exchanges with the bed, and the loop. Knows arrays, not grids."""
