"""Values at which the probes measure and which claims name: gains, angles, margins, numbers of starts and of states.

A module here has the values of the module of its name in `bench.experiments.probes`. They stand apart so that claims,
which are judged from rows, import nothing that simulates.
"""
