"""Statements of the paper about its results, tested on archives: one file per figure or concept."""
