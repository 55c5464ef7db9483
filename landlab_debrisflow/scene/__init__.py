"""What is simulated, as values."""
