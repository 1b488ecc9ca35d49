"""Points in, values out: s, quantities beside it, margins, and load cycles as they are drawn."""
