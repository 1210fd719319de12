"""Studies outside the benchmark's suites, each with its own results."""
