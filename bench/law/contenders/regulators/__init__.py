"""Laws that regulate orientation, one file each, with one constant REGULATOR. The file name is the word."""
