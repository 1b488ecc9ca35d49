"""Running a study: planning what has to be computed is kept apart from computing it."""
