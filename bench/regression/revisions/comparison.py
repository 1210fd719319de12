"""What one comparison says, and its JSON.

The JSON is one object; `schema` names its version, which changes whenever a field is renamed or gets another meaning:

    schema      "orientation-bench comparison 2"
    verdict     "regression" or "clean"
    base, head  {name, commit, sources}: what was compared
    machine     {key, cpu, cores, platform, lock, versions, target}: where, and by which packages
    gates       [{gate, state, says}]: state is "passed", "failed" or "skipped"
    findings    [{gate, verdict, name, what, was, now, says, rows}]: verdict is "regression", "change" or "improvement"
    benchmarks  [{name, what, base, head, time, same_code}]: base and head as in measurement.py, or null

    judgements  [{name, said: [{text, page, fault}], beside, is_lost}]: of a user's laws, as `bench judge` says it

and of a benchmark that was timed `time` holds {ratio, low, high, p, rounds, verdict, confirmed}.
"""

from pathlib import Path
from typing import Any, NamedTuple

from bench.errors import BadResults
from bench.files import read_json, write_json
from bench.findings.judgement import Judgement, Said
from bench.regression.revisions import measurement
from bench.regression.revisions.measurement import Measurement

SCHEMA = "orientation-bench comparison 2"

EXACT, OPERATIONS, INSTRUCTIONS, TIME, FAULTS = "exact", "operations", "instructions", "time", "faults"

REGRESSION, CHANGE, IMPROVEMENT = "regression", "change", "improvement"
PASSED, FAILED, SKIPPED = "passed", "failed", "skipped"
SAME, SLOWER, FASTER = "same", "slower", "faster"


class Side(NamedTuple):
    """What was compared: a word for it, its commit ("" for none), and the digest of its sources."""

    name: str
    commit: str = ""
    sources: str = ""


class Gate(NamedTuple):
    """One gate, and in a line what came of it or why it was left out."""

    gate: str
    state: str
    says: str


class Finding(NamedTuple):
    """One thing that differs: of which law, what, from what to what; `says` is all of it in words.

    rows: how many rows say the same; the words name the first of them.
    """

    gate: str
    verdict: str
    name: str
    what: str
    was: str
    now: str
    says: str
    rows: int = 1


class Timed(NamedTuple):
    """Head over base: the median ratio of neighbouring rounds with its 95 % interval, and how sure it is.

    p: one-sided, of rounds as far apart or farther if both sides were equally fast. confirmed: what a second run of its
    own said of a first verdict other than "same"; None if there was none.
    """

    ratio: float
    low: float
    high: float
    p: float
    rounds: int
    verdict: str
    confirmed: bool | None = None


class Benchmark(NamedTuple):
    """A law or an engine on both sides; base or head is None where it is not there.

    same_code: both sides compile to the same machine code.
    """

    name: str
    what: str
    base: Measurement | None
    head: Measurement | None
    time: Timed | None = None
    same_code: bool = False


class Comparison(NamedTuple):
    """All that was compared, and what was found."""

    base: Side
    head: Side
    machine: dict[str, Any]
    gates: tuple[Gate, ...]
    findings: tuple[Finding, ...]
    benchmarks: tuple[Benchmark, ...]
    judgements: tuple[Judgement, ...] = ()

    @property
    def regressions(self) -> list[Finding]:
        """What must not be merged unseen."""
        return [one for one in self.findings if one.verdict == REGRESSION]

    def as_json(self) -> dict[str, Any]:
        """The object that this module describes."""
        return {"schema": SCHEMA, "verdict": REGRESSION if self.regressions else "clean", **_plain(self)}


def _plain(value: Any) -> Any:
    """Records as objects, and tuples of them as lists."""
    if isinstance(value, Measurement):
        return value.as_json()
    if isinstance(value, tuple) and hasattr(value, "_asdict"):
        return {name: _plain(one) for name, one in value._asdict().items()}
    return [_plain(one) for one in value] if isinstance(value, tuple) else value


def from_json(given: dict[str, Any]) -> Comparison:
    """The comparison that `as_json` wrote.

    Errors:
        BadResults: another schema.
    """
    if given.get("schema") != SCHEMA:
        raise BadResults(
            f"a comparison of schema '{given.get('schema')}'; this program reads '{SCHEMA}' (compare again: python -m "
            "bench compare)"
        )

    def measured(content: dict[str, Any] | None) -> Measurement | None:
        return measurement.from_json(content) if content else None

    return Comparison(
        Side(**given["base"]),
        Side(**given["head"]),
        given["machine"],
        tuple(Gate(**one) for one in given["gates"]),
        tuple(Finding(**one) for one in given["findings"]),
        tuple(
            Benchmark(
                one["name"],
                one["what"],
                measured(one["base"]),
                measured(one["head"]),
                Timed(**one["time"]) if one["time"] else None,
                one["same_code"],
            )
            for one in given["benchmarks"]
        ),
        tuple(
            Judgement(one["name"], tuple(Said(**each) for each in one["said"]), tuple(one["beside"]), one["is_lost"])
            for one in given["judgements"]
        ),
    )


def write(path: Path, comparison: Comparison) -> None:
    """The JSON file, whole or not at all."""
    write_json(path, comparison.as_json())


def read(path: Path) -> Comparison:
    """A comparison from its JSON file.

    Errors:
        BadResults: missing, no JSON, or another schema.
    """
    return from_json(read_json(path))
