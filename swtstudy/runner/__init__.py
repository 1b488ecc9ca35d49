"""Running a study: what has to be computed is planned apart from computing it."""
