"""Input of a user: a study in TOML, validated before anything is computed, measured files, and units."""
