"""Libraries, one file each, with one constant LIBRARY; a library that is not installed is left out, with a line."""
