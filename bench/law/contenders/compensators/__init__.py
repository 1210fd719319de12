"""Laws with a state of their own, one file each, with one constant COMPENSATOR. The file is the word."""
