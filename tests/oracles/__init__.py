"""Independent routes to what the package computes."""
