"""Loads of the two bodies: their two components over the cycle."""
