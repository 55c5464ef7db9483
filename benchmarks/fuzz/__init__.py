"""Files over which no reader may stumble: drawn from a seed, one change or some bytes away from good ones."""

import os

os.environ["OMP_NUM_THREADS"] = "1"  # before landlab is loaded: threads of OpenMP do not survive a copy of the process
