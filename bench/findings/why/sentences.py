"""What the command field of a law says, in words: a sentence a finding, by the word that stands for it.

A fault is a sentence that names one. Dead points, and places where the command is no number, are none of a law whose
`property` is "almost global", which says as much: they are told.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
import pandas as pd


class Said(NamedTuple):
    """A sentence, the page that explains it, and the word of the fault that it names; empty if it names none."""

    text: str
    page: str
    fault: str = ""


GAINS, FRAMES, COORDINATES = "03-regulators", "01-problem-and-plant", "02-representations"
FAILURES, JUMPS, SIGNS, SIDE, ENDS = (
    "06-failure-map",
    "20-half-turn-noise",
    "25-libraries",
    "15-comparison",
    "30-method",
)

BETWEEN, WITH_MEMORY = "between", "with-memory"
WRONG = "Near the goal its stiffness is {value} kp"
SENTENCES = {
    ("goal", "pushes"): ("At the goal it does not rest: |u| is {value} kp {at_goal}.", FRAMES, "no rest at the goal"),
    ("goal", "no-number"): ("At the goal its command is no number, {at_goal}.", FAILURES, "singular goal"),
    ("stiffness", "as-set"): ("Near the goal its stiffness is {value} kp, as the gains say.", GAINS),
    ("stiffness", "half"): (f"Half gain. {WRONG}: a factor 2 is missing, as in 2 sin(theta/2).", GAINS, "half gain"),
    ("stiffness", "scaled"): (f"Wrong gain. {WRONG}.", GAINS, "wrong gain"),
    ("stiffness", "wrong-sign"): (f"Wrong sign. {WRONG}; R R_d^T in place of R_d R^T has it.", FRAMES, "wrong sign"),
    ("stiffness", "body-frame"): (
        f"Transposed, or in the body frame. {WRONG} R_d^T, as {{at_goal}}: R_d^T R and R^T R_d give a vector in the "
        "body's axes, and u is wanted in the base frame: multiply by R.",
        *(FRAMES, "body frame"),
    ),
    ("stiffness", "row-first"): (
        f"Row first. {WRONG} R_d^T, as {{at_goal}}: that of the transposed matrices. R has columns n, o, a: R[i][j] "
        "is row j of column i.",
        *(FRAMES, "row first"),
    ),
    ("stiffness", "turned-by-goal"): (f"Wrong frame. {WRONG} R_d, as {{at_goal}}.", FRAMES, "wrong frame"),
    ("stiffness", "none"): ("No stiffness: near the goal it does not pull.", GAINS, "no stiffness"),
    ("stiffness", "unbounded"): ("Near the goal its stiffness has no bound, {at_goal}.", COORDINATES, "singular goal"),
    ("stiffness", "uneven"): ("Stiffness differs by axis: {least} to {most} kp, {at_goal}.", GAINS, "uneven stiffness"),
    ("stiffness", "uneven-elsewhere"): ("Its stiffness is kp at R_d = I, {least} to {most} kp {at_goal}.", COORDINATES),
    ("damping", "as-set"): ("Its damping is {value} kv.", GAINS),
    ("damping", "none"): ("Undamped: its command does not depend on omega.", GAINS, "undamped"),
    ("damping", "wrong-sign"): ("Its damping has the wrong sign, {value} kv: it drives.", GAINS, "wrong damping"),
    ("damping", "uneven-elsewhere"): ("Its damping is kv at R_d = I, {least} to {most} kv {at_goal}.", COORDINATES),
    ("damping", "*"): ("Its damping is {what}: {least} to {most} kv, {at_goal}.", GAINS, "wrong damping"),
    ("small-error", "does-not-decay"): ("A small error decays at {value} 1/s at the least.", GAINS, "no decay"),
    ("dead-half-turns", "*"): (
        "Dead points: {set}; |u| is at most {value} kp. Shown by {state}, where u = {u}.",
        *(FAILURES, "dead points"),
    ),
    ("dead-half-turns", BETWEEN): (
        "Dead points between its two sides: {set}; |u| is at most {value} kp. Shown by {state}, where u = {u}. A "
        "sign(0) that is 0 does this; take 1.",
        *(SIGNS, "sign(0)"),
    ),
    ("no-number-half-turns", "*"): ("Its command is no number at {set}. Shown by {state}.", FAILURES, "dead points"),
    ("dead-elsewhere", "some"): (
        "Dead points off the half turns: {found} of {of} searches end at one. Shown by {state}, where u = {u}.",
        *(FAILURES, "dead points"),
    ),
    ("jump-goal", "*"): ("It jumps by {value} kp at the goal itself.", SIGNS, "jump at the goal"),
    ("jump-half-turns", "jump"): (
        "It jumps by {value} kp at half turns, as {state}: without memory a law jumps or has dead points (Bhat and "
        "Bernstein 2000), and noise can hold it at a jump.",
        JUMPS,
    ),
    ("jump-half-turns", WITH_MEMORY): (
        "From its initial memory it jumps by {value} kp at half turns, as {state}.",
        JUMPS,
    ),
    ("jump-half-turns", "unbounded"): ("Towards half turns its command grows without bound, as at {state}.", FAILURES),
    ("jump-elsewhere", "unbounded"): ("Its command is no number, or unbounded, as at {state}.", FAILURES, "no number"),
    ("jump-elsewhere", "*"): ("It jumps by {value} kp off the half turns too, as at {state}.", COORDINATES),
    ("away", "none"): ("At rest it never pulls away from the goal ({of} states tried).", SIDE),
    ("away", "some"): ("At rest it pulls away from {found} of {of} states, most ({most} kp) from {state}.", SIDE),
    ("away", "everywhere"): ("At rest it pulls away from all {of} states tried, as {state}.", FRAMES, "pulls away"),
    ("away", "the-long-way"): ("The long way round: at rest it pulls away from all {of} states.", SIDE, "unwinding"),
    ("pull-30", "swapped"): (
        "Exchanged arguments of atan2: it pulls as pi - theta or pi/2 - theta does, {value} kp at 30 deg.",
        *(SIGNS, "swapped atan2"),
    ),
    ("carried", "turns-back"): ("Turned past a half turn it keeps its side for {value_deg} deg.", SIDE),
    ("carried", "unwinds"): ("Unwinding: turned past a half turn it pulls back all the way.", SIDE, "unwinding"),
    ("rest", "quiet"): ("It ends quietly: its command changes by {value} kp a tick.", ENDS),
    ("rest", "chatters"): (
        "It chatters: within {least} rad of the goal its command changes by {value} kp a tick, in {found} of {of} "
        "episodes, as from {state}.",
        *(ENDS, "chatter"),
    ),
    ("rest", "moves"): (
        "It oscillates: after 3 s its speed is {speed} rad/s, in {found} of {of} episodes, as from {state}.",
        *(ENDS, "oscillation"),
    ),
    ("rest", "late"): ("After 3 s {found} of {of} episodes still move, as from {state} at {speed} rad/s.", ENDS),
    ("rest", "breaks-off"): ("Within 3 s {found} of {of} episodes broke off, as from {state}.", FAILURES),
}
"""(finding, what) -> sentence, page, and the fault if it is one; * is any other word that says there is something."""

SETS = {"every": "every half turn ({found} of {of} axes tried)", "plane": "half turns about axes in one plane"}
SETS |= {f"plane-{axis}": f"half turns about axes normal to {axis}" for axis in "xyz"}


def sentences(rows: pd.DataFrame, kp: float, declared: str) -> list[Said]:
    """What the field of one law says.

    Args:
        rows: of it, of command-field.parquet. declared: the law's `property`.
    """
    said = []
    for row, (finding, what) in zip(rows.to_dict("records"), _in_context(rows), strict=True):
        known = SENTENCES.get((finding, what)) or SENTENCES.get((finding, "*" if what != "none" else ""))
        if known is not None:
            text, page, *fault = known
            is_declared = fault == ["dead points"] and declared == "almost global"
            said.append(Said(text.format(**_words(row, kp)), page, *([] if is_declared else fault)))
    return said


def _in_context(rows: pd.DataFrame) -> list[tuple[str, str]]:
    """Findings and their words, of which some mean another thing beside others."""
    whats = dict(zip(rows["finding"].astype(str), rows["what"].astype(str), strict=True))
    if whats.get("jump-half-turns") == "jump":
        if whats["dead-half-turns"] != "none" and whats["no-number-half-turns"] == "none":
            whats["dead-half-turns"] = BETWEEN
        if whats["carried"] != "no-memory":
            whats["jump-half-turns"] = WITH_MEMORY
    return list(whats.items())


def _words(row: dict, kp: float) -> dict[str, str]:
    """What a sentence may name."""
    found, of, what = row["found"], row["of"], str(row["what"])
    goal = tuple(row[f"goal_quat_{part}"] for part in "wxyz")
    numbers = {name: f"{row[name] + 0.0:.3g}" for name in ("value", "least", "most")}
    return {
        **numbers,
        "what": what,
        "value_deg": f"{math.degrees(row['value']):.0f}",
        "speed": f"{row['most'] * math.sqrt(kp):.2g}",
        "found": f"{found:,}",
        "of": f"{of:,}",
        "set": SETS.get(what, "{found} of {of} half turns tried").format(found=found, of=of),
        "at_goal": "at R_d = I" if goal[0] == 1.0 else f"at R_d = {vector(goal)} (w x y z)",
        "state": state([row[f"quat_{part}"] for part in "wxyz"]),
        "u": f"{vector([row[f'u_{axis}'] for axis in 'xyz'])} rad/s²",
    }


def state(quat_wxyz) -> str:
    """An orientation as a turn from the goal I: its angle and axis."""
    w, *v = np.array(quat_wxyz) * (1.0 if quat_wxyz[0] >= 0.0 else -1.0)
    size = float(np.linalg.norm(v))
    angle = math.degrees(2.0 * math.atan2(size, w))
    return f"{angle:.7g} deg about {vector(np.array(v) / size if size else v)}"


def vector(numbers) -> str:
    """Some numbers in brackets."""
    return f"({', '.join(f'{number + 0.0:.4g}' for number in numbers)})"
