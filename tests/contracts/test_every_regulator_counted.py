"""Contract of every regulator in every representation: counting it changes no bit, and all of it is counted.

The rotations are scipy's and numpy's, not those the counter itself runs over.
"""

import math
import struct

import numpy as np
import pytest
from scipy.spatial.transform import Rotation as Oracle

from bench.contenders.registry import all_contenders, known_representations
from bench.counting import OPERATIONS, STAGES, TOTAL, Counted, Tally, cost, flops, rows
from bench.counting.costs import counted
from bench.counting.staged import STAGE_OF, law_of, staged
from bench.law.contender import AT_REST, NO_MEMORY, Gains, Goal
from bench.law.so3 import Rotation

CONTENDERS = all_contenders()
SEED = 20260712
AXES = [*np.eye(3), np.array([1.0, 1.0, 1.0]) / math.sqrt(3), np.array([0.6, -0.8, 0.0])]
OMEGAS = {"at rest": AT_REST, "spinning": (-2.0, 0.7, 11.0)}
GAINS = Gains(np.float64(100.0), np.float64(20.0))


def about(axis, angle):
    return Oracle.from_rotvec(np.asarray(axis) * angle).as_matrix()


def zyx(alpha, beta, gamma):
    return Oracle.from_euler("ZYX", [alpha, beta, gamma]).as_matrix()


def exact_poles():
    """Matrices of zeros and ones, and turns about z at the pole: cos(beta) is exactly 0."""
    for sign in (1.0, -1.0):
        yield np.array([[0.0, 0.0, sign], [0.0, 1.0, 0.0], [-sign, 0.0, 0.0]])
        for turn in (0.3, 2.5, -1.4):
            s, c = math.sin(turn), math.cos(turn)
            yield np.array([[0.0, -s, sign * c], [0.0, c, sign * s], [-sign, 0.0, 0.0]])


FAMILIES = {
    "uniform": lambda: Oracle.random(60, rng=SEED).as_matrix(),
    "near identity": lambda: [about(axis, 10.0**-k) for axis in AXES for k in (1, 3, 6, 9, 12, 300)],
    "identity": lambda: [np.eye(3)],
    "near half turn": lambda: [about(axis, math.pi - 10.0**-k) for axis in AXES for k in (1, 4, 8, 12, 16)],
    "half turn": lambda: [np.diag(signs) for signs in ((1.0, -1.0, -1.0), (-1.0, 1.0, -1.0), (-1.0, -1.0, 1.0))],
    "near pole": lambda: [
        zyx(alpha, sign * (math.pi / 2 - 10.0**-k), gamma)
        for alpha, gamma in ((0.0, 0.0), (1.2, -2.7))
        for sign in (1.0, -1.0)
        for k in (1, 4, 8, 12)
    ],
    "pole": lambda: list(exact_poles()),
    "wrap": lambda: [zyx(math.pi, 0.4, 1.0), zyx(-math.pi, 0.4, 1.0), zyx(0.4, -0.2, math.pi)],
}


def rotation(matrix):
    return Rotation(*(tuple(np.float64(x) for x in column) for column in np.asarray(matrix).T))


GOALS = [rotation(np.eye(3)), rotation(zyx(2.0, -1.1, 0.4)), rotation(next(exact_poles()))]


def doubles(answer):
    """The numbers of an answer, flat."""
    if isinstance(answer, tuple):
        return [number for part in answer for number in doubles(part)]
    return [answer.value if isinstance(answer, Counted) else answer]


def bytes_of(answer):
    numbers = doubles(answer)
    return struct.pack(f"<{len(numbers)}d", *numbers)


def memories(one):
    if one.regulator.memory is None:
        return [()]
    first = (*one.regulator.memory, *NO_MEMORY[len(one.regulator.memory) :])
    return [(tuple(np.float64(x) for x in first),)]


@pytest.fixture(params=CONTENDERS, ids=lambda one: one.name, scope="module")
def one(request):
    return request.param


@pytest.mark.parametrize("family", FAMILIES)
@pytest.mark.parametrize("pace", OMEGAS)
def test_counted_command_is_the_float_command_bit_for_bit(one, family, pace):
    tally = Tally()
    plain, counting = one.law, law_of(one, tally)
    omega = tuple(np.float64(x) for x in OMEGAS[pace])
    with np.errstate(all="ignore"):
        for matrix in FAMILIES[family]():
            for R_d in GOALS:
                for memory in memories(one):
                    given = (rotation(matrix), omega, Goal(R_d, *(omega, omega)), GAINS, *memory)
                    assert bytes_of(counting(*counted(given, tally))) == bytes_of(plain(*given))


@pytest.mark.parametrize("family", FAMILIES)
@pytest.mark.parametrize("word", known_representations())
def test_counted_representation_is_the_float_one_bit_for_bit(word, family):
    tally = Tally()
    plain = known_representations()[word]
    counting = staged(plain, tally)
    v = (np.float64(0.3), np.float64(-1.7), np.float64(0.0))
    count = len(plain.symbols)
    rate = (np.float64(2.0), np.float64(0.1), np.float64(5.0), np.float64(-0.6))[:count]
    acceleration = (np.float64(-4.0), np.float64(0.0), np.float64(0.7), np.float64(30.0))[:count]
    with np.errstate(all="ignore"):
        for matrix in FAMILIES[family]():
            R = rotation(matrix)
            at, counted_at = plain.chart(R), counting.chart(counted(R, tally))
            E, counted_E = at.E, counted_at.E
            pairs = [
                (counted_at, at),
                (counting.goal_chart(counted(R, tally)), at),
                (counting.margin(counted(R, tally)), plain.margin(R)),
                (counting.chart_of(counted_E), plain.chart_of(E)),
                (counting.to_matrix(counted_E), plain.to_matrix(E)),
                (counting.rates(counted_at, counted(v, tally)), plain.rates(at, v)),
                (counting.angular_velocity(counted_at, counted(rate, tally)), plain.angular_velocity(at, rate)),
                (counting.generalized(counted_at, counted(v, tally)), plain.generalized(at, v)),
                (
                    counting.accelerate(counted_at, *counted((rate, acceleration), tally)),
                    plain.accelerate(at, rate, acceleration),
                ),
            ]
            if plain.differentiate is not None:
                along = Rotation(v, acceleration, rate), Rotation(rate, v, acceleration)
                pairs += [
                    (
                        counting.differentiate(counted(R, tally), counted(along[0], tally)),
                        plain.differentiate(R, along[0]),
                    ),
                    (
                        counting.differentiate_twice(*counted((R, *along), tally)),
                        plain.differentiate_twice(R, *along),
                    ),
                ]
            for ours, floats in pairs:
                assert bytes_of(ours) == bytes_of(floats)


def test_every_function_of_a_representation_has_a_stage():
    representation = known_representations()["zyx-euler"]
    functions = {name for name, value in representation._asdict().items() if callable(value)}
    assert set(STAGE_OF) == functions | {"goal_chart"}


@pytest.fixture(scope="module")
def counts(one):
    return cost(one)


def test_worst_branch_is_no_cheaper_than_the_typical_one(counts):
    assert sum(counts.worst.of(TOTAL).values()) >= sum(counts.typical.of(TOTAL).values())


def test_command_costs_something(counts):
    assert flops(counts.typical.of(TOTAL)) > 0


def test_law_on_the_matrix_is_all_regulate(one, counts):
    if one.representation is None:
        assert counts.typical.of("regulate") == counts.typical.of(TOTAL)


def test_rows_are_every_stage_of_both_branches_and_their_total(one, counts):
    table = rows([one])
    assert [table[0]["regulator"], table[0]["representation"]] == (one.name + "/").split("/")[:2]
    assert [(row["branch"], row["stage"]) for row in table] == [
        (branch, stage) for branch in ("typical", "worst") for stage in (*STAGES, TOTAL)
    ]
    for branch, counted_before in (("typical", counts.typical), ("worst", counts.worst)):
        *stages, total = [row for row in table if row["branch"] == branch]
        assert {name: total[name] for name in OPERATIONS} == counted_before.of(TOTAL)
        for column in (*OPERATIONS, "flops"):
            assert {type(row[column]) for row in (*stages, total)} == {int}
            assert total[column] == sum(row[column] for row in stages)
