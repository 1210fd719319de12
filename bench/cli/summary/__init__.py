"""What `show` says of a run in at most 40 lines: which law, its exceptions, the claims, what failed, where to look."""
