"""What the build of the documentation does besides Sphinx."""
