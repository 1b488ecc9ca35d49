"""The best load: parameters for which s, or another quantity, is least, and for which it is greatest."""
