"""The chapter on where laws fail, and where they stop failing."""
