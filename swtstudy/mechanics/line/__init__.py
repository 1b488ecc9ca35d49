"""The largest swt on the surface line y = 0: the search along x."""
