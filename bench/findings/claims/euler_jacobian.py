"""C18, C19, C34, C44: the Euler Jacobian J_E, its singularities, derivations, forms of angles; (2.2) by J on an arm."""

from __future__ import annotations

import itertools
import re

import numpy as np

from bench.base.errors import NoEvidence
from bench.base.on_first_use import pd
from bench.experiments.probe_values import arms, coordinates
from bench.experiments.tables.run import FREE_BODY, MAIN_ENGINE, Run, require_rows
from bench.experiments.tables.statistics import Estimate, quantile_estimate
from bench.findings.amounts import count_of, join_words, part_of
from bench.findings.claims import tables
from bench.findings.claims.feedback_linearized import LAW
from bench.findings.claims.tables import Share, check_starts, evidence, percent_interval, share
from bench.findings.claims.verdict import Evidence, Word, claim, word_of
from bench.findings.start_sets import least_starts

# Decades a decade. cond B = (1 + |sin beta|)/cos beta is 2/d to a relative d^2 at a distance d; the constant between
# it and J_E, at most cond J, bends the first decade or two. 5 % of a fit over 8 decades is a factor of 2.5 in all.
SLOPE = 1.0
SLOPE_TIGHT = 0.05
# Decades that the slopes are of; beyond them cos(beta) is known to less than 1e-8.
DECADES = 8
# Largest element at 10^-12 from the pole: 1/d, less a factor 100 for J's own elements.
UNBOUNDED = 1e10
NEAREST = 12
# Forms whose degenerate orientations are a quarter turn from zero, and one that is degenerate at zero.
REGULAR = ("zyx-euler", "xyz-euler")
AT_ZERO = "zyz-euler"
# Points of a share, and relative difference of a median time, up to which results are the same 'for the most part'.
SHARES = 0.05
TIMES = 0.05
# Starts that no form of angles was asked for.
SETS = ("uniform", "half-turn")
ARMS, POSES, OFF = arms.SIX_JOINTS, arms.STATES, arms.OFF
FORM_DECADES, PAIRS = coordinates.FORM_DECADES, coordinates.PAIRS
SAME = 1e-5


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
def c18(run: Run) -> tuple[Word, Evidence]:
    """Slopes towards the pole by family, the largest element on arrival, and the determinants' identity."""
    rows = require_rows(run.table("poses", representation=COORDINATES), "pose of an arm")
    ways = _families(rows)
    silent = sorted(set(rows["arm"]) - set(ways["arm"]))
    if silent:
        raise NoEvidence(f"no well-conditioned family of poses towards the pole on {', '.join(silent)}")
    square = require_rows(rows[rows["det_gap"].notna() & (rows["margin"] >= NEAR)], "pose of an arm with six joints")
    slopes = ways[["condition_analytic", "largest"]].to_numpy()
    errors = square["det_gap"] * square["margin"] / EPS
    tight = (
        abs(slopes - SLOPE).max() <= SLOPE_TIGHT * SLOPE
        and (ways["nearest"] >= UNBOUNDED).all()
    )
    has_own = tight and (errors <= ROUNDINGS).all()
    word = word_of(has_own and rows["largest"].min() <= ROUNDINGS * EPS, has_own)
    well = require_rows(rows[(rows["pose_set"] == "random") & (rows["condition"] <= WELL_CONDITIONED)], "random pose")
    worse = share(well["condition_analytic"] > 10 * well["condition"])
    return word, evidence(
        f"""A family is one posture of an arm, brought to several distances from a pole (beta = +-pi/2). We use
        {len(ways)} families on {rows["arm"].nunique()} arms. In these families, the condition number of the Jacobian J
        is at most {ways["condition"].max():.0f}. Each time the distance from the pole becomes ten times smaller, log10
        of the condition number of the Euler Jacobian J_E grows by {slopes[:, 0].min():.3f} to {slopes[:, 0].max():.3f},
        and log10 of the largest element of J_E grows by {slopes[:, 1].min():.3f} to {slopes[:, 1].max():.3f}. (These
        numbers are slopes by least squares.) At 1e-{NEAREST} rad from the pole, the largest element of J_E is
        {ways["nearest"].min():.1e} or more. At {len(square):,} poses, det J_E is equal to -det J / cos(beta), with an
        error of at most {errors.max():.1f} eps / cos(beta). We also used the random poses where the condition number
        of J is at most {WELL_CONDITIONED:g}. At {worse} of these poses, the condition number of J_E is more than ten
        times that of J. At every pose, the largest element of J_E is at least {rows["largest"].min():.2f}. Therefore
        J_E is not a zero matrix at any pose.""",
        len(rows),
        measured=f"""At 1e-{NEAREST} rad from a pole, elements of the Euler Jacobian J_E reach
        {ways["nearest"].max():.0e}. At {percent_interval(worse)} of the random poses where the Jacobian J is well
        conditioned, the condition number of J_E is more than ten times that of J.""",
    )


OF_FAMILY = re.compile(r"(?P<family>.+)-1e-(?P<k>\d+)")
"""The name of a pose at 10^-k from the pole."""


def _families(rows: pd.DataFrame) -> pd.DataFrame:
    """Each family that speaks: slopes over the first decades, the largest element at the last, J's worst condition."""
    pole = rows[rows["pose_set"] == "pole"]
    numbers = {name: pole[name].to_numpy(float) for name in ("margin", "condition", "condition_analytic", "largest")}
    places: dict[tuple[str, str], dict[int, int]] = {}
    for place, (arm, pose) in enumerate(zip(pole["arm"], pole["pose_id"], strict=True)):
        named = OF_FAMILY.fullmatch(pose)
        if named:
            places.setdefault((arm, named["family"]), {})[int(named["k"])] = place
    found = []
    for (arm, _), place_of in sorted(places.items()):
        way = {name: column[list(place_of.values())] for name, column in numbers.items()}
        if way["condition"].max() > WELL_CONDITIONED or not {*range(1, DECADES + 1), NEAREST} <= set(place_of):
            continue
        near = [place_of[k] for k in sorted(place_of) if k <= DECADES]
        decades = -np.log10(numbers["margin"][near])
        logarithms = np.log10([numbers[name][near] for name in ("condition_analytic", "largest")])
        analytic, largest = np.polyfit(decades, logarithms.T, 1)[0].tolist()
        nearest = float(numbers["largest"][place_of[NEAREST]])
        found.append((arm, analytic, largest, nearest, float(way["condition"].max())))
    return pd.DataFrame(found, columns=["arm", "condition_analytic", "largest", "nearest", "condition"])


@claim("C19")
def c19(run: Run) -> tuple[Word, Evidence]:
    """Both gaps at every pose away from the pole, in the units of what rounding leaves."""
    rows = require_rows(run.table("poses", representation=COORDINATES), "pose of an arm")
    rows = require_rows(rows[rows["margin"] >= NEAR], f"pose with cos(beta) of {NEAR:g} or more")
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


NAMED = {form: "-".join(form[:3].upper()) for form in (*REGULAR, AT_ZERO)}
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
def c34(run: Run) -> tuple[Word, Evidence]:
    """Pairs of forms by how their laws settle, and each form's Jacobian at its pole."""
    forms = (*REGULAR, AT_ZERO)
    episodes = run.table("episodes", **FREE_BODY, task="free-body", regulator=LAW, engine=MAIN_ENGINE)
    found: dict[str, dict[str, tuple[Share, Estimate]]] = {form: {} for form in forms}
    for name in SETS:
        rows = [episodes[(episodes["representation"] == form) & (episodes["start_set"] == name)] for form in forms]
        for form, own in zip(forms, rows, strict=True):
            require_rows(own, f"episode of {LAW}/{form} from {name}")
            check_starts(run, own, f"{LAW}/{form}", least_starts(MAIN_ENGINE, "beyond"), name)
        for form, own in zip(forms, tables.same_starts(rows), strict=True):
            found[form][name] = share(tables.settled(own)), quantile_estimate(tables.settling_times(own), 0.5)
    conditions = run.probe("forms")
    degenerate = {form: _degenerates(conditions[conditions["representation"] == form]) for form in forms}
    alike = {
        (one, two): degenerate[one][0]
        and degenerate[two][0]
        and all(_alike(found[one][name], found[two][name]) for name in SETS)
        for one, two in itertools.combinations(forms, 2)
    }
    rows = [(NAMED[form], *_numbers(found[form]), degenerate[form][1]) for form in forms]
    near_180 = {form: own[SETS[-1]][0] for form, own in found.items()}
    lost_by_form = join_words([
        f"{kept.n - kept.k} never settle with {NAMED[form]} angles" for form, kept in near_180.items()
    ])
    starts = max(kept.n for kept in near_180.values())
    return word_of(all(alike.values()), alike[REGULAR] and not all(alike.values())), evidence(
        f"""We compared feedback linearization in {len(forms)} forms of Euler angles. For each form, we counted the
        starts that never settle, and computed the median settling time. We also computed how the condition number of B
        grows towards the pole of the form. These forms give the same results:
        {"; ".join(" and ".join(NAMED[form] for form in pair) for pair, facts in alike.items() if facts) or "none"}.""",
        sum(kept.n for own in found.values() for kept, _ in own.values()) + len(conditions),
        measured=f"We simulated feedback linearization. Of {starts} starts near 180°, {lost_by_form}.",
        numbers=(HEADS, *rows),
    )


def _alike(one: tuple[Share, Estimate], two: tuple[Share, Estimate]) -> bool:
    """Whether shares and medians are the same for the most part."""
    (kept, time), (other_kept, other_time) = one, two
    meet = time.low <= other_time.high and other_time.low <= time.high
    same = meet or abs(time.value / other_time.value - 1) <= TIMES
    return abs(kept.value - other_kept.value) <= SHARES and same


def _degenerates(rows: pd.DataFrame) -> tuple[bool, str]:
    """Whether a form's B has C18's slope towards its pole, and what it is; rows: of the probe `forms`."""
    conditions = require_rows(rows, "condition number of a form").pivot(index="case", columns="at", values="condition")
    towards_pole = conditions.sort_index(axis=1, ascending=False)
    slopes = np.diff(np.log10(towards_pole.to_numpy()), axis=1)
    tight = np.abs(slopes - SLOPE).max() <= SLOPE_TIGHT * SLOPE
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
def c44(run: Run) -> tuple[Word, Evidence]:
    """Accelerations of the hand under (2.2), with the arm's own model and with a wrong one."""
    rows = run.probe("arm-acceleration")
    is_right = rows["at"] == 1.0
    names = list(dict.fromkeys(rows["arm"].astype(str)))
    wrong = rows.loc[~is_right, "acceleration_gap"]
    exact = float(rows.loc[is_right, "acceleration_gap"].max())
    off = min(float(gaps.max()) for _, gaps in wrong.groupby(rows["arm"], observed=True))
    typical = float(wrong.median())
    return word_of(exact <= SAME < off, False), evidence(
        f"""We tested {POSES} random states of each arm ({", ".join(names)}). Equation (2.2) gives the torques, and
        MuJoCo gives the accelerations of the joints under these torques. From them, we computed the acceleration of the
        hand. It differs from the input u by at most {exact:.0e} |u|. If all masses of the arm are
        {OFF.partition("-")[2]} times those of the model, the median difference is {typical:.2g} |u|.""",
        len(rows),
        measured=f"""In {int(is_right.sum())} states, the acceleration of the hand differs from the
        input u by at most {exact:.0e} |u|. If all masses of the arm are {OFF.partition("-")[2]} times
        those of the model, the median difference is {typical:.2g} |u|.""",
    )
