"""Results of canonical points: their values, state and origin."""
