"""Datasets, files, observers and measures. Reads the model, is never imported by it."""
