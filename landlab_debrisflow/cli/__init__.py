"""The command line, thin: runs and pages are made by the modules beside and below."""
