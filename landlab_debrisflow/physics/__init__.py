"""The laws, one per file. Sub-packages do not import each other."""
