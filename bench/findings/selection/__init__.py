"""Which law to use, computed from a run: criteria a row a law, Pareto fronts, and a law for each situation.

tables.py       the rows of a run that laws are compared on, the same starts for each
criteria.py     what is measured of a law, each criterion a NamedTuple of data
measured.py     all criteria of all laws, and the rule: ties, Pareto fronts, the simplest; fixed before it was run
needs.py        situations, and the law advised in each: the one place that pages, cards and commands ask
robots.py       the same on robots that take velocities, positions, or torques with no inertia cancelled
"""
