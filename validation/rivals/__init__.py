"""Other ways to solve the same cases."""
