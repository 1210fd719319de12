"""Which law to use, computed from a run: criteria a row a law, Pareto fronts, and a law for each situation.

tables.py       the rows of a run that laws are compared on, the same starts for each
criteria.py     what is measured of a law, each criterion a NamedTuple of data
measured.py     all criteria of all laws, with intervals, and when one law is notably better
rule.py         how a law is advised: ties, Pareto fronts, the simplest; fixed before it was run
timed.py        what a law takes of a whole controller's tick
needs.py        situations, and the law advised in each: the one place that pages, cards and commands ask
robot_rows.py   the same criteria on robots that take velocities, positions, or torques with no inertia cancelled
robots.py       what a robot takes, and the law that is advised for it
"""
