"""The plant, its coordinates, and the settings of a run."""
