"""The replication as a whole."""
