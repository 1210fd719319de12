"""A plan carried out: run, its folder until it is finished, processes that cannot harm it."""
