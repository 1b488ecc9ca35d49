"""What all rooms speak of: parameters and quantities by name, mistakes, words; how files are written."""
