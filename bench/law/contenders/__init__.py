"""The contestants, one file each, and who finds them: `registry`, and `law_file` for a user's own."""
