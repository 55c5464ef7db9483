"""Cases with known solutions, measures and rivals, for tests and benchmarks."""
