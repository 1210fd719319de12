"""Who carries out the units of a plan."""
