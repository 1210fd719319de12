"""A comparison in words: a headline, a table of benchmarks, and Markdown for a pull request."""

import html
from collections.abc import Sequence
from typing import Any

from bench.findings.judgement import Judgement
from bench.regression.revisions.comparison import FASTER, REGRESSION, SAME, SLOWER, Benchmark, Comparison, Finding

SHOWN = 40
"""Findings that a summary lists; the JSON has all."""

UNTIMED = ""


def headline(comparison: Comparison) -> str:
    """How many regressions there are, and of what against what."""
    count, others = len(comparison.regressions), len(comparison.findings) - len(comparison.regressions)
    what = "no regression" if not count else "1 regression" if count == 1 else f"{count} regressions"
    changes = f", {others} other change{'s' if others > 1 else ''}" if others else ""
    return f"{what}{changes}: {comparison.head.name} against {comparison.base.name}"


def ordered(comparison: Comparison) -> list[Finding]:
    """Regressions first."""
    return sorted(comparison.findings, key=lambda one: one.verdict != REGRESSION)


def rows(comparison: Comparison) -> list[dict[str, str]]:
    """A line for each benchmark, all of it text."""
    return [
        {
            "benchmark": one.name,
            "time, head / base": _ratio(one),
            "p": f"{one.time.p:.1g}" if one.time else UNTIMED,
            "instructions": _pair(*(side and side.instructions for side in (one.base, one.head))),
            "flops": _pair(*(side and side.operations.get("worst", {}).get("flops") for side in (one.base, one.head))),
            "verdict": _verdict(one),
        }
        for one in comparison.benchmarks
    ]


def _ratio(one: Benchmark) -> str:
    if one.time:
        return f"{one.time.ratio:.3f} [{one.time.low:.3f}, {one.time.high:.3f}]"
    if one.head and one.head.kernel_steps and not one.base:
        return f"{one.head.kernel_steps.median:.3f} kernel steps"
    return UNTIMED


def _pair(was: float | None, now: float | None) -> str:
    """One number if it is the same on both sides."""
    said = ["none" if x is None else f"{x:.10g}" if float(x).is_integer() else f"{x:.1f}" for x in (was, now)]
    if was is None and now is None:
        return ""
    return said[0] if said[0] == said[1] else f"{said[0]} -> {said[1]}"


def _verdict(one: Benchmark) -> str:
    if one.base is None:
        return "new"
    if one.head is None:
        return "gone"
    if one.same_code and not one.time:
        return "same machine code"
    words = {SLOWER: "slower, twice", FASTER: "faster, twice", SAME: "same"}
    if one.time is None:
        return "not timed"
    doubted = one.time.verdict == SAME and one.time.confirmed is False
    return "same, by a second run" if doubted else words[one.time.verdict]


def markdown(comparison: Comparison) -> str:
    """The whole comparison, as a job summary or a comment shows it."""
    found = ordered(comparison)
    lines = [f"### {plain(headline(comparison))}", ""]
    lines += [line for one in comparison.judgements for line in (*_judgement(one), "")]
    lines += [f"- **{one.verdict}**: {plain(one.says)}" for one in found[:SHOWN]]
    lines += [f"- ... and {len(found) - SHOWN} more"] * (len(found) > SHOWN)
    lines += ["", "| gate | | |", "| --- | --- | --- |"]
    lines += [f"| {one.gate} | {one.state} | {plain(one.says)} |" for one in comparison.gates]
    if table := rows(comparison):
        lines += ["", "<details><summary>All benchmarks</summary>", "", *_table(table), "", "</details>"]
    machine = comparison.machine
    lines += ["", f"{plain(machine['cpu'])}, {machine['cores']} cores; compiled for {machine['target']}.", ""]
    return "\n".join(lines)


def _judgement(one: Judgement) -> list[str]:
    """Why a law does what it does, faults first, and the laws most like it."""
    said = sorted(one.said, key=lambda each: not each.fault)
    lines = [f"**{plain(one.name)}: {', '.join(one.faults) or 'no fault found'}**", ""]
    lines += [f"- {plain(each.text)} ({each.page})" for each in said]
    return lines + (["", "Beside the laws most like it:", "", *_table(one.beside)] if one.beside else [])


def _table(table: Sequence[dict[str, Any]]) -> list[str]:
    """Records of the same names."""
    lines = [f"| {' | '.join(table[0])} |", f"| {' | '.join('---' for _ in table[0])} |"]
    words = (["" if value is None else plain(str(value)) for value in row.values()] for row in table)
    return lines + [f"| {' | '.join(row)} |" for row in words]


def plain(text: str) -> str:
    """Text that Markdown and HTML leave as it is."""
    escaped = html.escape(" ".join(text.split()), quote=False)
    return "".join(f"\\{c}" if c in "|`*[]\\" else c for c in escaped)
