"""Results of canonical points: their values, their state, and what made them."""
