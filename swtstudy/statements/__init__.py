"""What the paper says about its results, tested on archives: one file for each figure or concept."""
