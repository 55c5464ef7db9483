"""Tests of the tools every layer shares."""
