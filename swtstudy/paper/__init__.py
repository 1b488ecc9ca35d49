"""What checks the paper and this package: statements, an audit, the textbook method."""
