"""Load cycles as people give them: loops of vertices, sums of harmonics, and the phases of two sines."""
