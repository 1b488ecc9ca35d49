"""Two other formalisms for the tangential contact of a paraboloid: neither shares code with the solver."""
