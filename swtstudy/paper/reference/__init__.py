"""The textbook method, an oracle for tests and benchmarks alone."""
