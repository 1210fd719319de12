"""Coordinates of a rotation, one file each, with one constant REPRESENTATION. The file name is the word."""
