"""Find what a change did: rows against rows, a revision against another, and the cost of every build."""
