"""Tables that no experiment makes: times, the studies of perturbations and of a real loop, other libraries' answers."""

from bench.experiments.columns import read_table

NAMES = ("perturbed", "timings", "libraries", "closed_loop", "verdicts", "real_loop")
STUDIED = tuple(read_table(__file__, name) for name in NAMES)
