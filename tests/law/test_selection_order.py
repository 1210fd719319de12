"""Both orders of selection in three cases: free space, a rigid wall without friction, and a hand that cannot move.

The oracle is the arm's own equation with constraints, in joint space, of MuJoCo's D, J and Jdot qdot:

    D qddot + fg = tau + J_k^T F_k,   J_k qddot + (Jdot qdot)_k = 0        k: the rows that cannot accelerate

Neither Lambda nor an order of selection is in it.
"""

import numpy as np
import pytest
from support.bits import EPS
from support.in_contact import ARMS, COORDINATES, GAINS, SELECTIONS, TOUCH, backward, drawn, hand, tick

import tasks
from bench.base.errors import UnknownWord
from bench.engines.contact_episode import FORCE, room, rows
from bench.engines.simulate_contact import run_contact
from bench.findings.theory import selection_theory as theory
from bench.law.chain import Chain
from bench.law.control.contact_controller import FORMS, SELECTION_ORDERS, hybrid
from bench.law.control.hybrid import comply
from tasks.contact_model import STANDARD
from tasks.domains import force_on_plane, surface_alignment

SELECTED_FIRST, DECOUPLED_FIRST = "selected-then-decoupled", "decoupled-then-selected"
BY = {form: hybrid("hybrid-base", form) for form in SELECTION_ORDERS}
MIXED = [held for held in SELECTIONS if 0.0 < sum(held) < 6.0]
SOME = [MIXED[k] for k in np.random.default_rng(77).permutation(len(MIXED))[:8]]

over_arms = pytest.mark.parametrize("arm", ARMS)
over_orders = pytest.mark.parametrize("order", SELECTION_ORDERS)


def states(arm: str):
    """(state, setpoint) of hands that nothing pushes; the first at rest, the others moving."""
    for number, ((name, q, qdot, mount, _), setpoint) in enumerate(drawn(arm)):
        rates = np.zeros_like(qdot) if number == 0 else qdot
        yield hand(name, q, rates, mount, np.zeros(6)), setpoint


def cases(arm: str):
    """Every state with some selections."""
    for at, setpoint in states(arm):
        for held in SOME:
            yield at, setpoint, np.array(held) > 0.0


def exerted(at, tau, stopped) -> tuple[np.ndarray, np.ndarray]:
    """(what the hand exerts along the rows that cannot accelerate, its acceleration along all), by the equation."""
    J, count = at.J[stopped], int(np.sum(stopped))
    left = np.block([[at.D, -J.T], [J, np.zeros((count, count))]])
    right = np.concatenate((tau - at.fg, -at.drift[stopped]))
    solution = np.linalg.solve(left, right)
    return -solution[at.n :], at.J @ solution[: at.n] + at.drift


def inertia(at) -> np.ndarray:
    return np.linalg.inv(at.J @ np.linalg.solve(at.D, at.J.T))


def rounding(at, wrench) -> float:
    """Bound the rounding of wrenches: normal equations of J and D, and the equation with constraints, no better."""
    return 10.0 * backward(at.J) * np.linalg.cond(at.D) * (np.linalg.norm(wrench) + np.linalg.norm(at.fg))


def wrench_of(setpoint) -> np.ndarray:
    return np.concatenate((setpoint.f_d, setpoint.m_d))


@over_arms
def test_in_free_space_the_first_order_gives_exactly_the_commanded_acceleration_and_the_second_does_not(arm):
    for at, setpoint, held in cases(arm):
        free = setpoint._replace(f_d=(0.0,) * 3, m_d=(0.0,) * 3)
        ticks = {order: tick(BY[order], at, free, held.astype(float)) for order in SELECTION_ORDERS}
        wanted = np.where(held, ticks[SELECTED_FIRST].rows.a, 0.0)
        off = {order: np.linalg.norm(at.acceleration(made.tau) - wanted) for order, made in ticks.items()}
        assert off[SELECTED_FIRST] <= 1e-9 * np.linalg.norm(wanted)
        assert off[DECOUPLED_FIRST] >= 1e-3 * np.linalg.norm(wanted)


@over_arms
def test_against_a_rigid_wall_without_friction_the_first_order_exerts_exactly_what_it_should(arm):
    for at, setpoint, held in cases(arm):
        h, Lambda = wrench_of(setpoint)[~held], inertia(at)
        ticks = {order: tick(BY[order], at, setpoint, held.astype(float)) for order in SELECTION_ORDERS}
        a = ticks[SELECTED_FIRST].rows.a
        coupled = Lambda[np.ix_(~held, held)] @ a[held]
        wanted = {SELECTED_FIRST: h, DECOUPLED_FIRST: h - coupled}
        allowed = rounding(at, Lambda @ a)
        for order, made in ticks.items():
            pressed, acceleration = exerted(at, made.tau, ~held)
            np.testing.assert_allclose(pressed, wanted[order], rtol=0.0, atol=allowed)
            np.testing.assert_allclose(acceleration[held], a[held], rtol=0.0, atol=allowed * np.linalg.norm(a))
        assert np.linalg.norm(coupled) > 100.0 * allowed


@over_arms
def test_where_nothing_can_move_the_second_order_exerts_exactly_what_it_should(arm):
    everything = np.ones(6, dtype=bool)
    for at, setpoint, held in cases(arm):
        h, Lambda = wrench_of(setpoint)[~held], inertia(at)
        ticks = {order: tick(BY[order], at, setpoint, held.astype(float)) for order in SELECTION_ORDERS}
        a = ticks[SELECTED_FIRST].rows.a
        coupled = Lambda[np.ix_(~held, held)] @ a[held]
        wanted = {SELECTED_FIRST: h + coupled, DECOUPLED_FIRST: h}
        allowed = rounding(at, Lambda @ a)
        for order, made in ticks.items():
            pressed, _ = exerted(at, made.tau, everything)
            np.testing.assert_allclose(pressed[~held], wanted[order], rtol=0.0, atol=allowed)
            np.testing.assert_allclose(pressed[held], (Lambda[:, held] @ a[held])[held], rtol=0.0, atol=allowed)
        assert np.linalg.norm(coupled) > 100.0 * allowed


@over_orders
@pytest.mark.parametrize("case", theory.CASES)
def test_theory_is_what_the_arms_equation_says_of_a_hand_at_rest(order, case):
    for arm in ARMS:
        at, setpoint = next(states(arm))
        for held in (np.array(one) > 0.0 for one in SOME):
            made = tick(BY[order], at, setpoint, held.astype(float))
            stopped = ~held if case == theory.HAPPENS else np.ones(6, dtype=bool)
            pressed, _ = exerted(at, made.tau, stopped)
            along = pressed if case == theory.HAPPENS else pressed[~held]
            error = along - wrench_of(setpoint)[~held]
            predicted = theory.exerted_error(order, case, inertia(at), held, made.rows.a)
            np.testing.assert_allclose(error, predicted, rtol=0.0, atol=rounding(at, inertia(at) @ made.rows.a))


def test_theory_refuses_words_that_it_does_not_know():
    with pytest.raises(UnknownWord, match="'transpose' is unknown"):
        theory.exerted_error("transpose", theory.HELD, np.eye(6), (1,) * 6, (0.0,) * 6)
    with pytest.raises(UnknownWord, match="'sticks' is unknown"):
        theory.exerted_error(SELECTED_FIRST, "sticks", np.eye(6), (1,) * 6, (0.0,) * 6)


@over_arms
def test_inertia_at_a_tip_is_that_of_the_tasks_own_model(arm):
    """The frame of wrench-probe's hand is at (0, 0, 0.1) of the wrist."""
    on = tasks.arm(arm)
    (_, _, _, mount, _), _ = drawn(arm)[0]
    at = hand(arm, on.home, np.zeros(on.joints), mount, np.zeros(6))
    found = theory.inertia_at(on, (0.0, 0.0, 0.1))
    np.testing.assert_allclose(found, inertia(at), rtol=0.0, atol=1e-9 * np.linalg.norm(found))


def complied(form: str, held, D: np.ndarray, into) -> np.ndarray:
    """tau of `comply` with J = 1 and no fg, so that Lambda = D."""
    tau, chain = np.full(6, np.nan), Chain(6, None, None, np.zeros(6), None, None)
    comply(FORMS.index(form), held, chain, D, np.zeros(6), np.eye(6), into, GAINS, TOUCH, room(), tau)
    return tau


def drawn_rows(draw):
    into = rows()
    for row in into:
        row[:] = draw.normal(size=6)
    return into


def test_orders_agree_where_the_inertia_has_no_coupling():
    draw = np.random.default_rng(5)
    for held in SELECTIONS:
        is_held, into = np.array(held) > 0.0, drawn_rows(draw)
        root = draw.normal(size=(6, 6))
        D = root @ root.T + np.eye(6)
        coupled = [complied(order, held, D, into) for order in SELECTION_ORDERS]
        D[np.ix_(is_held, ~is_held)] = D[np.ix_(~is_held, is_held)] = 0.0
        uncoupled = [complied(order, held, D, into) for order in SELECTION_ORDERS]
        np.testing.assert_allclose(*uncoupled, rtol=0.0, atol=6**3 * EPS * np.linalg.cond(D) * np.abs(uncoupled).max())
        differ = np.linalg.norm(coupled[0] - coupled[1]) > 1e-6
        assert differ == (0.0 < sum(held) < 6.0)


@pytest.mark.parametrize("held", [(0.0,) * 6, (1.0,) * 6])
def test_orders_are_the_same_to_the_bit_where_all_is_held_or_all_complies(held):
    for at, setpoint in states(ARMS[0]):
        first, second = (tick(BY[order], at, setpoint, held).tau for order in SELECTION_ORDERS)
        np.testing.assert_array_equal(first, second)


@over_orders
def test_measured_force_is_not_used(order):
    for (name, q, qdot, mount, push), setpoint in drawn(ARMS[0]):
        taus = [tick(BY[order], hand(name, q, qdot, mount, by), setpoint, SOME[0]).tau for by in (push, 0.0 * push)]
        np.testing.assert_array_equal(*taus)


@over_orders
def test_on_coordinates_the_rows_are_selected_in_the_same_way(order):
    """In free space on J_E: the first order accelerates the coordinates as commanded, the second does not."""
    one, held = hybrid("hybrid", order, COORDINATES["zyx-euler"]), np.array((1, 0, 1, 0, 1, 1)) > 0.0
    at, setpoint = next(states(ARMS[0]))
    free = setpoint._replace(f_d=(0.0,) * 3, m_d=(0.0,) * 3)
    made = tick(one, at, free, held.astype(float))
    got = made.J @ np.linalg.solve(at.D, made.tau - at.fg) + made.rows.drift
    off = np.linalg.norm(got - np.where(held, made.rows.a, 0.0)) / np.linalg.norm(made.rows.a)
    assert off < 1e-9 if order == SELECTED_FIRST else off > 1e-3


def pressing(task, trial, order: str, horizon_s: float, contact=STANDARD):
    """The record of an episode of a PUMA 560."""
    arm, one = tasks.arm("puma560"), BY[order]
    [ended] = run_contact("native", one, task._replace(horizon_s=horizon_s), arm, [trial], contact=contact)
    return ended


def test_a_tip_that_starts_along_a_plane_without_friction_presses_as_it_should_by_the_first_order_alone():
    """Motion that happens: 15 N on a level plane, while the tip gets its speed; the contact gives way a little."""
    task = force_on_plane.TASK
    trial = next(one for one in task.trials(tasks.arm("puma560")) if one.tilt == 0.0)
    x, y, z = trial.scene_pos
    touching = trial._replace(scene_pos=(x, y, z + force_on_plane.CLEARANCE))
    off = {}
    for order in SELECTION_ORDERS:
        record = pressing(task, touching, order, 0.3, STANDARD._replace(friction=1e-6)).record
        off[order] = np.abs(record[10:, FORCE + 2] - 15.0).max()  # the contact needs some ticks to give way
    assert off[SELECTED_FIRST] < 1.0
    assert off[DECOUPLED_FIRST] > 5.0


def test_a_tool_that_friction_holds_presses_as_it_should_by_the_second_order_alone():
    """Motion that is stopped: a tool at rest on a plate, off its place because it turned and does not slide back."""
    task = surface_alignment.TASK
    trial = next(one for one in task.trials(tasks.arm("puma560")) if one.id == "tilt 5 about 90, beta+0")
    off = {}
    for order in SELECTION_ORDERS:
        ended = pressing(task, trial, order, task.horizon_s)
        assert ended.rested
        off[order] = abs(ended.record[-200:, FORCE + 2].mean() - 20.0)
    assert off[DECOUPLED_FIRST] < 0.02
    assert off[SELECTED_FIRST] > 1.0
