"""What the default scheme remembers of a column: places in `ColumnState.memory`, and the values of CONTACT."""

# VOLUME and LOAD are of when the column was last advanced, CURRENT_LOAD of the last step; JUST is 1 until what
# lies in the half cell of the base level came with this contact; DIFFUSION is c_v t / h^2 since then or, while
# closed, since it closed.
CONTACT, JUST, VOLUME, LOAD, CURRENT_LOAD, DIFFUSION = range(6)

# while the base prescribes or gives: pressure of the bed now, that at the base at the last advance, pressure
# by a porosity source, diffusion left over, volume when this contact began
BED_PRESSURE, BASE, SOURCE, OWED, TOUCHED = range(6, 11)

# while closed, of the last look: the part in waves too short for the levels, and that of the kink when it closed;
# least and largest pressure, and pressure over eta; pressure at the base, its parabola in c_v t / h^2, and by how
# much that may be wrong, over the cube of it
TAIL, SLOPE, LOW, HIGH, LEAST, MOST, PRESSURE, RATE, BEND, REMAINDER = range(6, 16)
# while closed, since that look: c_v t / h^2, what every grain gained over eta, by what it was scaled, what it gained
# evenly, and all gains taken positive
PASSED, LIFT, SCALE, GAIN, SWING = range(16, 21)

# LEVELS is a closed base too, of a column kept at levels; from FLUX on, soil that comes in brings its own pressure and no
# more: SEALED, under an impermeable base, that of the base
LEVELS, CLOSED, ERODING, HELD, FLUX, SEALED = 0.0, 1.0, 2.0, 3.0, 4.0, 5.0
