"""Controllers of arms that laws are compared with, one file each, with one constant BASELINE. The file is the word."""
