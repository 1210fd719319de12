"""Rotational springs with a stiffness matrix, one file each, with one constant SPRING. The file is the word."""
