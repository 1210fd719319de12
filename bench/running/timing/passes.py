"""What pytest collects for `bench time`: one benchmark for each sample. `make test` does not collect it.

`session` parametrizes it with the samples of all passes, in their order.
"""

from typing import Any

from bench.running.timing.session import ROUNDS, Sample


def test_sample(benchmark: Any, sample: Sample) -> None:
    """One benchmark, once a pass, two rounds on end."""
    benchmark.pedantic(sample.benchmark.call, rounds=ROUNDS, iterations=1)
    sample.taken(benchmark.stats.stats.data)
