"""Checks of the paper and of this package: statements, an audit, the textbook method."""
