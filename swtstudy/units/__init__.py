"""Quantities with a unit: elastic moduli and what sizes are possible."""
