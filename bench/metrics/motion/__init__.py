"""Columns measured along an episode, one file each, with one constant METRIC. The file name is the word."""
