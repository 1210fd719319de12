"""Contracts that every regulator keeps, in every representation it acts on; a new file is under them unnamed."""

import functools
import itertools
import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation as ScipyRotation
from support.bits import EPS, different_rows
from support.buffers import numbers_of
from support.driving import METRICS, settings, spread
from support.each import each
from support.states import as_rotation, of_scipy, rotations, vector

import tasks
from bench.engines.binding import command_of, evaluation_of, margin_of, memory_of
from bench.engines.compiled import compile_on_demand
from bench.engines.counting import OPERATIONS, STAGES, TOTAL, Tally, cost, flops, rows
from bench.engines.counting.costs import counted
from bench.engines.counting.staged import STAGE_OF, law_of
from bench.engines.episode import OUTCOME, TICKS
from bench.engines.simulate import evaluation, run
from bench.law.contenders.registry import all_contenders, contenders
from bench.law.inputs import AT_REST, Goal, Tuning
from bench.law.so3 import IDENTITY
from tasks.verdict import DIVERGED, OUTCOMES, SATURATED, SETTLED, SINGULAR

BODIES = [name for name in tasks.names() if not tasks.is_for_arms(name)]  # arms have contracts of their own
GAINS = Tuning(kp=37.0, kv=9.0)  # not the defaults: a law that has those built in is found out
LIMITS = 10.0, 0.005
"""Bound and delay of a motor [rad/s^2, s]."""

contender = each(all_contenders())


def call(contender, R, omega, R_d=IDENTITY, gains=GAINS) -> np.ndarray:
    """The command of one tick, from the initial memory."""
    with np.errstate(all="ignore"):
        u, _ = command_of(contender)(R, omega, Goal(R_d), gains, memory_of(contender))
    return np.array(u)


def is_regular(contender, R, R_d) -> bool:
    """Off the singular set of the law's coordinates, where there is one."""
    return margin_of(contender)(R, R_d) != 0.0  # NaN, for a law on R, is regular


# the law claims the small-angle gains, and its coordinates exist at the goal they are tested at
LINEAR = [one for one in all_contenders() if one.regulator.property != "none" and is_regular(one, IDENTITY, IDENTITY)]
# a law on R, or on R_d^T R, can tell base frames apart only by mistake; angles of R are measured in one
FRAMELESS = [one for one in all_contenders() if one.representation is None or one.regulator.law.relative]


def through(evaluate, R, omega, goal, gains, memory):
    return evaluate(R, omega, goal, gains, memory)


@functools.cache
def by_pointer():
    """Return a function that calls every law by its pointer, as the loops do."""
    return compile_on_demand(through)


@functools.cache
def ticks() -> list[tuple]:
    """Every orientation of interest, at rest and tumbling, towards the identity and towards another one of them."""
    draw, every = np.random.default_rng(9), rotations()
    return [
        (R, vector(omega), Goal(R_d), Tuning(*map(np.float64, (*draw.uniform(1.0, 200.0, 2), *LIMITS))))
        for R in every
        for omega, R_d in (
            (AT_REST, IDENTITY),
            (draw.normal(scale=5.0, size=3), every[draw.integers(len(every))]),
        )
    ]


def count(contender, *given):
    """The command and the memory of a tick by counting scalars."""
    tally = Tally()
    memory = () if contender.regulator.memory is None else (given[-1],)
    return law_of(contender, tally)(*counted((*given[:-1], *memory), tally))


def test_compiled_and_counted_commands_are_the_plain_command_bit_for_bit(contender):
    evaluate, memory = evaluation_of(contender), memory_of(contender)
    ways = (evaluate, functools.partial(by_pointer(), evaluation(contender)))
    with np.errstate(all="ignore"):
        plain, compiled = (np.array([numbers_of(way(*tick, memory)) for tick in ticks()]) for way in ways)
        some = [numbers_of(count(contender, *tick, tuple(map(np.float64, memory)))) for tick in ticks()[::7]]
    assert different_rows(compiled, plain) == []
    assert different_rows(some, plain[::7, : len(some[0])]) == []
    # the comparison has seen numbers, not only NaN
    assert np.isfinite(plain[:, :7]).all(axis=1).mean() > 0.5


# A step of 1e-4 rad leaves h^2/6 = 2e-9 of the gain by the law's curvature, and EPS pi/h = 7e-12 by rounding.
STEP = 1e-4
GAIN_TOLERANCE = 1e-8


@pytest.mark.parametrize("contender", LINEAR)
def test_small_angle_gain_is_kp_and_rate_gain_is_kv(contender):
    for i, axis in enumerate(np.eye(3)):
        turned = [call(contender, of_scipy(ScipyRotation.from_rotvec(h * axis)), AT_REST) for h in (STEP, -STEP)]
        moving = [call(contender, as_rotation(IDENTITY), vector(h * axis)) for h in (STEP, -STEP)]
        for (there, back), gain in ((turned, GAINS.kp * contender.regulator.stiffness[i]), (moving, GAINS.kv)):
            slope = (there - back) / (2.0 * STEP)
            np.testing.assert_allclose(slope, -gain * axis, rtol=0.0, atol=GAIN_TOLERANCE * GAINS.kp)


def test_command_at_the_goal_at_rest_is_zero(contender):
    """To rounding: R_d^T R of the goal itself differs from the identity by EPS or two."""
    for R in rotations():
        if is_regular(contender, R, R):
            assert np.abs(call(contender, R, vector(AT_REST), R)).max() <= 8 * EPS * GAINS.kp, R


@pytest.mark.parametrize("contender", FRAMELESS)
def test_command_is_the_same_in_every_base_frame_where_the_law_has_none_of_its_own(contender):
    """u(QR, Q omega, QR_d) = Q u(R, omega, R_d): the error of such a law depends on R_d^T R alone."""
    draw = np.random.default_rng(10)
    for _ in range(100):
        Q, R, R_d = ScipyRotation.random(3, rng=draw)
        omega = draw.normal(scale=5.0, size=3)
        seen, turned = (
            call(contender, of_scipy(P * R), vector(P.apply(omega)), of_scipy(P * R_d))
            for P in (ScipyRotation.identity(), Q)
        )
        margin = margin_of(contender)(of_scipy(R), of_scipy(R_d))
        near = 1.0 if math.isnan(margin) else margin
        # rounding of the relative orientation, 10 EPS, in coordinates that magnify it by 1/margin twice
        scale = 10 * EPS / near**2 * (GAINS.kp * math.pi + GAINS.kv * np.linalg.norm(omega))
        np.testing.assert_allclose(turned, Q.apply(seen), rtol=0.0, atol=scale)


def test_command_is_finite_off_the_singular_set(contender):
    for R in rotations():
        if is_regular(contender, R, IDENTITY):
            assert np.isfinite(call(contender, R, vector((0.5, -1.0, 2.0)))).all(), R


# name: (settings, starts of each set); together they end in every way an episode can end
RUNS = {
    "as judged": (settings(dt_s=1e-3, horizon_s=0.1), 2),
    "to the end, with early stop": (settings(dt_s=1e-2, horizon_s=2.0, hold_ticks=10), 1),
    "under tight limits": (settings(dt_s=1e-2, horizon_s=0.5, command_limit=350.0, speed_limit=8.0), 2),
}


# Laws take turns in the ways and with the integrators: the loop that both engines share knows no law from another.
TURNS = [
    pytest.param(one, way, integrator, id=f"{one.name}-{way}-{integrator}")
    for one, (way, integrator) in zip(
        all_contenders(), itertools.cycle(itertools.product(RUNS, ("euler", "rk4"))), strict=False
    )
]


@pytest.mark.parametrize(("contender", "way", "integrator"), TURNS)
@pytest.mark.parametrize("task", BODIES)
def test_native_rows_are_the_reference_rows_bit_for_bit(contender, task, integrator, way):
    chosen, each = RUNS[way]
    starts = spread(each, task)
    fast, slow = (
        run(engine, contender, task, starts, chosen, METRICS, integrator) for engine in ("native", "reference")
    )
    assert [starts[i].id for i in different_rows(fast, slow)] == []


def test_the_compared_runs_end_in_every_way_an_episode_can_end():
    seen = set()
    for contender, way, integrator in (case.values for case in TURNS):
        chosen, each = RUNS[way]
        rows = run("native", contender, "free-body", spread(each), chosen, METRICS, integrator)
        seen |= set(rows[:, OUTCOME].astype(int))
    assert {SETTLED, DIVERGED, SINGULAR, SATURATED} <= seen, [OUTCOMES[i] for i in sorted(seen)]


@pytest.mark.parametrize("task", BODIES)
@pytest.mark.parametrize("engine", ["native", "ideal-rk4"])
def test_episode_gives_the_same_row_whatever_ran_before_it(contender, task, engine):
    """No state of MuJoCo, of the law's memory or of a metric leaks from one episode into the next."""
    starts, chosen = spread(1, task), settings(dt_s=1e-2, horizon_s=0.3)
    forward = run(engine, contender, task, starts, chosen, METRICS)
    backward = run(engine, contender, task, starts[::-1], chosen, METRICS)[::-1]
    assert different_rows(forward, backward) == []


def test_early_stop_changes_no_settling_tick(contender):
    starts = spread(2)
    to_the_end, stopped = (
        run("ideal-rk4", contender, "free-body", starts, settings(5e-3, 4.0, hold), METRICS) for hold in (10**9, 50)
    )
    assert different_rows(to_the_end[:, :3], stopped[:, :3]) == []
    assert (stopped[:, TICKS] <= to_the_end[:, TICKS]).all()


def test_every_function_of_a_representation_has_a_stage():
    representation = contenders("representations")["zyx-euler"]
    functions = {name for name, value in representation._asdict().items() if callable(value)}
    assert set(STAGE_OF) == functions | {"goal_chart"}


@pytest.fixture
def counts(contender):
    return cost(contender)


def test_command_costs_something_and_its_worst_branch_no_less_than_the_typical_one(contender, counts):
    assert flops(counts.typical.of(TOTAL)) > 0
    assert sum(counts.worst.of(TOTAL).values()) >= sum(counts.typical.of(TOTAL).values())
    assert contender.representation is not None or counts.typical.of("regulate") == counts.typical.of(TOTAL)


def test_rows_are_every_stage_of_both_branches_and_their_total(contender, counts):
    table = rows([contender])
    assert [table[0]["regulator"], table[0]["representation"]] == (contender.name + "/").split("/")[:2]
    assert [(row["branch"], row["stage"]) for row in table] == [
        (branch, stage) for branch in ("typical", "worst") for stage in (*STAGES, TOTAL)
    ]
    for branch, counted_before in (("typical", counts.typical), ("worst", counts.worst)):
        *stages, total = [row for row in table if row["branch"] == branch]
        assert {name: total[name] for name in OPERATIONS} == counted_before.of(TOTAL)
        for column in (*OPERATIONS, "flops"):
            assert {type(row[column]) for row in (*stages, total)} == {int}
            assert total[column] == sum(row[column] for row in stages)
