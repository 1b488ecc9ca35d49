"""The contact solution in the diagram's coordinate: it knows no indenter."""
