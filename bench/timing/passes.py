"""What pytest collects for `python -m bench time`: one benchmark for each visit. `make test` does not collect it.

`session` parametrizes it with the visits of all passes, in their order.
"""

from bench.timing.session import ROUNDS


def test_visit(benchmark, visit):
    """One thing, once a pass, two rounds on end."""
    benchmark.pedantic(visit.thing.call, rounds=ROUNDS, iterations=1)
    visit.taken(benchmark.stats.stats.data)
