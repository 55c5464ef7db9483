"""The default scheme: columns are advanced when somebody needs them."""
