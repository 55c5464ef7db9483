"""What the default scheme remembers of a column: places in `ColumnState.memory`, and the values of CONTACT."""

MEMORY_SIZE = 26
"""Numbers that the schemes may keep per column from call to call."""

# VOLUME and LOAD are of when the column was last advanced, CURRENT_LOAD of the last step; JUST is 1 until what
# lies in the half cell of the base level came with this contact.
CONTACT, JUST, VOLUME, LOAD, CURRENT_LOAD = range(5)

# while the base prescribes or gives: c_v t / h^2 since the last advance, pressure of the bed now, that at the base
# then, pressure by a porosity source, diffusion left over, volume when this contact began
DIFFUSION, BED_PRESSURE, BASE, SOURCE, OWED, TOUCHED = range(5, 11)
# while not closed: what the levels do not see of a base that changed shortly before its contact ended, as a jump at
# that base and the content of the layer over it, over the jump and the thickness
JUMP, CONTENT = 11, 12

# while closed, of the last look: least and largest pressure, and pressure over eta; pressure at the base, its parabola
# in c_v t / h^2, and by how much that may be wrong, over the cube of it
LOW, HIGH, LEAST, MOST, PRESSURE, RATE, BEND, REMAINDER = range(5, 13)
# while closed, since that look: c_v t / h^2, what every grain gained over eta, by what it was scaled, what it gained
# evenly, and all gains taken positive
PASSED, LIFT, SCALE, GAIN, SWING = range(13, 18)
# while closed, of the last look: what the waves too short for the levels do at the base, by octave (`Waves.octaves`);
# the same of a layer thinner than a level that the base had when it closed
TAIL, LAYER = 18, 22

# LEVELS is a closed base too, of a column kept at levels; from FLUX on, soil that comes in brings its own pressure and
# no more: SEALED, under an impermeable base, that of the base
LEVELS, CLOSED, ERODING, HELD, FLUX, SEALED = 0.0, 1.0, 2.0, 3.0, 4.0, 5.0
