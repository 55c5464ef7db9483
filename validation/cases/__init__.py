"""Cases with a solution, exact or converged."""
