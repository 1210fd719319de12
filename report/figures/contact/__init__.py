"""A hand in contact."""
