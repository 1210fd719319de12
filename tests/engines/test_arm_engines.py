"""Both engines of arms give the same rows, bit for bit; dm_control's loop with the plain controller is the truth.

Every law runs by every Jacobian that takes it, every other pair each week only. Arms, inverses, integrators and start
sets take turns: the loop calls laws and inverses by pointer, whichever they are.
"""

import functools
import math

import numpy as np
import pytest
from scipy.signal import lfilter
from support.bits import different_rows
from support.driving import ARM_METRICS, settings
from support.on_arms import ARMS, LAWS, named

import tasks
from bench.engines.arm_episode import POSE, drive
from bench.engines.episode import OUTCOME
from bench.engines.simulate_arms import run_arm as run
from bench.experiments.request import INTEGRATORS
from bench.law.contenders import combinations
from bench.law.contenders.registry import contenders
from tasks.kinematics import kinematics
from tasks.verdict import DIVERGED, OUTCOMES, SATURATED, SETTLED, SINGULAR, STUCK, TIMED_OUT

TASK = "arm-regulation"
SETS = tasks.task(TASK, ARMS[0]).start_sets
VARIED = ("mass-1.30", "motors-late", "friction-10", "motors-slow")
over_arms = pytest.mark.parametrize("arm", ARMS)


def pairs_on(arm: str) -> dict:
    """Return (law, Jacobian) -> the contenders on that arm, one for each inverse."""
    by: dict = {}
    for one in combinations.chosen((), LAWS, tasks.arm(arm).joints):
        by.setdefault((one.on_free_body, one.jacobian.name), []).append(one)
    return by


ON_ARM = {arm: pairs_on(arm) for arm in ARMS}
CASES = []
for i, pair in enumerate(ON_ARM[ARMS[0]]):
    a, k = i % len(ARMS), i % len(ARMS) + i // len(ARMS)
    one = ON_ARM[ARMS[a]][pair][k % len(ON_ARM[ARMS[a]][pair])]
    marks = pytest.mark.weekly if i % 2 else ()
    CASES.append(pytest.param(ARMS[a], one, INTEGRATORS[k % 4], k, id=f"{ARMS[a]}-{one.name}", marks=marks))


def of(arm: str, word: str, at: int):
    """One start of a set, the last one if it has fewer."""
    every = tasks.start_set(word, arm=arm)
    return every[min(at, len(every) - 1)]


def straight(arm: str):
    """All joints at zero, where every arm here is stretched out and its Jacobian singular; home is the goal."""
    model = kinematics(tasks.arm(arm))
    return model.start("straight", [0.0] * len(model.arm.home), model.pose(model.arm.home)[1])


def both(arm, one, starts, chosen, integrator="euler", variation="ideal-motors"):
    """Rows of the compiled loop and of dm_control's."""
    return [
        run(engine, one, TASK, arm, starts, chosen, ARM_METRICS, integrator, variation)
        for engine in ("native", "reference")
    ]


@pytest.mark.parametrize(("arm", "one", "integrator", "k"), CASES)
def test_native_rows_are_the_reference_rows_bit_for_bit(arm, one, integrator, k):
    starts = [of(arm, SETS[k % len(SETS)], k), of(arm, SETS[(k + 3) % len(SETS)], k)]
    chosen = settings(dt_s=(1e-3, 2e-3, 5e-4)[k % 3], horizon_s=(0.04, 0.08, 0.02)[k % 3])
    fast, slow = both(arm, one, starts, chosen, integrator)
    assert [starts[i].id for i in different_rows(fast, slow)] == []
    assert np.isfinite(slow[:, POSE:][:, : 1 + tasks.arm(arm).joints]).all()


def test_the_compared_runs_cover_every_part_and_integrator():
    for kind, known in (("jacobian", contenders("jacobians")), ("inverse", contenders("inverses"))):
        assert {getattr(case.values[1], kind).name for case in CASES} == set(known)
    met = {(case.values[1].on_free_body, case.values[1].jacobian.name) for case in CASES}
    assert met == {(one.on_free_body, one.jacobian.name) for one in combinations.chosen((), LAWS, 6)}
    used = {one.representation.name for one in (case.values[1] for case in CASES) if one.representation}
    assert used == set(contenders("representations"))
    for arm in ARMS:
        own = [case.values for case in CASES if case.values[0] == arm]
        refused = {"solve"} if tasks.arm(arm).joints > 6 else set()  # no square Jacobian there
        assert {one.inverse.name for _, one, _, _ in own} == set(contenders("inverses")) - refused
        assert {integrator for _, _, integrator, _ in own} == set(INTEGRATORS)
        assert {SETS[k % len(SETS)] for *_, k in own} == set(SETS)


ROUGH = settings(dt_s=1e-2, horizon_s=2.0, hold_ticks=10)
TIGHT = settings(dt_s=1e-2, horizon_s=0.3, speed_limit=2.0)
PLAIN, PAPERS, KHATIB, FLIPPED = (
    "rotation-matrix@geometric+standard",
    "feedback-linearized/zyx-euler@analytic+standard",
    "rotation-matrix@geometric+dynamically-consistent",
    "feedback-linearized/zyx-euler@geometric+transpose",
)


def endings(arm: str):
    """(word, start, settings) of episodes that end in different ways."""
    yield PLAIN, of(arm, "clear", 1), ROUGH  # settles, and stops early
    yield PLAIN, of(arm, "half-turn", 0), settings(dt_s=1e-2, horizon_s=0.3)  # stands at the dead point
    yield PAPERS, of(arm, "pole", 0), ROUGH
    yield PLAIN, of(arm, "wrist", 0), ROUGH
    yield KHATIB, straight(arm), ROUGH  # no Lambda at a singular pose
    yield FLIPPED, of(arm, "tumbling", 0), ROUGH
    yield PLAIN, of(arm, "tumbling", 1), TIGHT


@functools.cache
def ended(arm: str):
    """(start, row compiled, row of the reference) of each."""
    found = []
    for word, start, chosen in endings(arm):
        fast, slow = both(arm, named(arm, word), [start], chosen)
        found.append((f"{word} {start.id}", fast[0], slow[0]))
    return found


@over_arms
def test_native_rows_are_the_reference_rows_however_an_episode_ends(arm):
    names, fast, slow = zip(*ended(arm), strict=True)
    assert [names[i] for i in different_rows(fast, slow)] == []


def test_the_compared_episodes_end_in_every_way_an_episode_can_end():
    seen = {int(row[OUTCOME]) for arm in ARMS for _, row, _ in ended(arm)}
    assert seen == {SETTLED, STUCK, TIMED_OUT, DIVERGED, SINGULAR, SATURATED}, [OUTCOMES[i] for i in sorted(seen)]


@pytest.mark.parametrize(("arm", "integrator", "variation"), list(zip(ARMS, INTEGRATORS, VARIED, strict=True)))
def test_native_rows_are_the_reference_rows_when_the_plant_is_not_the_model(arm, integrator, variation):
    starts, chosen = [of(arm, "clear", 2), of(arm, "tumbling", 2)], settings(horizon_s=0.03)
    one = named(arm, PAPERS)
    fast, slow = both(arm, one, starts, chosen, integrator, variation)
    assert [starts[i].id for i in different_rows(fast, slow)] == []
    exact = run("native", one, TASK, arm, starts, chosen, ARM_METRICS, integrator)
    assert different_rows(fast, exact) != []  # it does make a difference


@pytest.mark.parametrize(("lag_s", "late"), [(5e-3, 0), (0.0, 5), (2e-3, 3)])
def test_torques_of_slow_and_late_motors_are_those_of_scipys_filter(lag_s, late):
    asked, fg = np.random.default_rng(5).standard_normal((60, 6)), np.arange(6.0)
    share, sent, given = -math.expm1(-1e-3 / lag_s) if lag_s else 1.0, np.zeros((late + 2, 6)), asked.copy()
    for tick, tau in enumerate(given):
        drive(tau, sent, share, np.inf, tick, fg, 6)
    arrived = np.vstack((np.tile(fg, (late, 1)), asked))[:60]
    expected, _ = lfilter([share], [1.0, share - 1.0], arrived, axis=0, zi=(1.0 - share) * fg[None])
    np.testing.assert_allclose(given, expected, atol=1e-12)


def test_torque_of_a_motor_with_a_bounded_rate_walks_to_what_is_sent():
    sent, fg = np.zeros((2, 6)), np.zeros(6)
    steps = [(tick, np.full(6, 3.5)) for tick in range(6)]
    for tick, tau in steps:
        drive(tau, sent, 1.0, 1.0, tick, fg, 6)
    assert [tau[0] for _, tau in steps] == [1.0, 2.0, 3.0, 3.5, 3.5, 3.5]


@over_arms
def test_episode_gives_the_same_row_whatever_ran_before_it(arm):
    """Nothing leaks from one episode into the next: no state, no buffer; not even from one that failed."""
    starts = [*(of(arm, word, 1) for word in SETS), straight(arm)]
    for word in (PLAIN, PAPERS, KHATIB, FLIPPED):
        forward, backward = (
            run("native", named(arm, word), TASK, arm, order, settings(horizon_s=0.5), ARM_METRICS)
            for order in (starts, starts[::-1])
        )
        assert different_rows(forward, backward[::-1]) == []
