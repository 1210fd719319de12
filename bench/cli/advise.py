"""`advise`: the law to use at a user's gains, motors, timing and inertia, from the map of results/situations."""

from __future__ import annotations

import math
import re
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Any

import rich_click as click

from bench.base.on_first_use import pd
from bench.cli import options
from bench.cli.paragraphs import Paragraph, listed, print_paragraphs
from bench.cli.progress import progress
from bench.cli.screen import console, counted, examples, frame_table
from tasks.situation import NOMINAL, UNCANCELLED, rounded

if TYPE_CHECKING:
    from bench.findings.selection.regions import Answer, Rule
    from tasks.situation import Situation

UNITS = {"": 1.0, "s": 1.0, "ms": 1e-3, "us": 1e-6}
FORMS = re.compile(r"([+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?) *(|s|ms|us)")
TORQUES = ("torque", "torque-no-model")


def time(word: object) -> float:
    """Return the seconds of a time: a number of them, or one with a unit, as 5ms."""
    found = FORMS.fullmatch(str(word))
    seconds = float(found[1]) * UNITS[found[2]] if found else math.nan
    if not 0.0 <= seconds < math.inf:
        raise click.BadParameter(f"'{word}' is no time of at least 0 (try: 5ms or 0.005)")
    return seconds


POSITIVE = click.FloatRange(0.0, min_open=True)


@click.command("advise", epilog=examples("advise"))
@click.option("--kp", type=POSITIVE, default=100.0, show_default=True, help="Position gain over the inertia [1/s^2].")
@click.option("--kv", type=POSITIVE, default=20.0, show_default=True, help="Velocity gain over the inertia [1/s].")
@click.option("--bound", type=POSITIVE, default=math.inf, help="Greatest command [rad/s^2].", show_default="none")
@click.option("--delay", type=time, default=0.0, show_default=True, help="From measuring to the effect, as 5ms.")
@click.option("--rate", type=POSITIVE, default=1000.0, show_default=True, help="Control rate [Hz].")
@click.option("--spin", type=click.FloatRange(0.0), default=0.0, show_default=True, help="Speed at the start [rad/s].")
@click.option("--jump", type=time, default=0.0, show_default="none", help="When the goal jumps, after the start.")
@click.option("--inertia", type=POSITIVE, default=1.0, show_default=True, help="True inertia over the model's.")
@click.option(
    "--unevenness",
    type=click.FloatRange(0.0, 0.5),
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
@click.option("--run", "is_run", is_flag=True, help="Simulate this very situation (seconds) in place of the nearest.")
def COMMAND(
    kp: float, kv: float, bound: float, delay: float, rate: float, spin: float, jump: float, inertia: float,
    unevenness: float | None, robot: str, no_memory: bool, continuous: bool, no_adversary: bool, is_run: bool,
) -> None:  # fmt: skip
    """Say which law to use in your situation, which laws tie with it, and how sure that is.

    The answer comes from the nearest of the situations that were simulated (results/situations), or with --run from
    yours. Laws that settle from every start without unwinding, and that noise cannot trap at 180°, are compared by the
    time in which 99 % of the starts settle; the simplest of those that nothing beats is advised. A law of ours is
    compared, not advised.
    """
    if robot not in TORQUES:
        print_paragraphs(_of_other_robot(robot))
        return
    from bench.findings.selection.regions import Rule, answer

    if unevenness is None:
        unevenness = (UNCANCELLED if robot == TORQUES[1] else NOMINAL).unevenness
    root = math.sqrt(kp)
    own = kv / (2.0 * root), bound / kp, delay * root, root / rate, inertia, unevenness, spin / root, jump * root
    wanted = rounded(own)
    rule = Rule(adversary=not no_adversary, forgetful=no_memory, continuous=continuous)
    if is_run:
        found = _simulated(wanted, rule)
    else:
        with console(stderr=True).status("reading the map"):
            found = answer(wanted, rule)
    print_paragraphs(*_said(found, wanted, kp))
    console().print(frame_table(_table(found, kp), "\nLaws in that situation, the fastest first"))


def _of_other_robot(robot: str) -> Paragraph:
    """Say what is advised where a robot takes velocities or positions, by the run that came with the benchmark."""
    from bench.findings.selection.robots import ROBOTS, decide_for

    one = ROBOTS[robot]
    found = decide_for(one, options.REFERENCE)
    if found is None or found.law is None:
        return Paragraph("Which law", (f"No law of results/reference is advised where a robot takes {one.takes}.",))
    tied = f", tied with {listed(found.tied)}" if found.tied else ""
    said = (
        f"Use {found.law}{tied}. Your robot takes {one.takes}; compared were {counted(len(found.asked), 'law')} "
        f"({one.rows}). Gains, bound and timing do not enter here: laws of first order have one gain, and its time "
        "scale is 1/K."
    )
    return Paragraph("Which law", (said,))


def _simulated(wanted: Situation, rule: Rule) -> Answer:
    from bench.experiments.situations import mapped_laws, plan_of
    from bench.experiments.tables.store import read
    from bench.findings.selection.regions import Answer, decide, with_words
    from bench.running import run

    with tempfile.TemporaryDirectory(prefix="orientation-bench-") as name, progress("laws") as steps:
        plan, done = plan_of((one, wanted) for one in mapped_laws()), []

        def report(unit: Any) -> None:
            done.append(unit)
            steps.now(unit.label, len(done), len(plan.units))

        run.run(plan, Path(name) / "run", report=report)
        rows = with_words(read(Path(name) / "run", "situations"))
    return Answer(wanted, decide(rows, rule), rows, 0.0, None)


def _said(found: Answer, wanted: Situation, kp: float) -> list[Paragraph]:
    one, unit = found.verdict, math.sqrt(kp)
    if one.law is None:
        which = "No published or adapted law that was run meets the requirements; the table shows what fails."
    else:
        row = found.rows[found.rows["contender"] == one.law].iloc[0]
        tied = f" It ties with {listed(one.tied)}." if one.tied else " Nothing ties with it."
        place = "" if found.distance == 0.0 else "In the nearest situation of the map "
        others = tied if one.asked > 1 else " No other law meets the requirements."
        which = (
            f"Use {one.law}.{others} {place}99 % of the starts settle in {row['time'] / unit:.3f} s "
            f"({row['time_low'] / unit:.3f} to {row['time_high'] / unit:.3f})."
        )
    lines = [Paragraph("Which law", (which,))]
    if one.ours:
        word = "is faster" if one.faster else "ties with it"
        lines.append(Paragraph("Ours", (f"{listed(one.ours)}, ours and not reviewed, {word}; see the table.",)))
    where = f"Your situation: {wanted.describe()}."
    if found.agree is None:
        return [*lines, Paragraph("How sure", (where, "It was simulated now."))]
    near = f"The nearest of the map: {found.at.describe()} (distance {found.distance:.2f})."
    near = near if found.distance else "It is in the map."
    agree = f"Nothing beats the law in {found.agree[0]} of the {found.agree[1]} situations next to it"
    return [*lines, Paragraph("How sure", (where, near, f"{agree}; --run simulates yours."))]


def _table(found: Answer, kp: float) -> pd.DataFrame:
    """Return the rows of laws with their numbers at the user's kp, and what each lacks."""
    from bench.findings.selection.regions import facts_of

    rows, unit = found.rows.sort_values(["time", "operations"]), math.sqrt(kp)
    lacks = ["; ".join(word for column, word in LACKS.items() if one[column]) for one in rows.to_dict("records")]
    ours = {law for law in rows["contender"] if facts_of(str(law)).is_ours}
    return pd.DataFrame(
        {
            "law": [f"{law} (ours)" if law in ours else str(law) for law in rows["contender"]],
            "99 % [s]": (rows["time"] / unit).map("{:.3f}".format),
            "peak [rad/s^2]": (rows["peak"] * kp).map("{:.4g}".format),
            "overshoot [deg]": rows["overshoot"].map("{:.1f}".format),
            "memory": [facts_of(str(law)).memory for law in rows["contender"]],
            "operations": rows["operations"],
            "lacks": lacks,
        }
    )


LACKS = {
    "lost": "loses starts",
    "stuck": "stuck at exact 180°",
    "unwound": "unwinds",
    "trapped": "trapped by noise at 180°",
}
"""Columns that count what a law must not do, in words."""
