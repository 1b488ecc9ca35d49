"""What the bodies are made to do: the two components of the load over the cycle."""
