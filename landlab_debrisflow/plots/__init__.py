"""Figures made of Datasets."""
