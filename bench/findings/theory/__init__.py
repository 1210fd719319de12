"""Closed forms that results are held against."""
