"""Real contacts in physical units, and the lives of their bodies."""
