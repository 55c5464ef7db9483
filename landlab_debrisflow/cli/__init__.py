"""The command line: thin; what it does stands elsewhere."""
