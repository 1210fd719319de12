"""Tables that no experiment makes: times, results of studies, and other libraries' answers."""

from bench.experiments.columns import read_table

NAMES = ("perturbed", "timings", "libraries", "closed_loop", "verdicts", "real_loop", "contact_limits")
STUDIED = tuple(read_table(__file__, name) for name in NAMES)
