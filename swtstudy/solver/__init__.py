"""Points in, values out: loads and profiles as users give them, s, quantities beside it, and margins."""
