"""Lines of a history that are made up."""

from bench.regression.history.record import Record
from bench.regression.revisions.measurement import Measurement, Spread


def line(build, *, machine="a-2-cores", time=None, instructions=None, compiler="0" * 16, code="", **typical) -> Record:
    """A line of the build of that number, of a law that is made up."""
    spread = Spread(time, 0.9 * time, 1.1 * time) if time else None
    operations = {"typical": typical, "worst": typical} if typical else {}
    measured = Measurement("my-law", "law", spread, 40 if time else 0, instructions, operations, code)
    return Record(f"{build:040x}", "2026-01-01T00:00:00Z", build + 1, machine, compiler, measured)
