"""Answer an arm user in N m/rad: the inertia felt, the damping, the stable range and the law.

K [N m/rad] and D [N m s/rad] act on the tool's orientation, and no inertia is shaped
(`felt_inertia`). About an axis of inertia J that is the loop of `sampled_loop` with kp = K/J and kv
= D/J. Such a loop is stable if D > K (delay + half a period), about, and if J is more than some
least inertia. So the smallest inertia of the workspace decides, and what is stable there is stable
in every pose that was drawn.

The law is that of `advise` at both ends of the range of kp: for a body whose lightest axis is the 5
% of all inertias, and for a body whose heaviest axis is the 95 %. Their unevenness is that of the
median pose, and at most the map's.

Limitations: the damping of the position, if it is high, lowers the limits. A bound is of the tool's
torque.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from bench.findings.selection.advice import SEED, Advice, Trials, advise
from bench.findings.selection.felt_inertia import Felt, feel
from bench.findings.selection.regions import Rule
from bench.findings.selection.tool_chain import ToolChain, load_arm
from bench.findings.theory.sampled_loop import FACTOR, SampledLoop, is_stable, last_stable
from tasks.situation import COORDINATES, Situation, rounded

ZETA = 1.0
"""The damping ratio that is designed for: no overshoot."""

MARGIN = 2.0
"""A constant D is at most the greatest stable one over this: a gain margin of 6 dB."""

FIRST, MOST = 256, 1024
"""Starts of every law, and of those that may be advised: a quarter of `advice`, for two ends."""

DECADES = 1e9
"""Up to so many times a low value limits are looked for; each is a thousand times less."""

CANDIDATES = 120
"""Values of D among which a stable one is looked for."""

MOST_UNEVEN = max(COORDINATES["unevenness"].levels)

SHORTEST = min(COORDINATES["period"].levels)
"""The map's shortest period [1/sqrt(kp)]: a shorter one is hardly different, and becomes this."""


class ArmQuestion(NamedTuple):
    """What the user says.

    stiffness: K [N m/rad]. damping: D [N m s/rad], None if the answer is to propose it. torque: greatest torque
    on the tool [N m]. period, delay: of the control [s]. spin: speed at the start [rad/s]. jump:
    when the goal jumps [s], 0: never.
    """

    stiffness: float
    damping: float | None = None
    torque: float = math.inf
    period: float = 1e-3
    delay: float = 0.0
    spin: float = 0.0
    jump: float = 0.0

    @property
    def lateness(self) -> float:
        """Return the mean age [s] of a command: the delay and half a period."""
        return self.delay + 0.5 * self.period

    def loop_about(self, inertia: float, damping: float) -> SampledLoop:
        """Return the loop about an axis, with K and D in place of kp and kv."""
        return SampledLoop(self.stiffness, damping, self.period, self.delay, inertia)

    def design(self, inertia: float) -> float:
        """Return D of the ratio ZETA about an axis: 2 zeta sqrt(K J)."""
        return 2.0 * ZETA * math.sqrt(self.stiffness * inertia)

    def ratio(self, inertia: float, damping: float) -> float:
        """Return the damping ratio D/(2 sqrt(K J)) about an axis."""
        return 0.5 * damping / math.sqrt(self.stiffness * inertia)


class Range(NamedTuple):
    """What is stable in every pose that was drawn; NaN where nothing is.

    low, high: between these D at the user's K. stiffness: below this K at the damping D that is
    used. designed: below this K with D = 2 zeta sqrt(K Lambda) of each pose.
    """

    low: float
    high: float
    stiffness: float
    designed: float


class Body(NamedTuple):
    """A free body for the tool: mean inertia [kg m^2], kp [1/s^2], kv [1/s], situation."""

    inertia: float
    kp: float
    kv: float
    at: Situation


class StiffnessEnd(NamedTuple):
    """One end of the range of kp, and what is advised there."""

    body: Body
    advice: Advice


class ArmAnswer(NamedTuple):
    """All numbers of the answer.

    damping: the constant D that is used or proposed, NaN if none is stable. motors: the smallest
    inertia felt with the least and the greatest motor inertia of the arm's file; None if it states
    none. is_stable: whether every pose is stable with K and D, or, where no D was given, with D set
    pose by pose.
    """

    question: ArmQuestion
    chain: ToolChain
    felt: Felt
    motors: tuple[float, float] | None
    damping: float
    limits: Range
    is_stable: bool
    light: StiffnessEnd
    heavy: StiffnessEnd


def find_range(question: ArmQuestion, inertia: float, damping: float) -> Range:
    """Return what is stable about an axis of this inertia."""
    low, high = find_dampings(question, inertia)
    greatest = math.nan
    if not math.isnan(damping):
        at_damping = question.loop_about(inertia, damping)
        # A stable K is less than D over the lateness, about; far below, the damper is alone.
        first = 1e-6 * damping / question.lateness
        greatest = _rise(lambda kp: at_damping._replace(kp=kp), first)
    designed = question.loop_about(inertia, question.design(inertia))
    slow = 1e-3 * inertia / question.lateness
    return Range(low, high, greatest, designed.with_kv(_rise(designed.with_kv, slow)).kp)


def _rise(changed: Callable[[float], SampledLoop], first: float) -> float:
    """Return the value up to which a loop is stable, from a low one on; NaN if that is not."""
    return last_stable(changed, first, FACTOR, DECADES * first)


def find_dampings(question: ArmQuestion, inertia: float) -> tuple[float, float]:
    """Return the least and the greatest D with which an axis is stable at K; NaN if none is.

    The least is about K (delay + half a period), and the greatest of the order of J over that time.
    """
    lateness = question.lateness
    first, last = 0.5 * question.stiffness * lateness, 4.0 * inertia / lateness

    def damped(damping: float) -> SampledLoop:
        return question.loop_about(inertia, damping)

    for damping in np.geomspace(first, max(last, 2.0 * first), CANDIDATES):
        if is_stable(damped(float(damping))):
            low = last_stable(damped, float(damping), 1.0 / FACTOR, float(damping) / DECADES)
            return low, _rise(damped, float(damping))
    return math.nan, math.nan


def answer_arm(
    question: ArmQuestion,
    chain: ToolChain,
    arm: str | None = None,
    rule: Rule | None = None,
    is_whole: bool = False,
    report: Callable[[str], None] = lambda law: None,
) -> ArmAnswer:
    """Answer a question; arm: the name of the chain, if it is of this repository."""
    felt = feel(chain)
    damping = question.damping
    if damping is None:
        damping = propose_damping(question, felt)
    used = question.design(felt.least) if question.damping is None else damping
    ends = []
    for body in find_bodies(question, felt):
        trials = Trials(body.at, SEED, report, FIRST, MOST)
        advice = advise(body.at, rule or Rule(), is_whole, SEED, report, trials=trials)
        ends.append(StiffnessEnd(body, advice))
    light, heavy = ends
    return ArmAnswer(
        question=question,
        chain=chain,
        felt=felt,
        motors=feel_motors(arm) if arm and chain.motors else None,
        damping=damping,
        limits=find_range(question, felt.least, damping),
        is_stable=is_stable(question.loop_about(felt.least, used)),
        light=light,
        heavy=heavy,
    )


def propose_damping(question: ArmQuestion, felt: Felt) -> float:
    """Return a constant D: of the ratio ZETA about heavy axes if light ones bear it.

    NaN if no D is stable. Where MARGIN would leave the stable range, D is the middle of the range.
    """
    low, high = find_dampings(question, felt.least)
    if math.isnan(low):
        return math.nan
    damping = min(high / MARGIN, question.design(felt.ends[1]))
    return damping if damping > low else math.sqrt(low * high)


def feel_motors(arm: str) -> tuple[float, float]:
    """Return the smallest inertia felt with the least and the greatest motors of an arm's file."""
    least, greatest = (feel(load_arm(arm, f"motors-{word}")).least for word in ("low", "high"))
    return least, greatest


def find_bodies(question: ArmQuestion, felt: Felt) -> tuple[Body, Body]:
    """Return the lightest and the heaviest body for which `advise` chooses a law.

    With the unevenness s, a body of mean inertia J has moments from (1 - s) J to (1 + s) J.
    """
    low, high = felt.ends
    uneven = min(felt.unevenness, MOST_UNEVEN, (high - low) / (high + low))
    light, heavy = low / (1.0 - uneven), high / (1.0 + uneven)
    return _find_body(question, light, uneven), _find_body(question, heavy, uneven)


def _find_body(question: ArmQuestion, inertia: float, uneven: float) -> Body:
    """Return a body of this mean inertia and unevenness, in the question's situation."""
    kp = question.stiffness / inertia
    root = math.sqrt(kp)
    damping = question.damping
    kv = 2.0 * ZETA * root if damping is None else damping / inertia
    at = Situation(
        zeta=0.5 * kv / root,
        bound=question.torque / question.stiffness,
        delay=question.delay * root,
        period=max(question.period * root, SHORTEST),
        inertia=1.0,
        unevenness=uneven,
        spin=question.spin / root,
        jump=question.jump * root,
    )
    return Body(inertia, kp, kv, rounded(at))
