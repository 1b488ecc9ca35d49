"""Checks of the paper and of this package: statements, and an audit."""
