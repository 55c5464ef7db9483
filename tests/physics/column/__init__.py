"""Tests of the column laws."""
