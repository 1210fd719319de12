"""C22 to C24: about which axes Euler angles comply, measured in free space (Murphy 1988, 3.3)."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from bench.base.on_first_use import pd
from bench.experiments.tables.run import Run, require_rows
from bench.findings.amounts import count, count_of, join_words, part_of
from bench.findings.claims import places, side_by_side
from bench.findings.claims.euler_jacobian import COORDINATES
from bench.findings.claims.tables import evidence, percent, rounding
from bench.findings.claims.verdict import Evidence, Word, claim, word_of

ONE_AXIS = ("about x", "about y", "about z")
ANGLES = ("alpha", "beta", "gamma")
# The angles that come before the one that complies, by order.
EARLIER = {'about x': (1, 1, 0), 'about y': (1, 0, 0), 'about z': (0, 0, 0)}
# Distance of two matrices of compliance, over the size of the reference: ten times the 1e-3 that a sampled plant
# leaves of the closed form, and less than half of what one degree makes of an axis, sqrt(2) sin(1 deg) = 0.025.
SAME = 0.01
# cos(beta) under which a pose is reported and does not decide: within 3 degrees of the pole B's condition number is
# above 40 and the controller's failures are those of C18 and C20.
CLOSE_TO_POLE = 0.05
# An angle that is not zero is at least this; zero is below a billionth.
APART_DEG = 1.0
# Relative, of what theory says, or of tan 5 deg where that is more.
LEAK = 0.01
SMALL_DEG = 5.0
# rad, between measured and predicted tilt of a plane: a hand that turns by 3 mrad tilts its own axes by as much.
PLANE_RAD = 0.005
ZYZ = "zyz-euler"
ORDER = "about x"
# What rounding may make of an angle that a pose is named after.
ZERO_RAD = 1e-9
SLACK_DEG = 1e-6
# What 'near zero' is; and the share of the wanted compliance under which something is a problem.
NEAR_DEG = 15.0
LITTLE = 0.5
# Rotation about z over that about x from which on a hand turns about another axis than the compliant one.
MOST_LEAK = 1.0


MEANT = (
    "Euler compliance is the compliance of the controller hybrid/zyx-euler. Cartesian compliance is "
    "the compliance of the controller hybrid-base."
)
"""What the two compliances are called in sentences."""

TWO_AXES = ("about x and y", "about y and z", "about z and x")
LEVEL_PAIR = TWO_AXES[0]


@claim("C22")
def c22(run: Run) -> tuple[Word, Evidence]:
    """One angle against one axis, by both ways to control forces."""
    word, found = _one_axis(run)
    turns = run.probe("axes-of-angles")
    by_alpha, by_gamma = float(turns["alpha_gap"].max()), float(turns["gamma_gap"].max())
    axes = (
        f"If one Euler angle changes, the hand turns about one axis, the axis of this angle. At {len(turns)} "
        f"orientations, the axis of alpha is the base's z axis, and the axis of gamma is the hand's x axis. The "
        f"components of the unit vectors differ by at most {rounding(by_alpha)} for alpha and {rounding(by_gamma)} "
        f"for gamma. {MEANT}"
    )
    return word, found._replace(sentence=f"{axes} {found.sentence}")


@side_by_side.by_either_form
def _one_axis(run: Run, forms: tuple[str, ...]) -> Any:
    """Measured compliance of one angle against that of one axis, as it is and turned by the angles before."""
    rows = side_by_side.beside_base(run, COORDINATES, ONE_AXIS, forms)
    away = (rows["cos_beta"] >= CLOSE_TO_POLE).to_numpy()
    earlier = rows[list(ANGLES)].to_numpy() * np.array([EARLIER[order] for order in rows["complies"]])
    is_turned = away & (np.degrees(np.abs(earlier).max(axis=1)) >= APART_DEG)
    for order in ONE_AXIS:
        own = (rows["complies"] == order).to_numpy()
        require_rows(
            rows[own & (is_turned if any(EARLIER[order]) else away)],
            f"pose that tells angle and axis apart, {order}",
        )
    C, base = side_by_side.compliances(rows), side_by_side.compliances(rows, "_base")
    differs = side_by_side.apart(C, base)
    turns = (places.matrices_of(angles) for angles in (earlier, rows[list(ANGLES)].to_numpy()))
    differs_turned, differs_in_hand = (side_by_side.apart(C, side_by_side.turned(base, Q)) for Q in turns)
    word = word_of((differs[away] <= SAME).all(), (differs_turned[away] <= SAME).all())
    judged = rows.assign(
        same=differs <= SAME,
        same_turned=differs_turned <= SAME,
        same_in_hand=differs_in_hand <= SAME,
    )[away]
    ends = rows.loc[~away, "outcome"].astype(str).value_counts()
    close = join_words(f"'{end}' in {count(n, 'case')}" for end, n in ends.items())
    return word, evidence(
        f"""A case is one compliant axis at one pose of one arm, with one variant of force control. We
        tested {judged["arm"].nunique()} arms. Euler compliance is the same as Cartesian compliance
        about the base's axes {_by_order(judged, "same")}. In the other cases, the norm of the
        difference is up to {_greatest(differs[away]):.2f} times the norm of the Cartesian
        compliance. In a sequence of Euler angles, the angles in front of the compliant angle turn its axis. If the
        Cartesian compliance is turned in the same way, the norm of the difference is at most
        {_greatest(differs_turned[away]):.2g} times the norm of the Cartesian compliance. Euler
        compliance is the same as compliance about the hand's own axes
        {_by_order(judged, "same_in_hand")}. These numbers leave out the poses with cos(beta) <
        {CLOSE_TO_POLE:g}, which are close to a pole.
        {f"At these poses, the outcome with Euler compliance is {close}." if close else ""}""",
        len(rows),
        instead=f"""If one Euler angle is compliant, the hand complies about one axis of the base
        {_by_order(judged, "same")}. In a sequence of Euler angles, the angles in front of the compliant angle turn its
        axis. The hand complies about this turned axis {_by_order(judged, "same_turned")}.""",
        measured=f"""In {count_of(int(judged["same_turned"].sum()), len(judged), "tests")}, the hand
        complies only about the axis of the compliant Euler angle.""",
    )


def _by_order(rows: pd.DataFrame, fact: str) -> str:
    """Return in how many cases a fact is true, by order: 'in 3 of 12 cases with compliance about x'."""
    parts = []
    for order, cases in rows.groupby("complies")[fact]:
        parts.append(f"in {part_of(int(cases.sum()), len(cases))} cases with compliance {order}")
    return join_words(parts)


def _greatest(numbers: np.ndarray) -> float:
    """Return the greatest of those that were measured."""
    return float(np.nanmax(numbers, initial=-np.inf))


@claim("C23")
@side_by_side.by_papers_form
def c23(run: Run, forms: tuple[str, ...]) -> tuple[Word, Evidence]:
    """Measured compliance of two angles against that of two axes: apart or not, and by how much in theory."""
    rows = side_by_side.beside_base(run, COORDINATES, TWO_AXES, forms)
    rows = rows[rows["cos_beta"] >= CLOSE_TO_POLE].reset_index(drop=True)
    general = (np.degrees(rows[list(ANGLES)].abs()) >= APART_DEG).all(axis=1).to_numpy()
    for order in TWO_AXES:
        of_order = rows[general & (rows["complies"] == order)]
        require_rows(of_order, f"pose with no angle zero and B^-1 well conditioned, {order}")
    C, base = side_by_side.compliances(rows), side_by_side.compliances(rows, "_base")
    differs = side_by_side.apart(C, base)
    parted = differs[general] > SAME
    level = (rows["complies"] == LEVEL_PAIR).to_numpy()
    own, beta = rows[level], rows.loc[level, "beta"].abs().to_numpy()
    leak, by_base = (_leak(own, one[level]) for one in (C, base))
    expected, of_base = side_by_side.predicted(own, COORDINATES), side_by_side.predicted(own)
    missed = np.maximum(_missed(leak, _leak(own, expected)), _missed(by_base, _leak(own, of_base)))
    tilt = np.maximum(*map(side_by_side.planes_apart, (C[level], base[level]), (expected, of_base)))
    as_predicted = (missed <= LEAK).all() and (tilt <= PLANE_RAD).all()
    word = word_of(parted.all() and as_predicted, parted.mean() > 0.5)
    least = float(np.nanmin(differs[general], initial=np.inf))
    special = _by_order(rows.assign(same=differs <= SAME)[~general], "same") or "in no case"
    return word, evidence(
        f"""A case is one pair of compliant axes at one pose of one arm, with one variant of force control. {MEANT} If
        none of the Euler angles is zero, the two compliances differ in
        {count_of(int(parted.sum()), len(parted), "cases")}. The norm of the difference is at least {least:.2f} times
        the norm of the Cartesian compliance. If an Euler angle is zero, the two compliances are the same {special}. We
        tested compliance {LEVEL_PAIR} in {int(level.sum())} cases, up to |beta| = {math.degrees(beta.max()):.0f}
        degrees, on {rows["arm"].nunique()} arms. The compliant plane is the plane of the axes about which the hand
        turns most. The measured planes of both controllers differ from the predicted planes by at most
        {_greatest(tilt):.1e} rad. A moment about the level axis (cos alpha, sin alpha, 0) also turns the hand about z.
        We divide the rotation about z by the rotation about the level axis. The measured ratio differs from the
        predicted ratio by at most {_greatest(missed):.1e} times the predicted ratio. (Where the predicted ratio is
        smaller than tan {SMALL_DEG:g} degrees, we divide the difference by tan {SMALL_DEG:g} degrees
        instead.) With Euler compliance, the ratio is at most {_greatest(leak):.2f}. For comparison, tan |beta| is at
        most {_greatest(np.tan(beta)):.2f}. With Cartesian compliance, the ratio is at most
        {_greatest(by_base):.2g}.""",
        len(rows),
        measured=f"""In {count_of(int(parted.sum()), len(parted), "tests")} where no Euler angle is
        zero, compliance in two Euler angles differs from Cartesian compliance about two axes. The
        difference is {percent(least)} % of the Cartesian compliance or more.""",
    )


def _missed(leak: np.ndarray, wanted: np.ndarray) -> np.ndarray:
    """|leak - wanted| over what is wanted, or over the tangent of a small angle."""
    return np.abs(leak - wanted) / np.maximum(wanted, math.tan(math.radians(SMALL_DEG)))


def _leak(rows: pd.DataFrame, C: np.ndarray) -> np.ndarray:
    """|c_zl / c_ll|, n: of a moment about the level axis l the rotation about z over that about l."""
    level = np.stack([np.cos(rows["alpha"]), np.sin(rows["alpha"]), np.zeros(len(rows))], axis=1)
    turn = np.einsum("nij,nj->ni", C, level)
    return np.abs(turn[:, 2] / np.sum(turn * level, axis=1))


@claim("C24")
@side_by_side.by_papers_form
def c24(run: Run, forms: tuple[str, ...]) -> tuple[Word, Evidence]:
    """Rotation about x and z per moment about x with Z-Y-Z and with Z-Y-X angles, over what is wanted."""
    zyz, zyx = (_about_x(run, coordinates, forms) for coordinates in (ZYZ, COORDINATES))
    what, is_zero = f"pose of {side_by_side.PROBE} by hybrid/{ZYZ}", zyz["from_zero"] <= ZERO_RAD
    at_zero = require_rows(zyz[is_zero], f"{what} at zero rotation")
    near = require_rows(zyz[~is_zero], f"{what} near zero rotation")
    word = word_of(zyz["problem"].all() and not zyx["problem"].any(), zyz["problem"].any())
    done = near[near["outcome"] == "done"]
    ends = join_words(f"'{end}'" for end in sorted(set(at_zero["outcome"].astype(str))))
    return word, evidence(
        f"""A test is one pose of one arm with one variant of force control. A moment about x acts on the hand. At
        zero rotation, Z-Y-Z angles are a problem in {_problems(at_zero)}. The outcomes of these tests are: {ends}.
        Within {NEAR_DEG:g} degrees of zero rotation, Z-Y-Z angles are also a problem in {_problems(near)}.
        The wanted rotation is the rotation about x with the controller hybrid-base. In the tests near zero rotation
        that end with the outcome 'done', the rotation about x is {done["yields"].min():.2g} to
        {done["yields"].max():.2g} times the wanted rotation. In these tests, the rotation about z is
        {done["leak"].min():.1f} to {done["leak"].max():.1f} times the rotation about x. Z-Y-X angles are a problem
        in {_problems(zyx)}. With Z-Y-X angles, the rotation about x is at least {zyx["yields"].min():.3f} times the
        wanted rotation.""",
        len(zyz) + len(zyx),
        measured=f"""Near zero rotation, Z-Y-Z angles are a problem in {_problems(near)}. In the
        tests that end with the outcome 'done', a moment about x turns the hand
        {done["leak"].min():.1f} to {done["leak"].max():.1f} times as far about z as about x.""",
    )


def _problems(rows: pd.DataFrame) -> str:
    """Return in how many tests the coordinates are a problem."""
    return count_of(int(rows["problem"].sum()), len(rows), "tests")


def _about_x(run: Run, coordinates: str, forms: tuple[str, ...]) -> pd.DataFrame:
    """Poses near zero, order 'about x': c_xx over that of hybrid-base, |c_zx / c_xx|, and whether it is a problem."""
    rows = side_by_side.beside_base(run, coordinates, (ORDER,), forms)
    rows = rows[np.degrees(rows["from_zero"]) <= NEAR_DEG + SLACK_DEG].reset_index(drop=True)
    C, base = side_by_side.compliances(rows), side_by_side.compliances(rows, "_base")
    yields, leak = C[:, 0, 0] / base[:, 0, 0], np.abs(C[:, 2, 0] / C[:, 0, 0])
    return rows.assign(yields=yields, leak=leak, problem=~(yields >= LITTLE) | (leak > MOST_LEAK))
