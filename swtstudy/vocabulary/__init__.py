"""Words that all rooms share: parameters and quantities by name, mistakes, wording; writing of files."""
