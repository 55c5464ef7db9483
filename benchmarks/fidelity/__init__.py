"""Error against cost of runs with more and fewer particles, and the success of plans."""
