"""Tests of the friction laws."""
