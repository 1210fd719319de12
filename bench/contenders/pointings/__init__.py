"""Laws of reduced attitude, which point an axis, one file each, with one constant POINTING. The file is the word."""
