"""Springs of a pose, rotational ones among them, one file each, with one constant SPRING. The file is the word."""
