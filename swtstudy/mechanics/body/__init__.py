"""swt in the whole body and over all planes: at points, its maximum, and its means over a distance."""
