"""The versions of the package and of the solver's values."""

__version__ = "0.1.0"

#: To be raised whenever a change moves values of s by more than a tenth of their s_error: archives
#: remember it, and values of different versions are never mixed.
SOLVER_VERSION = "41"
