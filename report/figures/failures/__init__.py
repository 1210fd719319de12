"""Where laws fail, and where they stop to."""
