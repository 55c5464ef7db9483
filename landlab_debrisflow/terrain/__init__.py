"""The ground: a smooth surface through the nodes, erodible soil, and the pore pressure of the bed."""
