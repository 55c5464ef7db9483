"""What watches and writes. Reads the model, is never imported by it."""
