"""`advise`: the law to use at a user's gains, motors, timing and inertia: the map's laws, simulated there."""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING, Any, NamedTuple

import rich_click as click

from bench.cli import options
from bench.cli.arm_options import is_asked_of_arm, load_chain, read_question, take_arm_options
from bench.cli.paragraphs import Paragraph, listed, print_paragraphs
from bench.cli.progress import progress
from bench.cli.screen import console, counted, examples, frame_table
from tasks.situation import NOMINAL, UNCANCELLED, Situation, rounded

if TYPE_CHECKING:
    from bench.findings.selection.regions import Rule

UNITS = {"": 1.0, "s": 1.0, "ms": 1e-3, "us": 1e-6}
FORMS = re.compile(r"([+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?) *(|s|ms|us)")
LONGEST_S = 1000.0
"""The longest horizon of a run: what comes later is never seen."""

TORQUES = ("torque", "torque-no-model")


def time(word: object) -> float:
    """Return the seconds of a time: a number of them, or one with a unit, as 5ms."""
    found = FORMS.fullmatch(str(word))
    seconds = float(found[1]) * UNITS[found[2]] if found else math.nan
    if not 0.0 <= seconds <= LONGEST_S:
        raise click.BadParameter(f"'{word}' is no time from 0 to {LONGEST_S:g} s (try: 5ms or 0.005)")
    return seconds


BOUND = options.NumberOption(1e-9, 1e9, 30, infinite="no bound")
"""[rad/s^2]: the lowest turns a body by a radian in half a day, the highest is a thousand times the judge's limit."""

RATE = options.NumberOption(1e-3, 1e7, 1000)
"""[Hz]: the shortest control period of a run is a microsecond; a tick in more than 1000 s comes after every horizon."""

SPIN = options.NumberOption(0.0, 1e4, 1)
"""[rad/s]: the judge's speed limit, above which an orientation can no longer be followed at 1 kHz."""

INERTIA = options.NumberOption(1e-3, 1e3, 1)
"""True over assumed: a factor of a thousand is another robot."""

UNEVENNESS = options.NumberOption(0.0, 0.5, 0.3)
"""Above 0.5 the smallest of 1 - s, 1, 1 + s is less than the difference of the others, which no body has."""


@click.command("advise", epilog=examples("advise"))
@click.option("--kp", type=options.KP, default=100.0, show_default=True, help="Position gain over the inertia [1/s^2].")
@click.option("--kv", type=options.KV, default=20.0, show_default=True, help="Velocity gain over the inertia [1/s].")
@click.option("--bound", type=BOUND, default=math.inf, help="Greatest command [rad/s^2].", show_default="none")
@click.option("--delay", type=time, default=0.0, show_default=True, help="From measuring to the effect, as 5ms.")
@click.option("--rate", type=RATE, default=1000.0, show_default=True, help="Control rate [Hz].")
@click.option("--spin", type=SPIN, default=0.0, show_default=True, help="Speed at the start [rad/s].")
@click.option("--jump", type=time, default=0.0, show_default="none", help="When the goal jumps, after the start.")
@click.option("--inertia", type=INERTIA, default=1.0, show_default=True, help="True inertia over the model's.")
@click.option(
    "--unevenness",
    type=UNEVENNESS,
    show_default=f"0; {UNCANCELLED.unevenness:g} of torque-no-model",
    help="s of principal moments 1 - s, 1, 1 + s.",
)
@click.option(
    "--robot",
    type=click.Choice([*TORQUES, "velocity", "position"]),
    default="torque",
    show_default=True,
    help="What it takes: torque, a model cancelling the inertia or not; velocity; or position.",
)
@click.option("--no-memory", is_flag=True, help="Only laws that keep nothing from tick to tick.")
@click.option("--continuous", is_flag=True, help="Only laws whose command is continuous; 180° rotations hold them.")
@click.option("--no-adversary", is_flag=True, help="Do not ask that worst-case noise cannot trap the law at 180°.")
@click.option("--run", "is_run", is_flag=True, help="Simulate all laws, not only those that the map names.")
@take_arm_options
@click.pass_context
def COMMAND(context: click.Context, **_: Any) -> None:
    """Say which law to use in your situation, which laws tie with it, and what it costs.

    Closed forms come first: where every law is unstable, the answer is "No law", with the limits. The map of
    results/situations then names some laws, and these are simulated in your situation; outside the map, and with
    --run, all are. Laws that settle from every start without unwinding, and that noise cannot trap at 180°, are
    compared by the time in which 99 % of the starts settle; the map's law is advised unless another one is faster. A
    law of ours is compared, not advised. "No law" is an answer, too: the exit code is 0.

    For an arm, name it and its stiffness in place of kp: you get the inertia that the tool's orientation spring feels
    over the workspace, the damping to set, the stable range of K and D, bound over kp, and the law at both ends.
    """
    reply = find_reply(context)
    print_paragraphs(*reply.paragraphs)
    if getattr(reply.advice, "rows", None) is not None:
        from bench.cli.advised import table

        rows = table(reply.advice, context.params["kp"])
        heading = "\nLaws simulated in your situation, the fastest first"
        console().print(frame_table(rows, heading))


class Reply(NamedTuple):
    """What is answered.

    Attributes:
        paragraphs: The answer in words.
        advice: The numbers behind it: an Advice; of an arm an ArmAnswer; of a robot that takes velocities or positions
            a Decision, None if no law is advised.
    """

    paragraphs: list[Paragraph]
    advice: Any


def find_reply(context: click.Context) -> Reply:
    """Answer the question that the options of `advise` ask."""
    words = context.params
    if is_asked_of_arm(context):
        return _answer_arm(words)
    if words["robot"] not in TORQUES:
        return _answer_other_robot(words["robot"])
    from bench.cli.advised import paragraphs
    from bench.findings.selection.advice import advise

    rule = _rule_of(words)
    with progress("laws", "reading the map") as steps:
        advice = advise(
            read_situation(words),
            rule,
            words["is_run"],
            report=lambda law: steps.now(f"simulating {law}"),
        )
    return Reply(paragraphs(advice, words["kp"]), advice)


def read_situation(words: dict[str, Any]) -> Situation:
    """Return the situation that the options describe, in units of kp."""
    root = math.sqrt(words["kp"])
    unevenness = words["unevenness"]
    if unevenness is None:
        unevenness = (UNCANCELLED if words["robot"] == TORQUES[1] else NOMINAL).unevenness
    bound = math.inf if words["bound"] is None else words["bound"]
    numbers = (
        words["kv"] / (2.0 * root),
        bound / words["kp"],
        words["delay"] * root,
        root / words["rate"],
        words["inertia"],
        unevenness,
        words["spin"] / root,
        words["jump"] * root,
    )
    return rounded(numbers)


def _answer_arm(words: dict[str, Any]) -> Reply:
    """Answer a question about an arm."""
    from bench.cli.arm_answer import describe_arm
    from bench.findings.selection.arm_question import answer_arm

    with progress("laws", "reading the arm") as steps:
        answer = answer_arm(
            read_question(words),
            load_chain(words),
            arm=words["arm"],
            rule=_rule_of(words),
            is_whole=words["is_run"],
            report=lambda law: steps.now(f"simulating {law}"),
        )
    return Reply(describe_arm(answer), answer)


def _rule_of(words: dict[str, Any]) -> Rule:
    """Return what the law must have, by the options."""
    from bench.findings.selection.regions import Rule

    return Rule(
        adversary=not words["no_adversary"],
        forgetful=words["no_memory"],
        continuous=words["continuous"],
    )


def _answer_other_robot(robot: str) -> Reply:
    """Say what is advised where a robot takes velocities or positions, by the run that came with the benchmark."""
    from bench.findings.selection.robots import ROBOTS, decide_for

    kind = ROBOTS[robot]
    verdict = decide_for(kind)
    if verdict is None or verdict.law is None:
        text = f"No law of results/reference is advised where a robot takes {kind.takes}."
        return Reply([Paragraph("Which law", (text,))], None)
    tied = f", tied with {listed(verdict.tied)}" if verdict.tied else ""
    text = (
        f"Use {verdict.law}{tied}. Your robot takes {kind.takes}; {counted(verdict.eligible, 'law')} of "
        f"results/reference ({kind.rows}) meet the requirements, and were compared by the rule of the map. Gains, "
        "bound and timing do not enter here: laws of first order have one gain, and its time scale is 1/K."
    )
    return Reply([Paragraph("Which law", (text,))], verdict)
