"""C10 and C11: the law that linearizes by feedback at its poles and jumps, and near them (Murphy 1988, 2.4)."""

import math

import numpy as np

from bench.contenders.registry import representation
from bench.findings.claims import probes
from bench.findings.claims.feedback_linearized import LAW
from bench.findings.claims.tables import MAIN_ENGINE, evidence, on_every_engine, settled, some
from bench.findings.claims.verdict import MISPRINTS, Earlier, claim, word_of
from bench.law.contender import AT_REST, Gains

CONTENDER = f"{LAW}/zyx-euler"
PAIRS = ((1.0, -0.5), (-2.0, 1.0))
SIDES = ((0.0, 0.0), (0.4, 0.3), (-0.9, -1.5))
"""(alpha, gamma) near the poles; (beta, the other angle) at the jumps: as in the start sets [rad]."""

GROWTH_DECADES = (3, 8)
SPIN = (4.0, -8.0, 6.0)
"""rad/s, any direction: the terms that grow, about 58 / cos(beta), then exceed the spring term 100 pi from cos(beta)
= 0.1 on."""

GROWTH_SLACK, JUMP_SLACK = 0.05, 0.01
MARGINS_RAD = (0.01, 0.05, 0.1, 0.2)
MARGINS = ", ".join(f"{margin:g}" for margin in MARGINS_RAD)


@claim(
    id="C10",
    section="2.4",
    equation="(2.8), (2.9)",
    quote="""
        The point beta = +-pi/2 created numerical problems due to divide by zero in elements of the B matrix.
        Passing through the points alpha = +-pi, and gamma = +-pi caused problems due to discontinuities in the
        values produced by the atan2 function.
    """,
    correction="Elements of B^-1 are divided by zero; those of B are finite everywhere.",
    written="2026-11-21 9072535",
    sentence="beta = +-pi/2 divides by zero in elements of B; passing alpha, gamma = +-pi jumps through atan2.",
    question="What does the law command at and near the pole, and across the jump?",
    criterion=f"""
        Pole: at exact poles, at rest and spinning, the command is not a finite number and no episode
        settles. Growth: for a body spinning at (4, -8, 6) rad/s log |u| against log cos(beta), at pi/2 -
        |beta| = 10^-k, k = {GROWTH_DECADES[0]} to {GROWTH_DECADES[1]}, has a slope within
        {GROWTH_SLACK:.0%} of -1. Jump: between 1e-9 rad before and behind +-pi, alpha or gamma, the
        command changes by 2 pi Kp within {JUMP_SLACK:.0%}. Where: elements of B (2.8) are not finite at
        the pole. It holds if all four pass; with a correction if pole and jump pass but growth or where
        does not (the division may be in B^-1 only); if the command stays finite at an exact pole, or does
        not jump, it does not hold. {MISPRINTS}
    """,
    open="""
        How the angles are extracted at the exact pole, and 0/0, are left to the program: the paper says
        'divide by zero' and so do IEEE numbers. Gains enter the jump.
    """,
)
def c10(results):
    """Commands at exact poles and near them, and on both sides of the jumps; B itself at the poles."""
    gains = results.gains()
    poles = results.episodes(LAW, MAIN_ENGINE, "poles")
    exact = some(poles[probes.boundary_distance(poles)["pole"] <= probes.EXACT_RAD], "exact pole")
    at = probes.rotations(exact)
    commands = [probes.command(CONTENDER, R, omega, gains=gains) for R in at for omega in (AT_REST, SPIN)]
    finite = sum(bool(np.isfinite(u).all()) for u in commands)
    largest = max(float(np.abs(probes.euler_B(R)).max()) for R in at)
    slope, grown = _growth(gains)
    jumps = _jumps(gains) / (2 * math.pi * gains.kp)
    pole = finite == 0 and not settled(exact).any()
    jump = bool((np.abs(jumps - 1) <= JUMP_SLACK).all())
    divides = abs(slope + 1) <= GROWTH_SLACK and not math.isfinite(largest)
    word = word_of(pole and jump and divides, pole and jump)
    so = ", so that B^-1 is what divides" if math.isfinite(largest) else ""
    return word, evidence(
        f"""{finite} of {len(commands)} commands at exact poles are finite, and {int(settled(exact).sum())} of
        {len(exact)} episodes there settle; the largest element of B there is {largest:.3f}{so}. Spinning, |u| grows as
        cos(beta) to the power {slope:.3f}, to {grown:.1e} rad/s^2. Across +-pi the command jumps by
        {float(jumps.min()):.4f} to {float(jumps.max()):.4f} times 2 pi Kp.""",
        len(commands) + len(exact) + len(jumps),
        ("experiment", "episodes"),
    )


def _growth(gains: Gains) -> tuple[float, float]:
    """Slope of log |u| against log cos(beta) for a spinning body near the poles, and the largest |u|."""
    zyx = representation("zyx-euler")
    low, high = GROWTH_DECADES
    margins, sizes = [], []
    for k in range(low, high + 1):
        for sign in (1, -1):
            for alpha, gamma in PAIRS:
                R = zyx.to_matrix((alpha, sign * (math.pi / 2 - 10.0**-k), gamma))
                margins.append(zyx.margin(R))
                sizes.append(np.linalg.norm(probes.command(CONTENDER, R, SPIN, gains=gains)))
    return float(np.polyfit(np.log(margins), np.log(sizes), 1)[0]), float(max(sizes))


def _jumps(gains: Gains) -> np.ndarray:
    """|change of u| over the jumps of alpha and of gamma, 1e-9 rad before and behind."""
    to_matrix = representation("zyx-euler").to_matrix
    found = []
    for beta, other in SIDES:
        for angles in (lambda x, b=beta, y=other: (x, b, y), lambda x, b=beta, y=other: (y, b, x)):
            before, behind = (to_matrix(angles(sign * (math.pi - 1e-9))) for sign in (1, -1))
            change = probes.command(CONTENDER, before, gains=gains) - probes.command(CONTENDER, behind, gains=gains)
            found.append(np.linalg.norm(change))
    return np.array(found)


@claim(
    id="C11",
    section="2.4",
    quote="""
        In practical situations, the active range of the feedback linear regulator would exclude a small region
        of points around the boundary points. This would assure that the regulator could not be driven through
        any of the boundary points
    """,
    correction="It assures that of bodies at rest; where a body spins, its velocity counts too.",
    written="2026-11-21 9f269f3",
    sentence="""
        Excluding a small region about the boundary points keeps the regulator from passing them
        erratically.
    """,
    question="How wide must the excluded region be, for bodies at rest and for spinning ones?",
    criterion=f"""
        An episode is erratic if it does not settle or its peak command exceeds twice Kp sqrt(3) pi + 20
        Kd (spring and damping at most, at 20 rad/s). For margins {MARGINS} rad: starts with pi/2 -
        |beta_0|, pi - |alpha_0| and pi - |gamma_0| all above the margin, at rest (uniform, half-turn,
        poles, wraps, box) and spinning (tumbling). It holds if for some margin none is erratic, at rest
        or spinning; with a correction if that is so at rest only: a start's place then does not assure
        it, its velocity counts; if erratic ones remain at rest for every margin, it does not hold. Added
        after the first results, because tumbling holds no body that spins beside a margin: {probes.BESIDE}
        starts {probes.SPEED:g} rad/s fast, in all directions, 0.001 rad outside each margin of the poles,
        count among the spinning ones. They can only make it harder to hold.
    """,
    open="""
        'Small' is not given a number; 0.2 rad (11 degrees) is the widest that we call small. What the
        robot does in the excluded region is not said either.
    """,
    readings=(
        "the region is kept free of initial orientations (the one judged)",
        "the region is never entered on the way: reported from the smallest cos(beta) of each episode",
    ),
    earlier=(Earlier("2026-11-21 9072535", "Without the bodies that spin beside a margin."),),
)
@on_every_engine
def c11(results, engine):
    """Erratic episodes among starts outside each margin, at rest and spinning."""
    frame = results.episodes(LAW, engine, "uniform", "half-turn", "poles", "wraps", "box", "tumbling")
    gains = results.gains()
    limit = 2 * (gains.kp * math.sqrt(3) * math.pi + 20 * gains.kv)
    erratic = ~settled(frame) | (frame["peak_u"] > limit)
    room = probes.boundary_distance(frame)[["pole", "wrap"]].min(axis=1)
    spins = frame["start_set"] == "tumbling"
    some(frame[spins], "tumbling start")
    counts = {
        margin: (int((erratic & ~spins & (room > margin)).sum()), int((erratic & spins & (room > margin)).sum()))
        for margin in MARGINS_RAD
    }
    at_rest = [margin for margin, (rest, _) in counts.items() if not rest]
    beside = {margin: probes.beside_pole(margin, CONTENDER, gains, results.dt_s) for margin in MARGINS_RAD}
    passed = {margin: int((~settled(one) | (one["peak_u"] > limit)).sum()) for margin, one in beside.items()}
    tumbling_too = [margin for margin in at_rest if not counts[margin][1]]
    all_three = [margin for margin in tumbling_too if not passed[margin]]
    as_first_fixed = word_of(tumbling_too, at_rest)
    word = word_of(all_three, at_rest)
    widest = MARGINS_RAD[-1]
    clear = frame[spins & (frame["min_margin"] > math.sin(widest))]
    still = ", ".join(str(rest) for rest, _ in counts.values())
    turning = ", ".join(str(spinning) for _, spinning in counts.values())
    near = ", ".join(str(count) for count in passed.values())
    peak_rest = float(frame.loc[~spins & (room > MARGINS_RAD[0]), "peak_u"].max())
    peak_spin = float(frame.loc[spins & (room > MARGINS_RAD[0]), "peak_u"].max())
    return word, evidence(
        f"""Erratic starts outside margins of {MARGINS} rad: {still} at rest (of {int((~spins).sum()):,} in all),
        {turning} tumbling (of {int(spins.sum())}), and {near} of {probes.BESIDE} that spin at {probes.SPEED:g} rad/s
        beside each margin; peak commands at rest up to {peak_rest:,.0f}, tumbling up to {peak_spin:,.0f} rad/s^2. Of
        {len(clear)} tumbling ones that never come within {widest} rad of a pole, {int(erratic[clear.index].sum())} are
        erratic.""",
        len(frame) + sum(len(one) for one in beside.values()),
        ("episodes", "experiment"),
    )._replace(earlier=(as_first_fixed,))
