"""Write a comparison in words: a headline, a table of times, and Markdown for a pull request."""

import html
from collections.abc import Sequence
from typing import Any

from bench.base.provenance import cpu_name, describe
from bench.findings.judgement import Judgement
from bench.regression.revisions.comparison import Comparison
from bench.regression.revisions.timing import Timed

SHOWN = 40  # findings that a summary lists


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
    lines += [f"- {escape(each.text)} ({each.page})" for each in sorted(one.said, key=lambda each: not each.fault)]
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
