"""State of a flow and its change in time. The modules here read arrays and no grid."""
