"""Tools every layer shares: declarations, units, errors and the compiler. No debris, no grid."""
