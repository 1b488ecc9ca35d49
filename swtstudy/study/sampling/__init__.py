"""Samples of parameters: designs of points in given ranges, or points from a file."""
