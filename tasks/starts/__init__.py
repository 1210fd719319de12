"""One file a start set: a constant STARTS of type tasks.base.StartSet, named as the file with dashes.

Random sampling never hits a set of measure zero. `uniform`, `tumbling` and `goals` are sampled and measure
fractions of SO(3); the other sets are directed at the points where the paper says that a regulator fails.
All begin at rest with the identity as goal unless they say otherwise.
"""
