"""Lines on the paper's two Jacobians, on compliance, and on its claims."""

from collections import Counter

from bench.base.errors import NoEvidence, NoTable
from bench.cli.progress import progress
from bench.cli.summary.lines import ABOUT, HEAD, print_text, write_percent, write_ratio
from bench.experiments.tables.run import MAIN_ENGINE, Run
from bench.findings import replication
from bench.findings.claims import judge_possible
from bench.findings.claims.adequacy import THREE, tallied
from bench.findings.claims.controller_costs import BY_EULER, ON_MATRIX, controller_costs
from bench.findings.claims.verdict import Word

SIX_JOINTS = 6


def holds_papers_laws(run: Run) -> bool:
    """Tell whether a run has the paper's three laws from uniform starts on the continuous plant."""
    rows = run.table("episodes", engine=MAIN_ENGINE, start_set="uniform", arm="")
    return set(THREE) <= set(rows["contender"].astype(str))


def compare_jacobians(run: Run) -> list[str]:
    """Return the lines of both Jacobians past gimbal lock; none where a run has no such moves of arms."""
    try:
        both = replication.compare_jacobians(run)
    except (NoEvidence, NoTable):
        return []
    head = f"Jacobian, {both.arms} arm{'s' * (both.arms > 1)}"
    times = f"x {write_ratio(both.harder.value)} ({write_ratio(both.harder.low)}-{write_ratio(both.harder.high)})"
    lines = [
        f"{head:{HEAD}} {'fails past gimbal lock':24} {'peak torque / rated':24} {'ops':>7}"
    ]
    for name, controller, failed, torque in (
        ("geometric", ON_MATRIX, both.failed[0], write_ratio(both.torque[0])),
        ("Euler", BY_EULER, both.failed[1], f"{write_ratio(both.torque[1])}; {times}"),
    ):
        count = f"{failed or 'none'} of {both.moves} moves"
        lines.append(
            f"{name:{HEAD}} {count:24} {torque:24} {_count(run, controller):>7}"
        )
    return lines


def _count(run: Run, controller: str) -> str:
    """Write the flops and calls of a whole controller's step on six joints; a dash where they were not counted."""
    try:
        flops, calls = tallied(
            controller_costs(run, controller, SIX_JOINTS), with_goal=True
        )
    except (NoEvidence, NoTable):
        return "-"
    return f"{flops}+{calls}" if calls else str(flops)


def compare_compliance(run: Run) -> list[str]:
    """Return a sentence about two compliant axes and one about one; none where a run has no such poses."""
    sentences = []
    for describe in (_describe_two_axes, _describe_one_axis):
        try:
            sentences.append(describe(run))
        except (NoEvidence, NoTable):
            continue
    return sentences


def _describe_two_axes(run: Run) -> str:
    wrong = replication.measure_wrong_axis(run)
    arms = f"{len(wrong.off)} arm{'s' * (len(wrong.off) > 1)}: {wrong.off[0]:.0f}-{wrong.off[-1]:.0f}"
    return f"Euler, two axes: turns {wrong.middle:.0f} deg off at beta = {wrong.tilt_deg:.0f} deg ({arms})"


def _describe_one_axis(run: Run) -> str:
    same = replication.count_single_axes(run)
    ends = f"{write_percent(same.low)}-{write_percent(same.high)}"
    return f"Euler, one axis: right axis at {same.k} of {same.n} poses, {write_percent(same.value)} % ({ends})"


def print_verdicts(run: Run) -> None:
    """Print how many claims have each word; it may take half a minute, once a run."""
    with progress("claims", "judging the paper's claims"):
        sentence = count_verdicts(run)
    print_text("His claims", sentence, indent=ABOUT)


IN_SHORT = {
    Word.HOLDS: ("holds", "hold"),
    Word.CORRECTED: ("holds with a correction", "hold with a correction"),
    Word.FAILS: ("does not", "do not"),
    Word.ANSWERED: (
        "was open in 1988 and is answered",
        "were open in 1988 and are answered",
    ),
    Word.DEPENDS: ("depends on the gains", "depend on the gains"),
    Word.READING: ("depends on how it is read", "depend on how they are read"),
    Word.UNTESTABLE: ("is not testable", "are not testable"),
    Word.UNTESTED: ("is not tested", "are not tested"),
}
"""A word after 1, and after other numbers."""


def count_verdicts(run: Run) -> str:
    """Say how many claims got each word, and how many cannot be judged."""
    decided, lacks = judge_possible(run)
    every = len(decided) + len(lacks)
    if not decided:
        return f"None of the paper's {every} claims can be judged from this run."
    counts = Counter(verdict.word for verdict in decided)
    parts = [
        f"{counts[word]} {IN_SHORT[word][counts[word] != 1]}"
        for word in Word
        if counts[word]
    ]
    if lacks:
        parts.append(f"{len(lacks)} cannot be judged from this run")
    return f"Of {every}, {', '.join(parts)} (bench claims)."
