"""Which law to use, computed from a run: criteria a row a law, the Pareto front, and a decision for each need.

tables.py       the rows of a run that laws are compared on, the same starts for each
criteria.py     what is measured of a law, each criterion a NamedTuple of data
measured.py     all criteria of all laws, with intervals, and when one law is notably better
front.py        the laws that no other beats in everything at once
needs.py        what a user may need, and the law each need leads to
best.py         the six laws that run on arms
"""
