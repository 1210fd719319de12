"""What `advise` prints of an arm, in the units of its user."""

from __future__ import annotations

import math

from bench.cli.advised import attribution, describe_outside
from bench.cli.paragraphs import Paragraph, listed
from bench.cli.screen import counted
from bench.findings.selection.arm_question import (
    MARGIN,
    ZETA,
    ArmAnswer,
    ArmQuestion,
    Body,
    StiffnessEnd,
)
from bench.findings.selection.felt_inertia import QUICKEST

NEAR_ONE = 0.995
"""A ratio that is written as 1 is not called under-damped."""


def describe_arm(answer: ArmAnswer) -> list[Paragraph]:
    """Return the paragraphs of an answer."""
    return [
        Paragraph("Arm", _describe_poses(answer)),
        Paragraph("Inertia", _describe_inertia(answer)),
        Paragraph("Damping", _describe_damping(answer)),
        Paragraph("Stable", _describe_limits(answer)),
        Paragraph("Bound", (_describe_bound(answer),)),
        Paragraph("Law", _describe_laws(answer)),
        Paragraph("How sure", _describe_evidence(answer)),
    ]


def write(number: float) -> str:
    """Write a number with three digits, thousands in groups: 48,500 in place of 4.85e+04."""
    return f"{float(f'{number:.3g}'):,g}"


def _describe_poses(answer: ArmAnswer) -> tuple[str, ...]:
    chain, felt = answer.chain, answer.felt
    joints = counted(len(chain.joints), "joint")
    poses = f"{felt.drawn:,} poses drawn in the joint ranges"
    text = f"{chain.title}, {joints} to {chain.effector}; {poses}"
    left_out = felt.drawn - len(felt.poses)
    if left_out:
        rule = f"a joint turns more than {QUICKEST:g} times as fast as the tool"
        text += f", less {left_out} where {rule}"
    return (f"{text}.",)


def _describe_inertia(answer: ArmAnswer) -> tuple[str, ...]:
    felt, stiffness = answer.felt, answer.question.stiffness
    low, high = felt.ends
    text = (
        f"{write(low)} to {write(high)} kg m² with the position free (5 to 95 % of poses and axes; least "
        f"{write(felt.least)})"
    )
    if felt.held_ends:
        text += ", {} to {} with it held".format(*map(write, felt.held_ends))
    sentences = [
        f"{text}. So kp = K/inertia is {write(stiffness / high)} to {write(stiffness / low)} 1/s²."
    ]
    if answer.motors:
        least, greatest = map(write, answer.motors)
        sentences.append(
            "The motors' inertia is a guess: with the range in the arm's file the least is "
            f"{least} to {greatest}."
        )
    elif not answer.chain.has_motor_inertia:
        sentences.append(
            "A joint of the file has no motor inertia (armature): with it, this and the limits are "
            "greater."
        )
    return tuple(sentences)


def _describe_damping(answer: ArmAnswer) -> tuple[str, ...]:
    question, damping = answer.question, answer.damping
    low, high = answer.felt.ends
    ends = f"{write(question.design(low))} to {write(question.design(high))}"
    design = (
        f"D = 2 √(K Λ) pose by pose (double diagonalization): {ends} N m s/rad, ratio {ZETA:g}."
    )
    if math.isnan(damping):
        return (design,)
    heavy, light = question.ratio(high, damping), question.ratio(low, damping)
    whose = "Your" if question.damping else "A constant"
    text = f"{whose} D of {write(damping)} has {heavy:.2g} about heavy axes"
    if heavy < NEAR_ONE:
        text += " (under-damped)"
    text += f" and {light:.2g} about light ones"
    if question.damping is None and heavy < NEAR_ONE:
        text += f"; more is within a factor of {MARGIN:g} of the greatest stable D"
    return (design, f"{text}.")


def _describe_limits(answer: ArmAnswer) -> tuple[str, ...]:
    question, limits = answer.question, answer.limits
    where = f"At {1.0 / question.period:g} Hz and a delay of {1e3 * question.delay:g} ms"
    designed = f"K below {write(limits.designed)} N m/rad with D pose by pose"
    if math.isnan(limits.low):
        return (f"{where} no D makes this K stable in the lightest pose. It takes {designed}.",)
    ranges = [f"D from {write(limits.low)} to {write(limits.high)} N m s/rad at your K", designed]
    if not math.isnan(limits.stiffness):
        ranges.append(f"K below {write(limits.stiffness)} with D = {write(answer.damping)}")
    sentences = [
        f"{where}, in every drawn pose: {'; '.join(ranges)}. The least inertia decides. Keep a factor of {MARGIN:g} "
        "away: there the loop is just stable.",
    ]
    if not answer.is_stable:
        what = "Your K and D are" if question.damping else "Your K is, with D pose by pose,"
        sentences.insert(0, f"{what} unstable in the lightest poses.")
    return tuple(sentences)


def _describe_bound(answer: ArmAnswer) -> str:
    question = answer.question
    if math.isinf(question.torque):
        return "None, because no --torque was given."
    angle = question.torque / question.stiffness
    return (
        f"{question.torque:g} N m over K, which is bound over kp, is {write(angle)} rad ({math.degrees(angle):.3g}°): "
        "greater errors are cut."
    )


def _describe_laws(answer: ArmAnswer) -> tuple[str, ...]:
    light, heavy = answer.light.advice.law, answer.heavy.advice.law
    if light == heavy:
        first = f"Use {light} at any inertia of this range." if light else "No law, at either end."
    else:
        first = (
            f"It depends on the pose: {light or 'none'} at low inertia, {heavy or 'none'} at high."
        )
    return (first, _describe_end("Low", answer.light), _describe_end("High", answer.heavy))


def _describe_end(words: str, end: StiffnessEnd) -> str:
    body, advice = end.body, end.advice
    uneven = body.at.unevenness
    least, greatest = write((1.0 - uneven) * body.inertia), write((1.0 + uneven) * body.inertia)
    mean = f"kp {write(body.kp)} 1/s², ratio {body.at.zeta:g}"
    where = f"{words}, {least} to {greatest} kg m² (mean: {mean})"
    if advice.law is None:
        if advice.near_goal.radius >= 1.0:
            return f"{where}: no law, because the loop is unstable (see Stable)."
        if advice.near_goal.is_hopeless:
            return (
                f"{where}: no law settles before an episode ends; take a ratio nearer to {ZETA:g}."
            )
        return f"{where}: no law that was simulated meets the requirements."
    seconds = advice.row(advice.law)["time"] / math.sqrt(body.kp)
    ties = f"{listed(advice.tied)} within 5%" if advice.tied else "no other law within 5%"
    law = f"{advice.law} ({attribution(advice.law)})"
    return f"{where}: {law} settles 99 % in {seconds:.3g} s; {ties}."


def _describe_evidence(answer: ArmAnswer) -> tuple[str, ...]:
    asked, median = answer.light.body.at.unevenness, answer.felt.unevenness
    uneven = f"uneven by {asked:g} (the arm's median is {median:.2g})"
    rubbed = "the file's joint damping" if answer.chain.is_rubbed else "friction"
    sentences = [
        f"Limits: theory, within 10 % of simulations of our arms; {rubbed} and filters are left out.",
        f"Laws: simulated on a free body {uneven}, not on the arm.",
    ]
    answered = [end for end in (answer.light, answer.heavy) if end.advice.law]
    for end in answered:
        sentences += [describe_outside(number) for number in end.advice.outside]
    if answered:
        sentences.append(f"More on the first: {_write_command(answer.question, answered[0].body)}")
    return tuple(dict.fromkeys(sentences))


def _write_command(question: ArmQuestion, body: Body) -> str:
    """Return the command that asks for the laws of a body."""
    words = [f"--kp {body.kp:.4g}", f"--kv {body.kv:.4g}", f"--rate {1.0 / question.period:g}"]
    if question.delay:
        words.append(f"--delay {1e3 * question.delay:g}ms")
    if math.isfinite(question.torque):
        words.append(f"--bound {question.torque / body.inertia:.4g}")
    words.append(f"--unevenness {body.at.unevenness:g} --robot torque-no-model")
    return f"bench advise {' '.join(words)}"
