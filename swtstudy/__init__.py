"""Parameter studies of the Smith–Watson–Topper parameter in frictional contacts."""

__version__ = "0.1.0"
