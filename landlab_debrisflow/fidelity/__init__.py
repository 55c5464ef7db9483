"""Fidelity: how exact a run is, and what the cheapest run is that is exact enough."""
