"""What one comparison found, and in words: a headline, a table of times, and Markdown for a pull request."""

import html
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from bench.base.provenance import cpu_name, describe
from bench.findings.judgement import Judgement
from bench.findings.subjects import find_reading
from bench.regression.revisions.times import Timed

REGRESSION, CHANGE, IMPROVEMENT = "regression", "change", "improvement"
SHOWN = 40  # findings that a summary lists


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


@dataclass
class Comparison:
    """All that was compared, and what was found; files: of pytest-benchmark, if timed; measures: of a user's laws."""

    base: str
    head: str
    gates: list[Gate] = field(default_factory=list)
    findings: list[Finding] = field(default_factory=list)
    times: list[Timed] = field(default_factory=list)
    judgements: list[Judgement] = field(default_factory=list)
    files: list[dict[str, Any]] = field(default_factory=list)
    measures: list[dict[str, str]] = field(default_factory=list)

    @property
    def regressions(self) -> list[Finding]:
        """Return what must not be merged unseen."""
        return [one for one in self.findings if one.verdict == REGRESSION]

    def add(self, gates: Iterable[str], findings: list[Finding], what: str = "") -> None:
        """Add findings, and their gates: failed if one of its findings is a regression."""
        self.findings += findings
        for name in gates:
            found = [one for one in findings if one.gate == name]
            bad = sum(one.verdict == REGRESSION for one in found)
            says = f"{bad} regressions, {len(found) - bad} other changes" if found else "nothing differs"
            self.gates.append(Gate(name, "failed" if bad else "passed", f"{what}: {says}" if what else says))

    def fail(self, gate: str, says: str) -> None:
        """Add a gate that failed as a whole."""
        self.gates.append(Gate(gate, "failed", says))
        self.findings.append(Finding(gate, REGRESSION, "", says))

    def skip(self, gates: Iterable[str], says: str, state: str = "skipped") -> None:
        """Add gates at which nothing was compared."""
        self.gates += [Gate(name, state, says) for name in gates]


def write_headline(comparison: Comparison) -> str:
    """Return how many regressions there are, and of what against what."""
    count, others = len(comparison.regressions), len(comparison.findings) - len(comparison.regressions)
    what = "no regression" if not count else "1 regression" if count == 1 else f"{count} regressions"
    changes = f", {others} other change{'s' if others > 1 else ''}" if others else ""
    return f"{what}{changes}: {comparison.head} against {comparison.base}"


def tabulate_times(times: Sequence[Timed]) -> list[dict[str, str]]:
    """Return a line of text for each benchmark."""
    more = {True: ", twice", False: ", by a second run", None: ""}
    return [
        {
            "benchmark": one.name,
            "time, head / base": f"{one.ratio:.3f} [{one.low:.3f}, {one.high:.3f}]",
            "p": f"{one.p:.1g}",
            "verdict": one.verdict + more[one.confirmed],
        }
        for one in times
    ]


def write_markdown(comparison: Comparison) -> str:
    """Return the whole comparison as a job summary or a comment shows it."""
    found = comparison.findings
    lines = [f"### {escape(write_headline(comparison))}", ""]
    lines += [*_write_table(comparison.measures), ""] if comparison.measures else []
    lines += [line for one in comparison.judgements for line in (*_write_judgement(one), "")]
    for one in found[:SHOWN]:
        lines.append(f"- **{one.verdict}**: {escape(one.says)}")
        inner = "".join(f"<br>{escape(says)}" for says in one.more[:SHOWN])
        lines += [f"  <details><summary>the first rows</summary>{inner}</details>"] if inner else []
    lines += [f"- ... and {len(found) - SHOWN} more"] * (len(found) > SHOWN)
    lines += ["", "| gate | | |", "| --- | --- | --- |"]
    lines += [f"| {one.gate} | {one.state} | {escape(one.says)} |" for one in comparison.gates]
    if table := tabulate_times(comparison.times):
        lines += ["", "<details><summary>All times</summary>", "", *_write_table(table), "", "</details>"]
    return "\n".join([*lines, "", f"{escape(cpu_name())}, {describe()['cores']} cores.", ""])


def _write_judgement(one: Judgement) -> list[str]:
    """Return why a law does what it does, faults first, and the laws nearest to it."""
    lines = [f"**{escape(one.heading or one.name)}: {', '.join(one.faults) or 'no fault found'}**", ""]
    for each in sorted(one.sentences, key=lambda each: not each.fault):
        lines.append(f"- {escape(each.text)} ({find_reading(each.subject)})")
    if one.beside:
        lines += ["", "The laws nearest to it in pull at 90 degrees and median settling time:", ""]
        lines += _write_table(one.beside)
    return lines


def _write_table(table: Sequence[dict[str, Any]]) -> list[str]:
    lines = [f"| {' | '.join(table[0])} |", f"| {' | '.join('---' for _ in table[0])} |"]
    words = (["" if value is None else escape(str(value)) for value in row.values()] for row in table)
    return lines + [f"| {' | '.join(row)} |" for row in words]


def escape(text: str) -> str:
    """Return text that Markdown and HTML show as it is."""
    escaped = html.escape(" ".join(text.split()), quote=False)
    return "".join(f"\\{c}" if c in "|`*[]\\" else c for c in escaped)
