"""Control by displacements or forces: each has the coordinate in which its memory diagram is drawn."""
