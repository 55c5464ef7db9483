"""Files over which no reader may stumble: drawn from a seed, one change or some bytes away from good ones."""
