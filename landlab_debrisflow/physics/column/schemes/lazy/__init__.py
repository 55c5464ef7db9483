"""The default scheme: columns are advanced when their pressure is needed, not at every step."""
