"""Metrics of contact, one file each with a constant METRIC. The file name is the word."""
