"""Tables that no experiment makes: times, shares of a study of perturbations, and what other libraries answer."""

from bench.experiments.columns import read_table

STUDIED = tuple(read_table(__file__, name) for name in ("perturbed", "timings", "libraries", "closed_loop", "verdicts"))
