"""LS01 to LS10: the claims of Lopez and Slotine 2024 on the quaternion sliding variable."""

import math
from collections.abc import Sequence

import numpy as np

from bench.base.on_first_use import pd
from bench.experiments.tables import read
from bench.findings.amounts import capitalize, count, count_of
from bench.findings.claims import probes
from bench.findings.claims.adequacy import NOISE
from bench.findings.claims.lopez_slotine_2024 import motions
from bench.findings.claims.lopez_slotine_2024.motions import LAW, WITH_MEMORY, Hold, Rates
from bench.findings.claims.tables import MAIN_ENGINE, Results, evidence, settled, settled_of, some
from bench.findings.claims.verdict import Evidence, NoEvidence, Word, claim, read_limits
from bench.findings.perturbed import DETOUR
from bench.findings.start_sets import least_starts
from bench.law import DELTA

LIMIT = read_limits(__file__)

SMOOTH, EULER = "rotation-matrix", "feedback-linearized"
"""The paper's kind of law on the rotation matrix, and a law on Z-Y-X angles (Murphy 1988)."""

AT_REST_SETS = ("uniform", "half-turn", "poles")
KEPT_DEG = math.degrees(2.0 * math.asin(DELTA))
"""How far beyond 180° the law with memory may go on [degrees]."""


def slide_rates(results: Results) -> Rates:
    """Return lambda and K of the run; NoEvidence: its gains give no real poles, and then the law is another one."""
    gains = results.gains()
    if gains.kv**2 < 4.0 * gains.kp:
        raise NoEvidence(
            f"at Kp = {gains.kp:g} and Kv = {gains.kv:g} no sliding variable has the poles of the gains: Kv^2 must be "
            "4 Kp or more"
        )
    return motions.rates_of(gains)


def at_rest(results: Results, law: str) -> pd.DataFrame:
    """Return the episodes of a law from the start sets at rest, in continuous time."""
    slide_rates(results)
    return episodes(results, law, *AT_REST_SETS)


def episodes(results: Results, law: str, *start_sets: str) -> pd.DataFrame:
    """Return the episodes of a law in continuous time; NoEvidence: fewer than a suite has of a later law."""
    rows = results.free_body("episodes", task="free-body", regulator=law, engine=MAIN_ENGINE)
    rows = some(rows[rows["start_set"].isin(start_sets)], f"episode of {law} from {', '.join(start_sets)}")
    results.check_starts(rows, law, least_starts(MAIN_ENGINE, "beyond"), *start_sets)
    return rows


def at_half_turn(frame: pd.DataFrame) -> pd.DataFrame:
    """Return the episodes that start exactly at 180°."""
    return probes.at_boundary(frame, "half_turn", "start exactly at 180°")


def read_field(results: Results, law: str, finding: str) -> pd.Series:
    """Return the row of command-field.parquet with a finding about a law."""
    rows = results.table("command-field", regulator=law, finding=finding, **read.FREE_BODY)
    return some(rows, f"finding {finding} about {law} in command-field").iloc[0]


def under(results: Results, law: str, axis: str) -> pd.DataFrame:
    """Return the episodes of a law along a perturbation."""
    rows = results.table("robustness", regulator=law, axis=axis)
    return some(rows, f"episode of {law} under {axis}")


def least_noise(results: Results, law: str) -> pd.DataFrame:
    """Return the episodes from exact 180° rotations with the least noise that is not zero."""
    rows = under(results, law, NOISE)
    noisy = some(rows[rows["level"] > 0.0], f"episode of {law} with noise at 180°")
    return noisy[noisy["level"] == noisy["level"].min()]


def withstand_noise(results: Results, law: str) -> float:
    """Return the greatest noise at 180° up to which every start of a law settles [rad]; 0: not even the least."""
    rows = under(results, law, NOISE)
    lost = rows.loc[~settled(rows), "level"]
    return float(rows.loc[rows["level"] < lost.min(), "level"].max()) if len(lost) else float(rows["level"].max())


def of_law(holds: Sequence[Hold], law: str) -> list[Hold]:
    """Return the episodes with smaller noise that are of a law."""
    return [hold for hold in holds if hold.law == law]


def count_held(holds: Sequence[Hold]) -> tuple[int, int]:
    """Return how many episodes noise holds at 180°, and of how many."""
    return sum(hold.held for hold in holds), sum(hold.starts for hold in holds)


@claim("LS01")
def ls01(results: Results) -> tuple[Word, Evidence]:
    """Commands from starts at and near every pole and 180° rotation, and of the field at 180°."""
    frame = at_rest(results, LAW)
    bound = 2.0 * results.gains().kp
    broken = int((~settled(frame)).sum())
    largest = float(frame["peak_u"].max())
    undefined = read_field(results, LAW, "no-number-half-turns")
    jump = read_field(results, LAW, "jump-half-turns")
    is_bounded = largest <= bound * (1.0 + LIMIT.SLACK)
    is_free = is_bounded and not broken and not undefined["found"]
    rows = len(frame) + int(undefined["of"]) + int(jump["of"])
    no_number, jumps = (count_of(int(row["found"]), int(row["of"]), "180° rotations") for row in (undefined, jump))
    return Word.HOLDS if is_free else Word.FAILS, evidence(
        f"""From {len(frame):,} starts at rest, among them starts at the poles of Euler angles and at 180° rotations,
        {settled_of(frame, "episodes")} settle. The largest command is {largest:.6g} rad/s². By its formula, the command
        of a body at rest is at most 2 Kp = {bound:g} rad/s². The command is undefined at {no_number}. But the command is
        not continuous: it jumps at {jumps}.""",
        rows,
        measured=f"""Largest command from {len(frame):,} starts at rest: {largest:.6g} rad/s² (bound: {bound:g}).
        Undefined at {no_number}. It jumps at {jumps}.""",
    )


@claim("LS02")
def ls02(results: Results) -> tuple[Word, Evidence]:
    """Outcomes without noise, the decay of T against its proved bound, and the least noise at 180°."""
    rates = slide_rates(results)
    frame = at_rest(results, LAW)
    lost = int((~settled(frame)).sum())
    decay = results.found_by(motions.measure_decay, results.gains())
    bound = results.found_by(motions.measure_bound, results.gains(), results.seed)
    noisy = least_noise(results, LAW)
    held = int((~settled(noisy)).sum())
    is_exponential = decay.largest_error <= LIMIT.SLACK and bound.largest_share <= 1.0 + LIMIT.SLACK
    holds_without_noise = not lost and is_exponential
    if not holds_without_noise:
        word = Word.FAILS
    else:
        word = Word.READING if held else Word.HOLDS
    level = float(noisy["level"].iloc[0])
    rate = 0.5 * rates.surface
    return word, evidence(
        f"""Without noise, {settled_of(frame, "starts at rest")} settle. On s = 0, tan(θ/4) decays as exp(-{rate:g}
        t): the largest relative difference in {decay.starts} episodes is {decay.largest_error:.0e}. The sine of half
        the angle does not decay at one rate: near 180° its rate is {decay.first_rate:.2g} 1/s, and at the end
        {decay.last_rate:.3g} 1/s. But tan(θ/4) bounds the angle from both sides, so the angle is at most 4/pi times
        its start times exp(-{rate:g} t). From {bound.starts} starts with rates up to {bound.fastest:.3g} rad/s,
        the largest ratio of tan(θ/4) to the bound that we proved by hand (see the criterion) is
        {bound.largest_share:.4g}. With a noise of {level:g} rad at 180°, {settled_of(noisy, "starts")} settle.""",
        len(frame) + len(noisy) + decay.starts + bound.starts,
        instead="""Without measurement error and with one sign chosen at 180°, the error converges exponentially from
        every start: tan(θ/4) has the rate λ/2. With an arbitrarily small measurement error, there are starts from which
        it does not converge."""
        if word == Word.READING
        else "",
        measured=f"""Without noise, {settled_of(frame, "starts at rest")} settle. Largest ratio of tan(θ/4) to its
        exponential bound: {bound.largest_share:.4g}. With {level:g} rad of worst-case noise at 180°,
        {settled_of(noisy, "starts")} settle.""",
    )


@claim("LS03")
def ls03(results: Results) -> tuple[Word, Evidence]:
    """Paths from rest, and what a stored sign adds after a jump of the goal."""
    frame = at_rest(results, LAW)
    longest = float(frame["path_ratio"].max())
    kept = float(at_rest(results, WITH_MEMORY)["path_ratio"].max())
    jumps = {law: float(under(results, law, "goal-jump")["path_ratio"].max()) for law in (LAW, WITH_MEMORY)}
    return Word.HOLDS if longest < DETOUR else Word.FAILS, evidence(
        f"""From {len(frame):,} starts at rest, the longest path is {longest:.4f} times the shortest path. The same law
        with memory has {kept:.4f}. Memory costs path only where the stored sign is the wrong one, for example after a
        jump of the goal: the longest path is then {jumps[WITH_MEMORY]:.2f} times the shortest path with memory and
        {jumps[LAW]:.2f} times without. With memory, a body may turn at most {KEPT_DEG:.0f}° beyond 180°.""",
        len(frame),
        measured=f"""From {len(frame):,} starts at rest, the longest path is {longest:.4f} times the shortest. After a
        jump of the goal: {jumps[LAW]:.2f}, and {jumps[WITH_MEMORY]:.2f} with memory, which may go up to
        {KEPT_DEG:.0f}° beyond 180°.""",
    )


@claim("LS04")
def ls04(results: Results) -> tuple[Word, Evidence]:
    """Motions of the law in both frames from the same starts."""
    slide_rates(results)
    frames = results.found_by(motions.compare_frames, results.gains(), results.seed)
    turns = math.degrees(frames.apart_spinning)
    same_motion = max(frames.apart_at_rest, frames.apart_spinning) <= LIMIT.SAME_RAD
    if same_motion:
        word = Word.HOLDS
    else:
        word = Word.CORRECTED if frames.largest_angle_gap <= LIMIT.SAME_RAD else Word.FAILS
    return word, evidence(
        f"""From {frames.starts} starts, the angles to the goal with the two variables differ by at most
        {frames.largest_angle_gap:.0e} rad at any time. From rest, the two orientations differ by at most
        {frames.apart_at_rest:.0e} rad. From spinning starts they differ by up to {turns:.0f}° on the way.""",
        frames.starts,
        measured=f"""Greatest difference at one time: {frames.largest_angle_gap:.0e} rad in the angle to the goal. In
        orientation: {frames.apart_at_rest:.0e} rad from rest, {turns:.0f}° from spinning starts.""",
    )


@claim("LS05")
def ls05(results: Results) -> tuple[Word, Evidence]:
    """Starts at and near the poles of Euler angles, of this law and of one on Euler angles."""
    slide_rates(results)
    poles = episodes(results, LAW, "poles")
    euler = episodes(results, EULER, "poles")
    lost, lost_euler = (int((~settled(frame)).sum()) for frame in (poles, euler))
    is_unlike = not lost and lost_euler > 0
    return Word.HOLDS if is_unlike else Word.FAILS, evidence(
        f"""The start set poles has orientations at and near the poles of Z-Y-X angles. The law on the quaternion
        settles from {settled_of(poles, "starts")}. Feedback linearization on Z-Y-X angles settles from
        {settled_of(euler, "starts")}.""",
        len(poles) + len(euler),
        measured=f"""At and near the poles of Euler angles, {settled_of(poles, "starts")} settle with the quaternion,
        and {settled_of(euler, "starts")} with Z-Y-X angles.""",
    )


@claim("LS06")
def ls06(results: Results) -> tuple[Word, Evidence]:
    """Exact 180° rotations without noise and with noise: this law, one on the rotation matrix, and one with memory."""
    frame = at_rest(results, LAW)
    exact = at_half_turn(frame)
    smooth = at_half_turn(episodes(results, SMOOTH, "half-turn"))
    noisy, smooth_noisy, kept = (least_noise(results, law) for law in (LAW, SMOOTH, WITH_MEMORY))
    held = int((~settled(noisy)).sum())
    holds = results.found_by(motions.hold_by_noise, results.gains(), LIMIT.PERIODS_S, LIMIT.NOISE_SHARE)
    smaller, smaller_of = count_held(of_law(holds, LAW))
    smaller_kept, _ = count_held(of_law(holds, WITH_MEMORY))
    jump = read_field(results, LAW, "jump-half-turns")
    proof, proof_kept = (results.found_by(motions.read_proof, law) or "nothing" for law in (LAW, WITH_MEMORY))
    leaves = bool(settled(frame).all())
    word = Word.HOLDS if leaves and not held + smaller else Word.FAILS
    level, least = float(noisy["level"].iloc[0]), min(hold.noise_rad for hold in holds)
    shortest = 1e6 * min(hold.period_s for hold in holds)
    withstood = withstand_noise(results, WITH_MEMORY)
    return word, evidence(
        f"""Without noise, {settled_of(exact, "starts exactly at 180°")} settle; with the law on the rotation matrix,
        {settled_of(smooth, "starts")} settle. The difference is the jump of the command at 180°, which we see at
        {count_of(int(jump["found"]), int(jump["of"]), "such rotations")}. The jump is from 2 Kp to -2 Kp, so zero lies between. The
        quaternion is not the difference: q and -q give the same command, so this command is a function of the rotation
        matrix. With a noise of {level:g} rad, {settled_of(noisy, "starts")} settle. With the law on the rotation
        matrix, {settled_of(smooth_noisy, "starts")} settle, and with memory {settled_of(kept, "starts")}. At shorter
        control periods, a smaller noise is enough: {LIMIT.NOISE_SHARE:g} Kp period², down to {least:.0e} rad, holds
        {count_of(smaller, smaller_of, "starts")} at 180° without memory, and {count_of(smaller_kept, smaller_of,
        "starts")} with memory. The command `bench prove` proves of the law without memory: {proof}; with memory:
        {proof_kept}.""",
        len(frame) + len(smooth) + len(noisy) + len(smooth_noisy) + len(kept) + 2 * smaller_of,
        instead=f"""Without memory, the law reaches the goal from every start only if there is no measurement error. The
        jump at 180° does this, not the quaternion. An arbitrarily small error can hold the body at 180°. The law with a
        stored sign ({WITH_MEMORY}) leaves 180° with noise of up to {withstood:g} rad. The price is a turn of up to
        {KEPT_DEG:.0f}° beyond 180°."""
        if word == Word.FAILS
        else "",
        measured=f"""At exactly 180°, {settled_of(exact, "starts")} settle without noise. With {level:g} rad of
        noise, {settled_of(noisy, "starts")} settle, and with memory {settled_of(kept, "starts")}. At a period of
        {shortest:.0f} µs, {least:.0e} rad is enough.""",
    )


@claim("LS07")
def ls07(results: Results) -> tuple[Word, Evidence]:
    """No rows: the sentence is about other authors' works, and we could not read which."""
    return Word.UNTESTED, evidence(
        """The sentence is about five works of other authors, and we could not read the list of references. A sliding
        variable with the sign of the scalar part, s = ω + k sgn(q4) q_v, is in public code whose command is named
        after Crassidis (repository dtbinh/satellite, file satellite_adcs/controllerSliding.m). From memory: Crassidis,
        Vadali and Markley published this variable in 2000. This sign prevents unwinding as LS03 has it. We cannot say
        whether that work is one of the five.""",
        0,
    )


@claim("LS08")
def ls08(results: Results) -> tuple[Word, Evidence]:
    """No rows: the sentence is about other authors' works, and we could not read which."""
    return Word.UNTESTED, evidence(
        """The sentence is about four works of other authors, and we could not read the list of references.""", 0
    )


@claim("LS09")
def ls09(results: Results) -> tuple[Word, Evidence]:
    """Arms with our controllers, which do not decide: the paper's torque law could not be read."""
    rows = results.table("episodes", task="arm-regulation", regulator=LAW)
    number = settled_of(rows, "episodes")
    tried = f"On arms, with our Jacobians and inverses in place of that law, {number} of {LAW} settle."
    return Word.UNTESTED, evidence(
        f"""We could not read the torque law, so we cannot simulate it. {tried if len(rows) else ""} These episodes do
        not decide the claim.""",
        len(rows),
    )


@claim("LS10")
def ls10(results: Results) -> tuple[Word, Evidence]:
    """Goals that move, with their rate and acceleration given to the law."""
    slide_rates(results)
    frame = under(results, LAW, "moving-goal")
    lost = int((~settled(frame)).sum())
    decay = results.found_by(motions.measure_decay, results.gains())
    fastest = float(frame["level"].max())
    largest = math.degrees(float(np.nanmax(frame["tail_max_rad"])))
    is_exponential = decay.largest_error <= LIMIT.SLACK
    return Word.HOLDS if is_exponential and not lost else Word.FAILS, evidence(
        f"""Goals swing about two axes at peak rates from {frame["level"].min():g} to {fastest:g} rad/s.
        {capitalize(settled_of(frame, "starts"))} settle. In the last second, the largest angle to the goal is
        {largest:.2g}°, because the law is called only every millisecond. The reason holds for every goal whose rate and
        acceleration the law is given: seen from the goal, the error moves as in front of a fixed goal. There
        tan(θ/4) decays as LS02 has it, to {decay.largest_error:.0e}. The exception of LS06, the 180° rotation, is
        the same. {capitalize(count(len(frame), "episode"))} are a small sample.""",
        len(frame) + decay.starts,
        measured=f"""With goals that move at up to {fastest:g} rad/s, {settled_of(frame, "starts")} settle. Largest
        angle to the goal in the last second: {largest:.2g}°.""",
    )
