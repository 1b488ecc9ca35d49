"""Stress on the surface and beneath it, by superposition over the memory diagram."""
