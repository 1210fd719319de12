"""Studies that stand beside the benchmark, each with results of its own."""
