"""What robot libraries return."""
