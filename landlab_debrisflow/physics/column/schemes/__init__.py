"""How the equation of the column is solved."""
