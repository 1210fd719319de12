"""What moves: the plants of `engines.loop`, one file each, with what is particular to its controllers and records."""
