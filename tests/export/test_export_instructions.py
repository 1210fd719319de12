"""Instructions of a law in C, as callgrind counts them, beside those of our own compiled loop."""
