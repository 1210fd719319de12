"""What other libraries are asked, and how that is judged: exact turns, every way to fail, and the committed answers."""

import math
from fractions import Fraction

import numpy as np
import pytest
from scipy.spatial.transform import Rotation as ScipyRotation
from support.bits import EPS
from support.planted import log as logarithm

from bench.experiments.tables.store import read
from bench.findings.libraries import SINGLE_RAD, STUDY
from bench.studies.libraries import turns
from bench.studies.libraries.__main__ import rows
from bench.studies.libraries.asked import ASKED, find, version_of
from bench.studies.libraries.judge import COUNT_RAD, FORMS, KINDS, judge
from bench.studies.libraries.library import MATRIX, QUATERNION, Function, Library
from report.figures.libraries import libraries

SOME = turns.drawn()._replace(turns=turns.drawn().turns[:50])
HALF_TURNS = turns.half_turns()
FEW = (turns.small(3), SOME, turns.poles(), turns.near_half_turn(3), HALF_TURNS)


def vector(turn_set, size=lambda theta: theta):
    """A function on matrices that knows the answers."""
    answers = {turn.R.tobytes(): size(turn.angle) * turn.axis for turn in turn_set.turns}
    return lambda R: answers[R.tobytes()]


def judged(call, turn_set=SOME, takes=MATRIX, form="rotation-vector"):
    return judge(Function("f", takes, call, form), turn_set)


def failures(row):
    return {kind: row[kind.replace("-", "_")] for kind in KINDS if row[kind.replace("-", "_")]}


def test_half_turns_are_exact_rational_matrices_rounded_once():
    """R = 2 k k^T/(k.k) - I, in fractions."""
    for k, turn in zip(turns.axes(), HALF_TURNS.turns, strict=True):
        square = sum(part * part for part in k)
        exact = [[Fraction(2 * a * b, square) - (i == j) for j, b in enumerate(k)] for i, a in enumerate(k)]
        assert turn.R.tolist() == [[float(element) for element in row] for row in exact]
        assert turn.quat_wxyz[0] == 0.0
        assert turn.angle == math.pi


SETS = (turns.drawn, turns.poles, turns.half_turns, lambda: turns.small(5), lambda: turns.near_half_turn(3, 2))


@pytest.mark.parametrize("turn_set", SETS)
def test_turns_agree_with_rodrigues_formula_on_their_own_axis_and_angle(turn_set):
    for turn in turn_set().turns:
        K = np.cross(turn.axis, np.eye(3)).T
        expected = np.eye(3) + math.sin(turn.angle) * K + (1.0 - math.cos(turn.angle)) * K @ K
        np.testing.assert_allclose(turn.R, expected, rtol=0.0, atol=8 * EPS)
        assert abs(np.linalg.norm(turn.quat_wxyz) - 1.0) <= 2 * EPS


def test_distance_to_the_half_turn_keeps_its_digits():
    for turn in turns.near_half_turn(12, 5).turns:
        assert turn.quat_wxyz[0] == pytest.approx(2.5e-12, rel=1e-14)


@pytest.mark.parametrize("form", [word for word, form in FORMS.items() if form.size is not None])
def test_answer_of_its_own_form_is_usable_and_exact(form):
    row = judged(vector(SOME, FORMS[form].size), form=form)
    assert failures(row) == {}
    assert row["form_error_rad"] == 0.0
    assert row["turn_error_rad"] <= 1e-7  # an arc sine loses half the digits where it is flat
    assert (row["error_rad"] == 0.0) == (form == "rotation-vector")


def test_error_is_that_of_the_worst_turn():
    right = vector(SOME)
    worst = SOME.turns[3].R.tobytes()
    row = judged(lambda R: right(R) + (0.003 if R.tobytes() == worst else 0.0))
    assert row["error_rad"] == pytest.approx(0.003 * math.sqrt(3.0), rel=1e-9)


def test_angles_are_judged_by_the_turn_that_they_stand_for():
    """The wrap by 2 pi is no error of angles, nor is the second triple that stands for the same turn."""

    def angles(R):
        return (math.atan2(R[2, 1], R[2, 2]) + 2 * math.pi, -math.asin(R[2, 0]), math.atan2(R[1, 0], R[0, 0]))

    assert judged(angles, form="z-y-x")["form_error_rad"] < 1e-13
    assert judged(lambda R: np.add(angles(R), (0.0, 0.0, 0.1)), form="z-y-x")["form_error_rad"] == pytest.approx(0.1)


@pytest.mark.parametrize(
    ("call", "kind"),
    [
        (lambda R: 1 // 0, "raised"),
        (lambda R: (math.nan, 0.0, 0.0), "not-finite"),
        (lambda R: (0.0, 0.0, 0.0), "nought"),
        (lambda R: -vector(SOME)(R), "long-way"),
        (lambda R: np.cross(vector(SOME)(R), (0.3, 0.5, 0.7)), "astray"),
    ],
)
def test_every_way_to_fail_has_its_name(call, kind):
    assert failures(judged(call)) == {kind: len(SOME.turns)}


def test_either_direction_is_right_on_an_exact_half_turn():
    for sign in (1.0, -1.0):
        row = judged(lambda R, sign=sign: sign * vector(HALF_TURNS)(R), HALF_TURNS)
        assert failures(row) == {}
        assert row["error_rad"] == 0.0


@pytest.mark.parametrize(("before_rad", "failed"), [(1e-7, 0), (1e-3, len(turns.axes()))])
def test_opposite_axis_next_to_180_degrees_is_a_fault_only_where_its_turn_is_another(before_rad, failed):
    """pi - d about -k is 2 d from pi - d about k."""
    (turn_set,) = (one for one in turns.every_set() if one.distance_rad == before_rad)
    right = vector(turn_set)
    row = judged(lambda R: -right(R), turn_set)
    assert failures(row) == ({"long-way": failed} if failed else {})
    assert row["turn_error_rad"] == pytest.approx(2.0 * before_rad, rel=1e-6)


def test_turn_beyond_180_degrees_is_off_by_how_much_longer_it_is():
    turn_set = turns.small(1)
    row = judged(vector(turn_set, lambda theta: theta - 2.0 * math.pi), turn_set)
    assert failures(row) == {"long-way": len(turn_set.turns)}
    assert row["turn_error_rad"] == pytest.approx(2.0 * math.pi - 0.2)


def test_negative_quaternion_is_compared_with_the_positive():
    bare, signed = (lambda q: 2.0 * q[1:]), (lambda q: math.copysign(2.0, q[0]) * q[1:])
    cases = ((bare, SOME, len(SOME.turns)), (signed, SOME, 0), (bare, HALF_TURNS, 0))
    for call, turn_set, others in cases:
        assert judged(call, turn_set, QUATERNION, "sine-of-half")["other_sheet"] == others


@pytest.mark.parametrize("name", sorted(ASKED.keys() - {"shipped"}))
def test_committed_answers_are_what_the_library_says_here(name):
    """One version fails on the same numbers of rotations in three sets, in the same way; restated code has none."""
    found = find(name)
    if found.missing:
        pytest.skip(found.missing[name])
    [library] = found.libraries
    table = read(STUDY, "libraries")
    table = table[table["library"] == library.name].set_index(["function", "turn_set"])
    assert set(table.index.get_level_values("function")) == {one.name for one in library.functions}
    if table["version"].iloc[0] != version_of(library):
        pytest.skip(f"{library.name} {version_of(library)} is installed, {table['version'].iloc[0]} was asked")
    for function in library.functions:
        for one in (turns.small(9), turns.near_half_turn(6), HALF_TURNS):
            row = judge(function, one, SINGLE_RAD if library.is_single else COUNT_RAD)
            committed = table.loc[(function.name, one.name)]
            counted = ["turns", *(kind.replace("-", "_") for kind in KINDS)]
            assert [row[name] for name in counted] == [committed[name] for name in counted], (function.name, one.name)


@pytest.mark.parametrize(
    ("call", "form", "said"),
    [
        (logarithm, "rotation-vector", ""),
        (lambda R: logarithm(R) if R.trace() > -1.0 + 1e-15 else np.zeros(3), "rotation-vector", "is zero for all"),
        (lambda R: -logarithm(R), "rotation-vector", "unwinding for"),
        (lambda R: logarithm(R)[[1, 2, 0]], "rotation-vector", "wrong axis for"),
        (lambda R: logarithm(R) * (1.0 + 1e-3 * (R.trace() < 0.0)), "rotation-vector", "error of 0.006 rad"),
        (lambda R: logarithm(R) / (R.trace() > 0.0), "rotation-vector", "no number for"),
        (lambda R: ScipyRotation.from_matrix(R).as_euler("ZYX"), "z-y-x", "error of"),
    ],
)
def test_page_says_what_is_wrong_with_a_function_and_nothing_against_a_logarithm(call, form, said):
    library = Library("numpy", "numpy", (Function("f", MATRIX, call, form),))
    [line] = libraries.functions(rows(library, FEW)).to_dict("records")
    assert bool(line["objections"]) == bool(said)
    assert said in "; ".join(line["objections"].values())


def test_verdict_of_the_page_agrees_with_the_check_and_the_closed_loops():
    """A sine is right by its form and zero at 180°; single precision is a design. All else must agree."""
    every = libraries.lines()[libraries.lines()["form"] != libraries.ANGLES]
    both = every.merge(libraries.table("verdicts"), on=["library", "function"], validate="one_to_one")
    both = both.merge(libraries.responses(), on=["library", "function", "kind"], validate="one_to_one")
    assert len(both) == len(every)
    for one in both[both["precision"] == "double"].itertuples():
        is_wrong = bool(one.faults) or (one.form == libraries.SINE and one.dead > 0)
        assert bool(one.objections) == is_wrong, (one.library, one.function)
        assert one.objections or not (one.dead or one.away or one.unsettled), (one.library, one.function)
    assert both.loc[both["precision"] == "single", "objections"].map(len).sum() == 0
