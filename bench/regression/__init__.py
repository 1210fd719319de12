"""What a change did: rows against rows, a revision against another, and all builds in a row."""
