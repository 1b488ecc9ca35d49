"""Contacts with units: their grids, scales and materials, their lives, and the way to plain numbers."""
