"""Which law to use: the map of situations and its regions, and criteria, a row a law, for robots beside it.

regions.py      the law that nothing beats in a situation, by results/situations; the regions and the default
sensitivity.py  other rules, random halves, Holm's correction, laws tuned for themselves, the held-out set
tables.py       the rows of a run that laws are compared on, the same starts for each
criteria.py     what is measured of a law, each criterion a NamedTuple of data
needs.py        all criteria of all laws, what a robot asks, and the rule, fixed before it was run
robots.py       the robots beside the map: arms, velocities, positions, torques with no inertia cancelled
words.py        what is advised in sentences
"""
