"""Labelled fields of one parameter point: stress, swt and slip over position and time."""
