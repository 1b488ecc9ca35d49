"""The definition of a study: a TOML file, validated as a whole before anything is computed."""
