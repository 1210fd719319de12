"""From the tool's acceleration to the joints, one file each, with one constant INVERSE. The file name is the word."""
