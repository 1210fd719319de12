"""Which law to use: by the map of situations and the rule of `regions`, which also decides for `robots` beside it."""
