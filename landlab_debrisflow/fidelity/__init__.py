"""Fidelity: the error of a run, and the cheapest run within an error."""
