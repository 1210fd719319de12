"""What one comparison found: gates, findings, times, and what `bench judge` says of a user's laws."""

from collections.abc import Iterable
from typing import Any, NamedTuple

from bench.findings.judgement import Judgement
from bench.regression.revisions.timing import Timed

REGRESSION, CHANGE, IMPROVEMENT = "regression", "change", "improvement"


class Gate(NamedTuple):
    """A gate; whether it passed, failed or was skipped; and in a line what came of it or why."""

    gate: str
    state: str
    says: str


class Finding(NamedTuple):
    """One thing that differs: found by which gate, of which law, and in words; more: what is folded into it."""

    gate: str
    verdict: str
    name: str
    says: str
    more: tuple[str, ...] = ()


class Comparison(NamedTuple):
    """All that was compared, and what was found.

    files: of pytest-benchmark, of base and head, if both were timed. measures: of a user's laws, see measures.py.
    """

    base: str
    head: str
    gates: tuple[Gate, ...]
    findings: tuple[Finding, ...]
    times: tuple[Timed, ...] = ()
    judgements: tuple[Judgement, ...] = ()
    files: tuple[dict[str, Any], ...] = ()
    measures: tuple[dict[str, str], ...] = ()

    @property
    def regressions(self) -> list[Finding]:
        """Return what must not be merged unseen."""
        return [one for one in self.findings if one.verdict == REGRESSION]


def make_gate(name: str, findings: Iterable[Finding], what: str = "") -> Gate:
    """Return the gate of these findings: failed if one of them is a regression."""
    found = [one for one in findings if one.gate == name]
    bad = sum(one.verdict == REGRESSION for one in found)
    says = f"{bad} regressions, {len(found) - bad} other changes" if found else "nothing differs"
    return Gate(name, "failed" if bad else "passed", f"{what}: {says}" if what else says)
