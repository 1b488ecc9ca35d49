"""The definition of a study: a TOML file, fully validated before anything is computed."""
