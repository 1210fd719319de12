"""Contract of every regulator in every representation: counting it changes no bit, and all of it is counted."""

import itertools

import numpy as np
import pytest
from scipy.spatial.transform import Rotation as Oracle
from support.states import of_scipy, rotations

from bench.engines.binding import memory_of
from bench.engines.counting import OPERATIONS, STAGES, TOTAL, Tally, cost, flops, rows
from bench.engines.counting.costs import bits, counted
from bench.engines.counting.staged import STAGE_OF, law_of
from bench.law.contenders.registry import all_contenders, contenders
from bench.law.inputs import AT_REST, Gains, Goal
from bench.law.so3 import IDENTITY

CONTENDERS = all_contenders()
OMEGAS = {"at rest": AT_REST, "spinning": (-2.0, 0.7, 11.0)}
GAINS = Gains(np.float64(100.0), np.float64(20.0))
EVERY = rotations()
SOME = (*EVERY[:37], *EVERY[37::5])  # all that permute axes or are near the identity, and some of the others
ZYX = of_scipy(Oracle.from_euler("ZYX", [2.0, -1.1, 0.4]))
GOALS = [IDENTITY, ZYX, next(R for R in EVERY if abs(R.n[2]) == 1.0)]


@pytest.fixture(params=CONTENDERS, ids=lambda one: one.name, scope="module")
def one(request):
    return request.param


@pytest.mark.parametrize("pace", OMEGAS)
def test_counted_command_is_the_float_command_bit_for_bit(one, pace):
    tally = Tally()
    plain, counting = one.law, law_of(one, tally)
    omega = tuple(np.float64(x) for x in OMEGAS[pace])
    with np.errstate(all="ignore"):
        memory = () if one.regulator.memory is None else (tuple(map(np.float64, memory_of(one))),)
        for R, R_d in itertools.product(SOME, GOALS):
            given = (R, omega, Goal(R_d, *(omega, omega)), GAINS, *memory)
            assert bits(counting(*counted(given, tally))) == bits(plain(*given))


def test_every_function_of_a_representation_has_a_stage():
    representation = contenders("representations")["zyx-euler"]
    functions = {name for name, value in representation._asdict().items() if callable(value)}
    assert set(STAGE_OF) == functions | {"goal_chart"}


@pytest.fixture(scope="module")
def counts(one):
    return cost(one)


def test_command_costs_something_and_its_worst_branch_no_less_than_the_typical_one(one, counts):
    assert flops(counts.typical.of(TOTAL)) > 0
    assert sum(counts.worst.of(TOTAL).values()) >= sum(counts.typical.of(TOTAL).values())
    assert one.representation is not None or counts.typical.of("regulate") == counts.typical.of(TOTAL)


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
