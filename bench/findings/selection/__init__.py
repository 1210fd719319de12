"""Which law to use: by the map of situations and its `regions`; by criteria, a row a law, for `robots` beside it."""
