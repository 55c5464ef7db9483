"""Tests of the mathematics without debris."""
