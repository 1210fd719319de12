"""Hold what every room uses: errors, where numbers come from, and files that are written whole or not at all."""
