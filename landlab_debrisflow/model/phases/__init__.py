"""One phase or two: stages of a step that depend on the number of phases."""
