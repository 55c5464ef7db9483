"""One phase or two: what the number of phases changes in a step."""
