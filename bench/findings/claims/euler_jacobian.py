"""C18, C19, C34, C44: the Euler Jacobian J_E, its singularities, derivations, forms of angles; (2.2) by J on an arm."""

from __future__ import annotations

import functools
import itertools

import numpy as np

import tasks
from bench.base.on_first_use import pd
from bench.experiments.tables.read import FREE_BODY
from bench.experiments.tables.statistics import Estimate, quantile_estimate
from bench.findings.amounts import count_of, join_words, part_of
from bench.findings.claims import tables
from bench.findings.claims.degeneracy import condition_in
from bench.findings.claims.feedback_linearized import LAW
from bench.findings.claims.tables import (
    MAIN_ENGINE,
    Results,
    Share,
    evidence,
    percent_interval,
    share,
    some,
)
from bench.findings.claims.verdict import Evidence, NoEvidence, Word, claim, read_limits, word_of
from bench.findings.start_sets import least_starts
from bench.law.contenders.registry import representation

LIMIT = read_limits(__file__)


COORDINATES = "zyx-euler"

WELL_CONDITIONED = 50.0
"""Condition number of J, in metres and radians, up to which the manipulator is not to blame: six times the 7.9 of the
PUMA's stock pose; a milliradian off a wrist singularity it is in the thousands."""


EPS = 2.0**-52
ROUNDINGS = 100.0
"""A determinant or a product of 6 x 6 sums 36 rounded terms; R itself is orthonormal to a few eps only. What is
divided by cos(beta) errs by as many eps over the margin."""

AWAY, NEAR = 1e-3, 1e-6
"""The margin cos(beta) from which on agreement is required for a correction (AWAY) and to hold (NEAR)."""

DIFFERENCED = EPS ** (2 / 3)
"""What a central difference keeps: with a step of eps^(1/3) times the margin, truncation (step/margin)^2/3 and
rounding eps/step are both about eps^(2/3), over the margin."""


@claim("C18")
def c18(results: Results) -> tuple[Word, Evidence]:
    """Slopes towards the pole by family, the largest element on arrival, and the determinants' identity."""
    rows = some(results.table("poses", representation=COORDINATES), "pose of an arm")
    ways = _families(rows)
    silent = sorted(set(rows["arm"]) - set(ways["arm"]))
    if silent:
        raise NoEvidence(f"no well-conditioned family of poses towards the pole on {', '.join(silent)}")
    square = some(rows[rows["det_gap"].notna() & (rows["margin"] >= NEAR)], "pose of an arm with six joints")
    slopes = ways[["condition_analytic", "largest"]].to_numpy()
    errors = square["det_gap"] * square["margin"] / EPS
    tight = (
        abs(slopes - LIMIT.SLOPE).max() <= LIMIT.SLOPE_TIGHT * LIMIT.SLOPE
        and (ways["nearest"] >= LIMIT.UNBOUNDED).all()
    )
    has_own = tight and (errors <= ROUNDINGS).all()
    word = word_of(has_own and rows["largest"].min() <= ROUNDINGS * EPS, has_own)
    well = some(rows[(rows["pose_set"] == "random") & (rows["condition"] <= WELL_CONDITIONED)], "random pose")
    worse = share(well["condition_analytic"] > 10 * well["condition"])
    return word, evidence(
        f"""A family is one posture of an arm, brought to several distances from a pole (beta = +-pi/2). We use
        {len(ways)} families on {rows["arm"].nunique()} arms. In these families, the condition number of the Jacobian J
        is at most {ways["condition"].max():.0f}. Each time the distance from the pole becomes ten times smaller, log10
        of the condition number of the Euler Jacobian J_E grows by {slopes[:, 0].min():.3f} to {slopes[:, 0].max():.3f},
        and log10 of the largest element of J_E grows by {slopes[:, 1].min():.3f} to {slopes[:, 1].max():.3f}. (These
        numbers are slopes by least squares.) At 1e-{LIMIT.NEAREST} rad from the pole, the largest element of J_E is
        {ways["nearest"].min():.1e} or more. At {len(square):,} poses, det J_E is equal to -det J / cos(beta), with an
        error of at most {errors.max():.1f} eps / cos(beta). We also used the random poses where the condition number
        of J is at most {WELL_CONDITIONED:g}. At {worse} of these poses, the condition number of J_E is more than ten
        times that of J. At every pose, the largest element of J_E is at least {rows["largest"].min():.2f}. Therefore
        J_E is not a zero matrix at any pose.""",
        len(rows),
        measured=f"""At 1e-{LIMIT.NEAREST} rad from a pole, elements of the Euler Jacobian J_E reach
        {ways["nearest"].max():.0e}. At {percent_interval(worse)} of the random poses where the Jacobian J is well
        conditioned, the condition number of J_E is more than ten times that of J.""",
    )


def _families(rows: pd.DataFrame) -> pd.DataFrame:
    """Each family that speaks: slopes over the first decades, the largest element at the last, J's worst condition."""
    pole = rows[rows["pose_set"] == "pole"]
    ids = pole["pose_id"].astype(str).str.extract(r"^(?P<family>.+)-1e-(?P<k>\d+)$")
    found = []
    for (arm, _), way in pole.assign(**ids).dropna(subset="k").groupby(["arm", "family"], observed=True):
        k = way["k"].astype(int)
        if way["condition"].max() > WELL_CONDITIONED or not {*range(1, LIMIT.DECADES + 1), LIMIT.NEAREST} <= set(k):
            continue
        near = way[k <= LIMIT.DECADES]
        decades = -np.log10(near["margin"])
        slopes = {name: np.polyfit(decades, np.log10(near[name]), 1)[0] for name in ("condition_analytic", "largest")}
        nearest, condition = float(way.loc[k == LIMIT.NEAREST, "largest"].iloc[0]), way["condition"].max()
        found.append({"arm": str(arm), **slopes, "nearest": nearest, "condition": condition})
    return pd.DataFrame(found, columns=["arm", "condition_analytic", "largest", "nearest", "condition"])


@claim("C19")
def c19(results: Results) -> tuple[Word, Evidence]:
    """Both gaps at every pose away from the pole, in the units of what rounding leaves."""
    rows = some(results.table("poses", representation=COORDINATES), "pose of an arm")
    rows = some(rows[rows["margin"] >= NEAR], f"pose with cos(beta) of {NEAR:g} or more")
    differenced = rows[rows["pose_set"] != "slice"]
    for name, found in (("derivation_gap", rows), ("difference_gap", differenced)):
        silent = sorted(set(rows["arm"]) - set(found.loc[found[name].notna(), "arm"]))
        if silent:
            raise NoEvidence(f"no {name} of any pose of {', '.join(silent)}")
    kept = differenced[differenced["difference_gap"].notna()]
    derived = (rows["derivation_gap"] * rows["margin"] / EPS).fillna(np.inf)
    measured = kept["difference_gap"] * kept["margin"] / DIFFERENCED
    away = derived[rows["margin"] >= AWAY], measured[kept["margin"] >= AWAY]
    everywhere = derived.max() <= ROUNDINGS and measured.max() <= ROUNDINGS
    word = word_of(everywhere, all((part <= ROUNDINGS).all() for part in away))
    return word, evidence(
        f"""At {len(rows):,} poses of {rows["arm"].nunique()} arms, the Jacobians by (3.3) and by (3.5) differ by at
        most {derived.max():.1f} eps / cos(beta) times the largest element. At {len(kept):,} of these poses, we also
        differentiated the forward kinematics numerically. This result and the Jacobian by (3.3) differ by at most
        {measured.max():.1f} eps^(2/3) / cos(beta) times the largest element. We left out the poses at which an angle
        jumps between the two points of the finite difference ({part_of(len(differenced) - len(kept), len(differenced))}
        poses).""",
        len(rows),
        measured=f"""At {len(rows):,} poses, the Jacobians by the two derivations differ by at most {derived.max():.1f}
        eps / cos(beta) times the largest element. This is rounding (eps = 2.2e-16).""",
    )


NAMED = {form: "-".join(form[:3].upper()) for form in (*LIMIT.REGULAR, LIMIT.AT_ZERO)}
"""What forms of Euler angles are called in sentences."""

HEADS = (
    "Form",
    "Uniform starts that never settle",
    "Median settling time from uniform starts",
    "Starts near 180° that never settle",
    "Median settling time from starts near 180°",
    "Exponent n: towards the pole, the condition number of B grows as (1 / distance)ⁿ",
)
"""Heads of what was measured of a form."""


@claim("C34")
def c34(results: Results) -> tuple[Word, Evidence]:
    """Pairs of forms by how their laws settle, and each form's Jacobian at its pole."""
    forms = (*LIMIT.REGULAR, LIMIT.AT_ZERO)
    episodes = results.table("episodes", **FREE_BODY, task="free-body", regulator=LAW, engine=MAIN_ENGINE)
    found: dict[str, dict[str, tuple[Share, Estimate]]] = {form: {} for form in forms}
    for name in LIMIT.SETS:
        rows = [episodes[(episodes["representation"] == form) & (episodes["start_set"] == name)] for form in forms]
        for form, own in zip(forms, rows, strict=True):
            some(own, f"episode of {LAW}/{form} from {name}")
            results.check_starts(own, f"{LAW}/{form}", least_starts(MAIN_ENGINE, "beyond"), name)
        for form, own in zip(forms, tables.same_starts(rows), strict=True):
            found[form][name] = share(tables.settled(own)), quantile_estimate(tables.settling_times(own), 0.5)
    degenerate = {form: _degenerates(form) for form in forms}
    alike = {
        (one, two): degenerate[one][0]
        and degenerate[two][0]
        and all(_alike(found[one][name], found[two][name]) for name in LIMIT.SETS)
        for one, two in itertools.combinations(forms, 2)
    }
    rows = [(NAMED[form], *_numbers(found[form]), degenerate[form][1]) for form in forms]
    near_180 = {form: own[LIMIT.SETS[-1]][0] for form, own in found.items()}
    lost_by_form = join_words([
        f"{kept.n - kept.k} never settle with {NAMED[form]} angles" for form, kept in near_180.items()
    ])
    starts = max(kept.n for kept in near_180.values())
    return word_of(all(alike.values()), alike[LIMIT.REGULAR] and not all(alike.values())), evidence(
        f"""We compared feedback linearization in {len(forms)} forms of Euler angles. For each form, we counted the
        starts that never settle, and computed the median settling time. We also computed how the condition number of B
        grows towards the pole of the form. These forms give the same results:
        {"; ".join(" and ".join(NAMED[form] for form in pair) for pair, facts in alike.items() if facts) or "none"}.""",
        sum(kept.n for own in found.values() for kept, _ in own.values())
        + len(forms) * LIMIT.PAIRS * LIMIT.FORM_DECADES,
        measured=f"We simulated feedback linearization. Of {starts} starts near 180°, {lost_by_form}.",
        numbers=(HEADS, *rows),
    )


def _alike(one: tuple[Share, Estimate], two: tuple[Share, Estimate]) -> bool:
    """Whether shares and medians are the same for the most part."""
    (kept, time), (other_kept, other_time) = one, two
    meet = time.low <= other_time.high and other_time.low <= time.high
    same = meet or abs(time.value / other_time.value - 1) <= LIMIT.TIMES
    return abs(kept.value - other_kept.value) <= LIMIT.SHARES and same


def _degenerates(form: str) -> tuple[bool, str]:
    """Whether a form's B has C18's slope at its pole, and what it is."""
    along, at_pole = representation(form), 0.0 if form == LIMIT.AT_ZERO else np.pi / 2
    outer = np.random.default_rng(0).uniform(-3.0, 3.0, (LIMIT.PAIRS, 2)).tolist()
    near = [at_pole + 10.0**-k for k in range(1, LIMIT.FORM_DECADES + 1)]
    logs = [[np.log10(condition_in(form, along.to_matrix((one, x, two)))) for x in near] for one, two in outer]
    slopes = np.diff(logs, axis=1)
    tight = np.abs(slopes - LIMIT.SLOPE).max() <= LIMIT.SLOPE_TIGHT * LIMIT.SLOPE
    least, most = f"{slopes.min():.3f}", f"{slopes.max():.3f}"
    return bool(tight), f"n = {least}" if least == most else f"n = {least} to {most}"


def _numbers(found: dict[str, tuple[Share, Estimate]]) -> list[str]:
    """Return how many starts of each set are lost, and the median settling time."""
    return [
        text
        for kept, time in found.values()
        for text in (count_of(kept.n - kept.k, kept.n, "starts"), f"{time.value:.3f} s")
    ]


@claim("C44")
def c44(results: Results) -> tuple[Word, Evidence]:
    """Accelerations of the hand under (2.2), with the arm's own model and with a wrong one."""
    arms = [name for name in LIMIT.ARMS if tasks.arm(name).joints == 6]
    right, wrong = (
        [results.found_by(accelerations, arm, one, results.seed) for arm in arms] for one in ("", LIMIT.OFF)
    )
    exact, off = (max(float(gaps.max()) for gaps in found) for found in (right, wrong))
    typical = float(np.median(np.concatenate(wrong)))
    return word_of(exact <= LIMIT.SAME < off, False), evidence(
        f"""We tested {LIMIT.POSES} random states of each arm ({", ".join(arms)}). Equation (2.2) gives the torques, and
        MuJoCo gives the accelerations of the joints under these torques. From them, we computed the acceleration of the
        hand. It differs from the input u by at most {exact:.0e} |u|. If all masses of the arm are
        {LIMIT.OFF.partition("-")[2]} times those of the model, the median difference is {typical:.2g} |u|.""",
        2 * LIMIT.POSES * len(arms),
        measured=f"""In {LIMIT.POSES * len(arms)} states, the acceleration of the hand differs from the
        input u by at most {exact:.0e} |u|. If all masses of the arm are {LIMIT.OFF.partition("-")[2]} times
        those of the model, the median difference is {typical:.2g} |u|.""",
    )


@functools.cache
def accelerations(name: str, variation: str, seed: int) -> np.ndarray:
    """Compute |xddot - u| / |u| of an arm under (2.2) at random states; a variation makes the plant another one."""
    import mujoco

    from tasks.arm_model import model_xml
    from tasks.kinematics import Kinematics

    arm = tasks.arm(name)
    judge, plant = Kinematics(arm), mujoco.MjModel.from_xml_string(model_xml(arm, 1e-3))
    if variation:
        tasks.variation(variation).apply(plant, arm.rated)
    model, jacobian = judge.model, judge.jacobian
    data, body = mujoco.MjData(model), mujoco.MjData(plant)
    rng, gaps = np.random.default_rng(seed), []
    for _ in range(LIMIT.POSES):
        q = np.array(arm.home) + rng.uniform(-LIMIT.AROUND_RAD, LIMIT.AROUND_RAD, model.nv)
        qdot, u = rng.uniform(-1.0, 1.0, model.nv), rng.uniform(-1.0, 1.0, 6)
        J = jacobian(q)
        Jdot = (jacobian(q + LIMIT.STEP_S * qdot) - jacobian(q - LIMIT.STEP_S * qdot)) / (2 * LIMIT.STEP_S)
        data.qpos[:], data.qvel[:] = q, qdot
        mujoco.mj_forward(model, data)
        fg = data.qfrc_bias - data.qfrc_passive
        body.qpos[:], body.qvel[:] = q, qdot
        body.qfrc_applied[:] = judge.inertia_matrix(q) @ np.linalg.solve(J, u - Jdot @ qdot) + fg
        mujoco.mj_forward(plant, body)
        ends = []
        for t in (-LIMIT.STEP_S, LIMIT.STEP_S):  # J(q) qdot along the motion that follows, to second order in t
            ends.append(jacobian(q + t * qdot + t * t / 2 * body.qacc) @ (qdot + t * body.qacc))
        gaps.append(np.linalg.norm((ends[1] - ends[0]) / (2 * LIMIT.STEP_S) - u) / np.linalg.norm(u))
    return np.array(gaps)
