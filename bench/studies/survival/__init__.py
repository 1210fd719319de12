"""Runs that are killed and started again: a hundred at random moments, some at every one of their file operations."""
