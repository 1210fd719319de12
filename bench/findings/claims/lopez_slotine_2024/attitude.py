"""LS01 to LS10: the claims of Lopez and Slotine 2024 on the quaternion sliding variable."""

import math

from bench.base.errors import NoEvidence
from bench.base.on_first_use import pd
from bench.experiments.probe_values import sliding
from bench.experiments.tables.run import FREE_BODY, MAIN_ENGINE, Run, require_rows
from bench.findings.amounts import count_of
from bench.findings.claims import places
from bench.findings.claims.adequacy import NOISE
from bench.findings.claims.tables import check_starts, evidence, settled, settled_of
from bench.findings.claims.verdict import Evidence, Word, claim, word_of
from bench.findings.perturbed import DETOUR
from bench.findings.proofs.certificate import read_certificates
from bench.findings.start_sets import least_starts
from bench.law import DELTA
from bench.law.inputs import Gains

# Relative, for tan(θ/4) and the command: Runge-Kutta at 1 ms (1e-9 here) and the curve's own rounding of θ.
SLACK = 1e-6
# rad: two motions are the same. Where the command jumps by 4 Kp within a step of 1 ms, the step turns the body by up to
# 4 Kp (1 ms)^2/2 more or less, at the default gains 2e-4 rad; without a jump the two motions differ by 1e-7 or less.
SAME_RAD = 2e-4
PERIODS_S, NOISE_SHARE = sliding.PERIODS_S, sliding.NOISE_SHARE
NOMINAL = (
    "Without measurement error and with one sign chosen at 180°, the error converges "
    "exponentially from every start: tan(θ/4) has the rate λ/2. An arbitrarily small measurement "
    "error can hold the body at 180°."
)
OTHER_VARIABLES = (
    "The sentence is about five works of other authors, and we could not read the list of "
    "references. A sliding variable with the sign of the scalar part, s = ω + k sgn(q4) q_v, is "
    "in public code whose command is named after Crassidis (repository dtbinh/satellite, file "
    "satellite_adcs/controllerSliding.m). From memory: Crassidis, Vadali and Markley published "
    "this variable in 2000. This sign prevents unwinding as LS03 has it. We cannot say whether "
    "that work is one of the five."
)
OTHER_LAWS = "The sentence is about four works of other authors, and we could not read the list of references."
LAW, WITH_MEMORY = sliding.LAW, sliding.WITH_MEMORY
SMOOTH, EULER = "rotation-matrix", "feedback-linearized"
"""Laws of Murphy 1988: on the rotation matrix, and on Z-Y-X angles."""

KEPT_DEG = math.degrees(2.0 * math.asin(DELTA))
"""How far beyond 180° the law with memory may go on [degrees]."""


def gains_of(run: Run) -> Gains:
    """Return the run's gains; NoEvidence: they have no real poles, and then the law has no sliding variable."""
    gains = run.gains()
    if gains.kv**2 < 4.0 * gains.kp:
        raise NoEvidence(f"no sliding variable has the poles of the gains at Kv = {gains.kv:g}: Kv^2 must be 4 Kp")
    return gains


def episodes(run: Run, law: str, *start_sets: str) -> pd.DataFrame:
    """Return the episodes of a law in continuous time; NoEvidence: fewer than a suite has of a later law."""
    rows = run.free_body("episodes", task="free-body", regulator=law, engine=MAIN_ENGINE)
    rows = require_rows(rows[rows["start_set"].isin(start_sets)], f"episode of {law}")
    check_starts(run, rows, law, least_starts(MAIN_ENGINE, "beyond"), *start_sets)
    return rows


def at_rest(run: Run, law: str) -> pd.DataFrame:
    """Return the episodes of a law from uniform starts, 180° rotations and poles."""
    return episodes(run, law, "uniform", "half-turn", "poles")


def at_half_turn(rows: pd.DataFrame) -> pd.DataFrame:
    """Return the episodes that start exactly at 180°."""
    return places.at_boundary(rows, "half_turn", "start exactly at 180°")


def count_field(run: Run, finding: str) -> tuple[int, int]:
    """Return at how many 180° rotations the command shows a finding, and of how many."""
    rows = run.table("command-field", regulator=LAW, finding=finding, **FREE_BODY)
    row = require_rows(rows, f"finding {finding} about {LAW}").iloc[0]
    return int(row["found"]), int(row["of"])


def under(run: Run, law: str, axis: str) -> pd.DataFrame:
    """Return the episodes of a law along a perturbation."""
    rows = run.table("robustness", regulator=law, axis=axis)
    return require_rows(rows, f"episode of {law} under {axis}")


def least_noise(run: Run, law: str) -> pd.DataFrame:
    """Return the episodes from exact 180° rotations with the least noise that is not zero."""
    rows = under(run, law, NOISE)
    noisy = rows[rows["level"] > 0.0]
    return require_rows(noisy[noisy["level"] == noisy["level"].min()], f"episode of {law} with noise")


def withstand_noise(run: Run, law: str) -> float:
    """Return the least noise at 180° from which some start of a law does not settle [rad]; infinite: there is none."""
    rows = under(run, law, NOISE)
    return float(rows.loc[~settled(rows), "level"].min())


def decide(word: Word, text: str, rows: int, instead: str = "") -> tuple[Word, Evidence]:
    """Return a word whose evidence is no longer than what was measured."""
    return word, evidence(text, rows, instead=instead, measured=text)


@claim("LS01")
def ls01(run: Run) -> tuple[Word, Evidence]:
    """Commands from starts at and near every pole and 180° rotation, and of the field at 180°."""
    bound = 2.0 * gains_of(run).kp
    rows = at_rest(run, LAW)
    undefined, looked_at = count_field(run, "no-number-half-turns")
    jumps, tried = count_field(run, "jump-half-turns")
    largest = float(rows["peak_u"].max())
    is_bounded = largest <= bound * (1.0 + SLACK)
    is_free = is_bounded and settled(rows).all() and not undefined
    return decide(
        word_of(is_free, False),
        f"""From {len(rows):,} starts at rest, the largest command is {largest:.6g} rad/s² (bound: {bound:g}). The
        command is undefined at {count_of(undefined, looked_at, "180° rotations")}. It jumps at
        {count_of(jumps, tried, "180° rotations")}.""",
        len(rows) + looked_at + tried,
    )


@claim("LS02")
def ls02(run: Run) -> tuple[Word, Evidence]:
    """Outcomes without noise, the decay of T against its proved bound, and the least noise at 180°."""
    gains_of(run)
    rows, noisy = at_rest(run, LAW), least_noise(run, LAW)
    decay, bound = run.probe("sliding-decay"), run.probe("sliding-bound")
    error, share = float(decay["decay_gap"].max()), float(bound["share_of_bound"].max())
    nearest = decay.iloc[-1]  # the last axis of the angles nearest to 180°
    is_exponential = error <= SLACK and share <= 1.0 + SLACK
    word = Word.FAILS
    if is_exponential and settled(rows).all():
        word = Word.HOLDS if settled(noisy).all() else Word.READING
    text = f"""Without noise, {settled_of(rows, "starts at rest")} settle. The largest ratio of tan(θ/4) to its
        exponential bound is {share:.4g}. With {noisy["level"].min():g} rad of worst-case noise at 180°,
        {settled_of(noisy, "starts")} settle."""
    return word, evidence(
        f"""{text} The bound was computed for {len(bound)} other episodes. On s = 0, tan(θ/4) decays at one rate: it
        follows exp(-λ t/2) to {error:.0e}. The sine of half the angle does not: its rate is
        {nearest['first_rate_per_s']:.2g} 1/s near 180° and {nearest['last_rate_per_s']:.3g} 1/s at the end.""",
        len(rows) + len(noisy) + len(decay) + len(bound),
        instead=NOMINAL if word == Word.READING else "",
        measured=text,
    )


@claim("LS03")
def ls03(run: Run) -> tuple[Word, Evidence]:
    """Paths from rest, and what a stored sign adds after a jump of the goal."""
    gains_of(run)
    rows = at_rest(run, LAW)
    longest = float(rows["path_ratio"].max())
    jump, jump_kept = (under(run, law, "goal-jump")["path_ratio"].max() for law in (LAW, WITH_MEMORY))
    return decide(
        word_of(longest < DETOUR, False),
        f"""From {len(rows):,} starts at rest, the longest path is {longest:.4f} times the shortest. After a jump of the
        goal, it is {jump:.2f} times the shortest, and {jump_kept:.2f} times with memory. Memory may turn the body up to
        {KEPT_DEG:.0f}° beyond 180°.""",
        len(rows),
    )


@claim("LS04")
def ls04(run: Run) -> tuple[Word, Evidence]:
    """Motions of the law in both frames from the same starts."""
    gains_of(run)
    frames = run.probe("sliding-frames")
    gap = float(frames["angle_gap"].max())
    is_at_rest = frames["case"].astype(str).str.startswith("uniform")
    at_rest, spinning = (float(frames.loc[which, "orientation_gap"].max()) for which in (is_at_rest, ~is_at_rest))
    return decide(
        word_of(max(at_rest, spinning) <= SAME_RAD, gap <= SAME_RAD),
        f"""With the variable in the base frame and in the body frame, the angles to the goal differ by at most
        {gap:.0e} rad at the same time. The orientations differ by at most {at_rest:.0e} rad
        from rest and {math.degrees(spinning):.0f}° from spinning starts.""",
        len(frames),
    )


@claim("LS05")
def ls05(run: Run) -> tuple[Word, Evidence]:
    """Starts at and near the poles of Euler angles, of this law and of one on Euler angles."""
    gains_of(run)
    rows, euler = (episodes(run, law, "poles") for law in (LAW, EULER))
    return decide(
        word_of(settled(rows).all() and not settled(euler).all(), False),
        f"""At and near the poles of Euler angles, {settled_of(rows, "starts")} settle with the quaternion, and
        {settled_of(euler, "starts")} with feedback linearization on Z-Y-X angles.""",
        len(rows) + len(euler),
    )


@claim("LS06")
def ls06(run: Run) -> tuple[Word, Evidence]:
    """Exact 180° rotations without noise and with noise: this law, one on the rotation matrix, and one with memory."""
    gains_of(run)
    held, held_kept = (run.probe("sliding-noise", regulator=law) for law in (LAW, WITH_MEMORY))
    count_held, count_kept = (int((~settled(one)).sum()) for one in (held, held_kept))
    rows = at_rest(run, LAW)
    exact, smooth = at_half_turn(rows), at_half_turn(episodes(run, SMOOTH, "half-turn"))
    noisy, kept = least_noise(run, LAW), least_noise(run, WITH_MEMORY)
    is_global = settled(rows).all() and settled(noisy).all() and not count_held
    proofs = read_certificates()
    stands, stands_kept = (proofs.get(law, {}).get("stands", "nothing") for law in (LAW, WITH_MEMORY))
    text = f"""At exactly 180°, {settled_of(exact, "starts")} settle without noise. With {noisy["level"].min():g} rad of
        noise, {settled_of(noisy, "starts")} settle, and with memory {settled_of(kept, "starts")}. At a period of
        {1e6 * min(PERIODS_S):.0f} µs, {held['noise_rad'].min():.0e} rad is enough."""
    instead = f"""{NOMINAL} The body leaves 180° because the command jumps there, not because of the quaternion.
        The law with memory fails only from {withstand_noise(run, WITH_MEMORY):g} rad of noise on. Its price is a
        turn of up to {KEPT_DEG:.0f}° beyond 180°."""
    return word_of(is_global, False), evidence(
        f"""{text} With the law on the rotation matrix, {settled_of(smooth, "starts")} at exactly 180° settle without
        noise: its command is zero there and does not jump. A noise of {NOISE_SHARE:g} Kp period² holds
        {count_of(count_held, len(held), "starts")} at 180° without memory, and {
            count_of(count_kept, len(held_kept), "starts")
        } with memory, at periods down to {1e6 * min(PERIODS_S):.0f} µs. The command `bench
        prove` proves of the law without memory: {stands}; with memory: {stands_kept} (without noise).""",
        len(rows) + len(smooth) + len(noisy) + len(kept) + len(held) + len(held_kept),
        instead="" if is_global else instead,
        measured=text,
    )


@claim("LS07")
def ls07(run: Run) -> tuple[Word, Evidence]:
    """No rows: the sentence is about other authors' works, and we could not read which."""
    return Word.UNTESTED, evidence(OTHER_VARIABLES, 0)


@claim("LS08")
def ls08(run: Run) -> tuple[Word, Evidence]:
    """No rows: the sentence is about other authors' works, and we could not read which."""
    return Word.UNTESTED, evidence(OTHER_LAWS, 0)


@claim("LS09")
def ls09(run: Run) -> tuple[Word, Evidence]:
    """Arms with our controllers, which do not decide: the paper's torque law could not be read."""
    rows = run.table("episodes", task="arm-regulation", regulator=LAW)
    return Word.UNTESTED, evidence(
        f"""We could not read the torque law, so we cannot simulate it. On arms, with our Jacobians and inverses in
        place of that law, {settled_of(rows, "episodes")} of `{LAW}` settle. These episodes do not decide the claim.""",
        len(rows),
    )


@claim("LS10")
def ls10(run: Run) -> tuple[Word, Evidence]:
    """Goals that move, with their rate and acceleration given to the law."""
    gains_of(run)
    decay = run.probe("sliding-decay")
    error = float(decay["decay_gap"].max())
    rows = under(run, LAW, "moving-goal")
    return decide(
        word_of(settled(rows).all() and error <= SLACK, False),
        f"""With goals that swing at up to {rows["level"].max():g} rad/s, {settled_of(rows, "starts")} settle. Largest
        angle to the goal in the last second: {math.degrees(rows["tail_max_rad"].max()):.2g}°.""",
        len(rows) + len(decay),
    )
