"""LS01 to LS10: the claims of Lopez and Slotine 2024 on the quaternion sliding variable."""

import math

from bench.base.on_first_use import pd
from bench.experiments import sliding_motion
from bench.experiments.tables import read
from bench.findings.amounts import count_of
from bench.findings.claims import probes
from bench.findings.claims.adequacy import NOISE
from bench.findings.claims.lopez_slotine_2024 import motions
from bench.findings.claims.lopez_slotine_2024.motions import LAW, WITH_MEMORY
from bench.findings.claims.tables import MAIN_ENGINE, Results, evidence, settled, settled_of, some
from bench.findings.claims.verdict import Evidence, NoEvidence, Word, claim, read_limits, word_of
from bench.findings.perturbed import DETOUR
from bench.findings.proofs.certificate import read_certificates
from bench.findings.start_sets import least_starts
from bench.law import DELTA
from bench.law.inputs import Gains

LIMIT = read_limits(__file__)
SMOOTH, EULER = "rotation-matrix", "feedback-linearized"
"""Laws of Murphy 1988: on the rotation matrix, and on Z-Y-X angles."""

KEPT_DEG = math.degrees(2.0 * math.asin(DELTA))
"""How far beyond 180° the law with memory may go on [degrees]."""


def gains_of(results: Results) -> Gains:
    """Return the run's gains; NoEvidence: they have no real poles, and then the law has no sliding variable."""
    gains = results.gains()
    if gains.kv**2 < 4.0 * gains.kp:
        raise NoEvidence(f"no sliding variable has the poles of the gains at Kv = {gains.kv:g}: Kv^2 must be 4 Kp")
    return gains


def episodes(results: Results, law: str, *start_sets: str) -> pd.DataFrame:
    """Return the episodes of a law in continuous time; NoEvidence: fewer than a suite has of a later law."""
    rows = results.free_body("episodes", task="free-body", regulator=law, engine=MAIN_ENGINE)
    rows = some(rows[rows["start_set"].isin(start_sets)], f"episode of {law}")
    results.check_starts(rows, law, least_starts(MAIN_ENGINE, "beyond"), *start_sets)
    return rows


def at_rest(results: Results, law: str) -> pd.DataFrame:
    """Return the episodes of a law from uniform starts, 180° rotations and poles."""
    return episodes(results, law, "uniform", "half-turn", "poles")


def at_half_turn(rows: pd.DataFrame) -> pd.DataFrame:
    """Return the episodes that start exactly at 180°."""
    return probes.at_boundary(rows, "half_turn", "start exactly at 180°")


def count_field(results: Results, finding: str) -> tuple[int, int]:
    """Return at how many 180° rotations the command shows a finding, and of how many."""
    rows = results.table("command-field", regulator=LAW, finding=finding, **read.FREE_BODY)
    row = some(rows, f"finding {finding} about {LAW}").iloc[0]
    return int(row["found"]), int(row["of"])


def under(results: Results, law: str, axis: str) -> pd.DataFrame:
    """Return the episodes of a law along a perturbation."""
    rows = results.table("robustness", regulator=law, axis=axis)
    return some(rows, f"episode of {law} under {axis}")


def least_noise(results: Results, law: str) -> pd.DataFrame:
    """Return the episodes from exact 180° rotations with the least noise that is not zero."""
    rows = under(results, law, NOISE)
    noisy = rows[rows["level"] > 0.0]
    return some(noisy[noisy["level"] == noisy["level"].min()], f"episode of {law} with noise")


def withstand_noise(results: Results, law: str) -> float:
    """Return the least noise at 180° from which some start of a law does not settle [rad]; infinite: there is none."""
    rows = under(results, law, NOISE)
    return float(rows.loc[~settled(rows), "level"].min())


def decide(word: Word, text: str, rows: int, instead: str = "") -> tuple[Word, Evidence]:
    """Return a word whose evidence is no longer than what was measured."""
    return word, evidence(text, rows, instead=instead, measured=text)


@claim("LS01")
def ls01(results: Results) -> tuple[Word, Evidence]:
    """Commands from starts at and near every pole and 180° rotation, and of the field at 180°."""
    bound = 2.0 * gains_of(results).kp
    rows = at_rest(results, LAW)
    undefined, looked_at = count_field(results, "no-number-half-turns")
    jumps, tried = count_field(results, "jump-half-turns")
    largest = float(rows["peak_u"].max())
    is_bounded = largest <= bound * (1.0 + LIMIT.SLACK)
    is_free = is_bounded and settled(rows).all() and not undefined
    return decide(
        word_of(is_free, False),
        f"""From {len(rows):,} starts at rest, the largest command is {largest:.6g} rad/s² (bound: {bound:g}). The
        command is undefined at {count_of(undefined, looked_at, "180° rotations")}. It jumps at
        {count_of(jumps, tried, "180° rotations")}.""",
        len(rows) + looked_at + tried,
    )


@claim("LS02")
def ls02(results: Results) -> tuple[Word, Evidence]:
    """Outcomes without noise, the decay of T against its proved bound, and the least noise at 180°."""
    gains = gains_of(results)
    rows, noisy = at_rest(results, LAW), least_noise(results, LAW)
    decay = results.found_by(sliding_motion.measure_decay, gains)
    bound = results.found_by(sliding_motion.measure_bound, gains, results.seed)
    is_exponential = decay.largest_error <= LIMIT.SLACK and bound.largest_share <= 1.0 + LIMIT.SLACK
    word = Word.FAILS
    if is_exponential and settled(rows).all():
        word = Word.HOLDS if settled(noisy).all() else Word.READING
    text = f"""Without noise, {settled_of(rows, "starts at rest")} settle. The largest ratio of tan(θ/4) to its
        exponential bound is {bound.largest_share:.4g}. With {noisy["level"].min():g} rad of worst-case noise at 180°,
        {settled_of(noisy, "starts")} settle."""
    return word, evidence(
        f"""{text} The bound was computed for {bound.starts} other episodes. On s = 0, tan(θ/4) decays at one rate: it
        follows exp(-λ t/2) to {decay.largest_error:.0e}. The sine of half the angle does not: its rate is
        {decay.first_rate:.2g} 1/s near 180° and {decay.last_rate:.3g} 1/s at the end.""",
        len(rows) + len(noisy) + decay.starts + bound.starts,
        instead=LIMIT.NOMINAL if word == Word.READING else "",
        measured=text,
    )


@claim("LS03")
def ls03(results: Results) -> tuple[Word, Evidence]:
    """Paths from rest, and what a stored sign adds after a jump of the goal."""
    gains_of(results)
    rows = at_rest(results, LAW)
    longest = float(rows["path_ratio"].max())
    jump, jump_kept = (under(results, law, "goal-jump")["path_ratio"].max() for law in (LAW, WITH_MEMORY))
    return decide(
        word_of(longest < DETOUR, False),
        f"""From {len(rows):,} starts at rest, the longest path is {longest:.4f} times the shortest. After a jump of the
        goal, it is {jump:.2f} times the shortest, and {jump_kept:.2f} times with memory. Memory may turn the body up to
        {KEPT_DEG:.0f}° beyond 180°.""",
        len(rows),
    )


@claim("LS04")
def ls04(results: Results) -> tuple[Word, Evidence]:
    """Motions of the law in both frames from the same starts."""
    frames = results.found_by(motions.compare_frames, gains_of(results), results.seed)
    apart = max(frames.apart_at_rest, frames.apart_spinning)
    return decide(
        word_of(apart <= LIMIT.SAME_RAD, frames.angle_gap <= LIMIT.SAME_RAD),
        f"""With the variable in the base frame and in the body frame, the angles to the goal differ by at most
        {frames.angle_gap:.0e} rad at the same time. The orientations differ by at most {frames.apart_at_rest:.0e} rad
        from rest and {math.degrees(frames.apart_spinning):.0f}° from spinning starts.""",
        2 * sliding_motion.STARTS_OF_A_SET,
    )


@claim("LS05")
def ls05(results: Results) -> tuple[Word, Evidence]:
    """Starts at and near the poles of Euler angles, of this law and of one on Euler angles."""
    gains_of(results)
    rows, euler = (episodes(results, law, "poles") for law in (LAW, EULER))
    return decide(
        word_of(settled(rows).all() and not settled(euler).all(), False),
        f"""At and near the poles of Euler angles, {settled_of(rows, "starts")} settle with the quaternion, and
        {settled_of(euler, "starts")} with feedback linearization on Z-Y-X angles.""",
        len(rows) + len(euler),
    )


@claim("LS06")
def ls06(results: Results) -> tuple[Word, Evidence]:
    """Exact 180° rotations without noise and with noise: this law, one on the rotation matrix, and one with memory."""
    hold = results.found_by(motions.hold_by_noise, gains_of(results), LIMIT.PERIODS_S, LIMIT.NOISE_SHARE)
    rows = at_rest(results, LAW)
    exact, smooth = at_half_turn(rows), at_half_turn(episodes(results, SMOOTH, "half-turn"))
    noisy, kept = least_noise(results, LAW), least_noise(results, WITH_MEMORY)
    is_global = settled(rows).all() and settled(noisy).all() and not hold.held
    proofs = read_certificates()
    stands, stands_kept = (proofs.get(law, {}).get("stands", "nothing") for law in (LAW, WITH_MEMORY))
    text = f"""At exactly 180°, {settled_of(exact, "starts")} settle without noise. With {noisy["level"].min():g} rad of
        noise, {settled_of(noisy, "starts")} settle, and with memory {settled_of(kept, "starts")}. At a period of
        {1e6 * min(LIMIT.PERIODS_S):.0f} µs, {hold.least_rad:.0e} rad is enough."""
    instead = f"""{LIMIT.NOMINAL} The body leaves 180° because the command jumps there, not because of the quaternion.
        The law with memory fails only from {withstand_noise(results, WITH_MEMORY):g} rad of noise on. Its price is a
        turn of up to {KEPT_DEG:.0f}° beyond 180°."""
    return word_of(is_global, False), evidence(
        f"""{text} With the law on the rotation matrix, {settled_of(smooth, "starts")} at exactly 180° settle without
        noise: its command is zero there and does not jump. A noise of {LIMIT.NOISE_SHARE:g} Kp period² holds
        {count_of(hold.held, hold.starts, "starts")} at 180° without memory, and {
            count_of(hold.held_with_memory, hold.starts, "starts")
        } with memory, at periods down to {1e6 * min(LIMIT.PERIODS_S):.0f} µs. The command `bench
        prove` proves of the law without memory: {stands}; with memory: {stands_kept} (without noise).""",
        len(rows) + len(smooth) + len(noisy) + len(kept) + 2 * hold.starts,
        instead="" if is_global else instead,
        measured=text,
    )


@claim("LS07")
def ls07(results: Results) -> tuple[Word, Evidence]:
    """No rows: the sentence is about other authors' works, and we could not read which."""
    return Word.UNTESTED, evidence(LIMIT.OTHER_VARIABLES, 0)


@claim("LS08")
def ls08(results: Results) -> tuple[Word, Evidence]:
    """No rows: the sentence is about other authors' works, and we could not read which."""
    return Word.UNTESTED, evidence(LIMIT.OTHER_LAWS, 0)


@claim("LS09")
def ls09(results: Results) -> tuple[Word, Evidence]:
    """Arms with our controllers, which do not decide: the paper's torque law could not be read."""
    rows = results.table("episodes", task="arm-regulation", regulator=LAW)
    return Word.UNTESTED, evidence(
        f"""We could not read the torque law, so we cannot simulate it. On arms, with our Jacobians and inverses in
        place of that law, {settled_of(rows, "episodes")} of `{LAW}` settle. These episodes do not decide the claim.""",
        len(rows),
    )


@claim("LS10")
def ls10(results: Results) -> tuple[Word, Evidence]:
    """Goals that move, with their rate and acceleration given to the law."""
    decay = results.found_by(sliding_motion.measure_decay, gains_of(results))
    rows = under(results, LAW, "moving-goal")
    return decide(
        word_of(settled(rows).all() and decay.largest_error <= LIMIT.SLACK, False),
        f"""With goals that swing at up to {rows["level"].max():g} rad/s, {settled_of(rows, "starts")} settle. Largest
        angle to the goal in the last second: {math.degrees(rows["tail_max_rad"].max()):.2g}°.""",
        len(rows) + decay.starts,
    )
