"""One side's own numbers of one benchmark, as a comparison and a history keep them."""

from typing import Any, NamedTuple

LAW, ENGINE = "law", "engine"


class Spread(NamedTuple):
    """A median over rounds, with an interval of at least 95 % that assumes no distribution."""

    median: float
    low: float
    high: float


class Measurement(NamedTuple):
    """What one benchmark costs on one side.

    name: the law, as rows and the command line write it; of an engine its name before it, as "native rotation-matrix".
    what: "law" (alone, one command waiting for the other) or "engine" (a whole simulated tick).
    kernel_steps: time a tick over a step of the reference kernel timed beside it; None if not timed.
    rounds: how many rounds that is of.
    instructions: a tick, by callgrind; None where they were not counted.
    operations: a tick, by branch and operation, "flops" among them; empty for an engine.
    code: digest of the machine code; empty for an engine.
    """

    name: str
    what: str
    kernel_steps: Spread | None = None
    rounds: int = 0
    instructions: float | None = None
    operations: dict[str, dict[str, int]] = {}  # noqa: RUF012  a tuple's default, never written to
    code: str = ""

    def as_json(self) -> dict[str, Any]:
        """Plain dictionaries and lists."""
        return {**self._asdict(), "kernel_steps": list(self.kernel_steps) if self.kernel_steps else None}


def from_json(given: dict[str, Any]) -> Measurement:
    """The measurement that `as_json` wrote."""
    spread = given["kernel_steps"]
    return Measurement(**{**given, "kernel_steps": Spread(*spread) if spread else None})
