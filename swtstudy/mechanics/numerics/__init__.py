"""Arrays, roots, series, peaks and spread directions: no physics."""
