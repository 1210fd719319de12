"""The paper's eight conclusions, and what a run says of each: a word from its claims, and one number with its interval.

The word of a conclusion is the weakest word of its claims, in the order of `Word`: a conclusion holds if all that it
rests on holds. If the run cannot decide one of its claims, the conclusion is not tested.
"""

from __future__ import annotations

import functools
import math
import tomllib
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from bench.base.errors import NoEvidence, NoTable
from bench.experiments.tables.run import Run
from bench.experiments.tables.statistics import Estimate
from bench.findings import replication
from bench.findings.answer import attribute, find_answer
from bench.findings.claims import judge_possible
from bench.findings.claims.adequacy import PAPERS, THREE
from bench.findings.claims.performance import feedback_gain
from bench.findings.claims.verdict import Word
from bench.findings.failure_places import describe_failures
from bench.findings.kept import keep
from bench.findings.selection.words import together

MATRIX, LINEARIZED, FEEDBACK = THREE


class Conclusion(NamedTuple):
    """One of the paper's eight conclusions, and what a run says of it.

    quote: the paper's words, and short: some of them. claims: what it rests on. verdict: the weakest word of these.
    finding: what came out, in a sentence with one number. subject: what a figure or a page of it is called.
    """

    name: str
    quote: str
    section: str
    short: str
    claims: tuple[str, ...]
    verdict: str
    finding: str
    subject: str


@functools.cache
def read_texts() -> dict[str, dict[str, Any]]:
    """Return what conclusions.toml says, by the name of the conclusion."""
    text = Path(__file__).with_suffix(".toml").read_text(encoding="utf-8")
    return {
        name: {**said, "quote": " ".join(said["quote"].split())}
        for name, said in tomllib.loads(text).items()
    }


def conclude(run: Run) -> list[Conclusion]:
    """Return the conclusions in the paper's order, judged on a run."""
    verdicts, _ = judge_possible(run)
    words = {verdict.id: verdict.word for verdict in verdicts}
    if run.is_as_stored:
        findings = keep(run.folder, "conclusions", lambda: find_all(run))
    else:
        findings = find_all(run)
    return [
        Conclusion(
            name=name,
            quote=text["quote"],
            section=text["section"],
            short=text["short"],
            claims=tuple(text["claims"]),
            verdict=str(weakest_word(words, text["claims"])),
            finding=findings[name],
            subject=text["subject"],
        )
        for name, text in read_texts().items()
    ]


def weakest_word(words: Mapping[str, Word], claims: Sequence[str]) -> Word:
    """Return the weakest word of some claims; UNTESTED if one of them has none."""
    if any(claim not in words for claim in claims):
        return Word.UNTESTED
    return max((words[claim] for claim in claims), key=list(Word).index)


def find_all(run: Run) -> dict[str, str]:
    """Return the sentence of every conclusion; one that begins with 'Not tested' where the run lacks its rows."""
    return {name: _find_or_say(FINDINGS[name], run) for name in read_texts()}


def _find_or_say(find: Callable[[Run], str], run: Run) -> str:
    try:
        return find(run)
    except (NoEvidence, NoTable) as error:
        return f"Not tested: {str(error).partition(': ')[0]}."


def interval(number: Estimate, form: str = ".2f", unit: str = "") -> str:
    """Write a number with its 95 % interval: "1.68 s (1.56 to 1.93 s)"."""
    ends = [_write(end, form, unit) for end in (number.low, number.high)]
    return f"{_write(number.value, form, unit)} ({ends[0].removesuffix(unit)} to {ends[1]})"


def _write(value: float, form: str, unit: str) -> str:
    return f"{value:{form}}{unit}" if math.isfinite(value) else "never"


def percents(share: Any) -> str:
    """Write a share with its 95 % interval in per cent: "93.1 % (91.4 to 94.5 %)"."""
    return f"{100 * share.value:.3g} % ({100 * share.low:.3g} to {100 * share.high:.3g} %)"


def _rows_of(run: Run, law: str) -> Any:
    rows = replication.starts_at_rest(run)
    return rows[rows["contender"].astype(str) == law]


def _fails_at(run: Run, law: str, subject: str) -> str:
    places = describe_failures(_rows_of(run, law))
    starts = [f"from {name_starts(place)}" for place in places]
    return (
        f"{subject} fails {together(starts, len(starts))}"
        if starts
        else f"{subject} settles from every start"
    )


def name_starts(place: str) -> str:
    """Name the starts at a place of `describe_failures`: "starts at gimbal lock", "starts at 177° or more"."""
    words = place.replace(" deg", "°")
    if words.startswith("some "):
        return words.replace("some", "some starts", 1)
    if words.startswith("from "):
        return f"starts at {words.removeprefix('from ').removesuffix(' on')} or more"
    if words.startswith("|"):
        return f"starts with an Euler angle {words}"
    if words.startswith("exactly "):
        return f"starts {words} away from the goal"
    return f"starts {words}" if words.startswith("near ") else f"starts at {words}"


def _find_matrix(run: Run) -> str:
    settling = replication.measure_settling(_rows_of(run, MATRIX))
    fails = _fails_at(run, MATRIX, "The rotation-matrix law")
    if math.isinf(settling.nearly_all.value):
        return f"{percents(settling.share)} of the random starts settle. {fails}."
    time = interval(settling.nearly_all, unit=" s")
    return f"99 % of the random starts settle within {time}. {fails}."


def _find_linearized(run: Run) -> str:
    settling = replication.measure_settling(_rows_of(run, LINEARIZED))
    fails = _fails_at(run, LINEARIZED, "The linearized law")
    return f"{percents(settling.share)} of the random starts settle. {fails}."


def _find_feedback(run: Run) -> str:
    gain, gains = feedback_gain(run), run.gains()
    return (
        "With the rotation-matrix law, the time in which 99 % of the starts settle is "
        f"{interval(gain)} times the time with feedback linearization, at kp = {gains.kp:g} and "
        f"kv = {gains.kv:g}. {_fails_at(run, FEEDBACK, 'Feedback linearization')}."
    )


def _find_cost(run: Run) -> str:
    examined = replication.examine_laws(run)
    ratio = replication.time_over(examined.ledger, FEEDBACK, MATRIX)
    if ratio is None:
        raise NoEvidence("no law of the paper was timed: run bench time")
    return (
        f"A control step of feedback linearization takes {interval(ratio, '.1f')} times as long "
        "as a step of the rotation-matrix law. "
        f"{_name_answers(examined, 'cost less and perform better than both laws of Murphy on Euler angles')}"
    )


def _find_no_regulator(run: Run) -> str:
    examined, gains = replication.examine_laws(run), run.gains()
    if MATRIX not in examined.laws:
        raise NoEvidence(f"{MATRIX} did not run from the starts that the claim needs")
    pace = examined.laws[MATRIX].pace
    slower = Estimate(*(time / examined.small_s for time in pace))
    return (
        "With the cheapest law, rotation matrix, the time in which 99 % of the starts settle is "
        f"{interval(slower, '.1f')} times the settling time of a small error, at kp = "
        f"{gains.kp:g} and kv = {gains.kv:g}. "
        f"{_name_answers(examined, 'are adequate in both cost and performance')}"
    )


def _find_jacobian(run: Run) -> str:
    both = replication.compare_jacobians(run)
    harder = Estimate(*(float(f"{ratio:.2g}") for ratio in both.harder))
    return (
        f"When an arm passes gimbal lock, the Euler Jacobian needs {interval(harder, 'g')} times "
        f"the peak torque of the geometric Jacobian. This is the median of {both.moves} moves of "
        f"{both.arms} arms."
    )


def _find_compliance(run: Run) -> str:
    wrong = replication.measure_wrong_axis(run)
    return (
        f"If two axes comply and the end effector is tilted by β = {wrong.tilt_deg:.0f}°, the end "
        f"effector turns about an axis that is {wrong.middle:.0f}° away from the axis of the "
        f"moment ({wrong.off[0]:.0f}° to {wrong.off[-1]:.0f}° on {len(wrong.off)} arms)."
    )


def _find_answers(run: Run) -> str:
    examined, advised = replication.examine_laws(run), find_answer().law
    if advised not in examined.laws:
        untested = f"The advised law, {advised}, was not tested in this run."
        return f"{_name_answers(examined, 'pass all our tests of a better regulator')} {untested}"
    settling = replication.measure_settling(_rows_of(run, advised))
    failed = f" The advised law fails a test: {examined.tested[advised]}."
    passes = "" if advised in examined.answers else failed
    return (
        f"{_name_answers(examined, 'pass all our tests of a better regulator')}{passes} "
        f"The law {advised} settles from {percents(settling.share)} of the random starts."
    )


def _name_answers(examined: replication.ExaminedLaws, what: str) -> str:
    """Name the later laws that pass all tests of C27, the advised one first, and whose they are."""
    advised = find_answer().law
    names = sorted(examined.answers, key=lambda name: name != advised)
    if not names:
        is_open = any(one.may_pass for name, one in examined.tested.items() if name not in PAPERS)
        return (
            "Whether a later law passes every test is not tested."
            if is_open
            else "No later law passes every test."
        )
    laws = together([f"{name} ({attribute(name)})" for name in names])
    return (
        f"These later laws {what}: {laws}."
        if len(names) > 1
        else f"One later law passes every test: {laws}."
    )


FINDINGS: dict[str, Callable[[Run], str]] = {
    "rotation-matrix": _find_matrix,
    "linearized-euler": _find_linearized,
    "feedback-linearized": _find_feedback,
    "cost": _find_cost,
    "no-regulator": _find_no_regulator,
    "euler-jacobian": _find_jacobian,
    "compliance": _find_compliance,
    "open-question": _find_answers,
}
"""The sentence of each conclusion: finds it in a run; NoEvidence or NoTable: the run lacks its rows."""
