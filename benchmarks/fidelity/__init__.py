"""Error against cost of runs with more and fewer particles, and what the plan of a flow makes of it."""
