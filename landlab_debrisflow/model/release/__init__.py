"""Failing ground becomes particles."""
