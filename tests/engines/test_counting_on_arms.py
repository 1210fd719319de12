"""What controllers of arms and in contact cost: against counts by hand, stage by stage."""

import functools

import numpy as np
import pytest
from support.in_contact import COORDINATES, HYBRIDS, IMPEDANCES
from support.on_arms import ARMS, LAWS, named

import tasks
from bench.base.errors import BadLaw
from bench.engines.counting import in_contact, on_arms
from bench.engines.counting.costs import cost, counted
from bench.engines.counting.counted import OPERATIONS, TOTAL, Tally
from bench.engines.counting.on_arms import ARM_OF, arm_states
from bench.law.contenders import combinations
from bench.law.contenders.registry import contenders
from bench.law.control.contact_controller import ContactController, hybrid
from bench.law.kinds import Inverse
from bench.law.scalar import kernel
from tasks.contact import Specification

OPERATIONAL = ("pseudo-inverse", "clamped", "damped")
ITERATES = ("truncated-svd", "damped-least-squares-variable", *(f"operational-{how}" for how in OPERATIONAL))
"""Inverses that decide by the state how much they do."""

cost_on_arm = functools.cache(on_arms.cost_on_arm)


def by_hand(n: int) -> dict[str, tuple[int, int]]:
    """(mul, add) of each stage of rotation-matrix@geometric+transpose but the law's own, counted on paper.

    A cross product is 6 and 3, a difference of vectors 3 subtractions, counted as additions.
    """
    per_joint = n - 2
    twist = (18 + 9 * per_joint, 18 + 12 * per_joint)  # z qdot: 3; from link to link z qdot + omega x r and two sums
    bias = (42 + 27 * per_joint, 33 + 27 * per_joint)  # three cross products and z qdot a link, and their sums
    wanted = (0, 6)  # (u_p, u) - Jdot qdot
    if n > 6:  # J qdot, Kv/2 of it off a; D qdot, Kv/2 of it off the torques
        wanted = (6 * n + 1 + 6 + n * n + 1 + n, 6 + 6 * (n - 1) + 6 + n * (n - 1) + n)
    return {
        "measure": twist,
        "jacobian": (6 * n, 6 * n),  # z x (p - p_i) a column
        "invert": (6 * n, 5 * n),  # J^T a
        "linearize": (bias[0] + wanted[0], bias[1] + wanted[1] + n),  # and fg
        "regulate": (6, 6),  # the position's law
    }


@pytest.mark.parametrize(("arm", "n"), [("ur5e", 6), ("panda", 7)])
def test_controller_costs_what_a_count_by_hand_says(arm, n):
    counts = cost_on_arm(named(arm, "rotation-matrix@geometric+transpose"), arm).typical
    law = cost(LAWS["rotation-matrix"]).typical
    for stage, (mul, add) in by_hand(n).items():
        own = law.of(stage)
        assert (counts.of(stage)["mul"], counts.of(stage)["add"]) == (own["mul"] + mul, own["add"] + add), stage
    total = counts.of(TOTAL)
    for name in OPERATIONS:
        if name not in ("mul", "add"):
            assert total[name] == law.of(TOTAL)[name]


@pytest.mark.parametrize("arm", [arm for arm in ARMS if arm not in on_arms.ARM_OF.values()])
def test_cost_does_not_depend_on_the_arm_where_nothing_iterates(arm):
    usual = on_arms.ARM_OF[tasks.arm(arm).joints]
    for word in contenders("inverses"):
        if word in ITERATES:
            continue
        one = named(usual, f"rotation-matrix@geometric+{word}")
        assert cost_on_arm(one, arm).typical.of(TOTAL) == cost_on_arm(one, usual).typical.of(TOTAL), word


def test_every_controller_of_the_default_suite_can_be_counted():
    from bench.experiments.suites import SUITES

    for arm in on_arms.ARM_OF.values():
        for one in combinations.on(SUITES["default"].sections["arm"]["words"], LAWS, tasks.arm(arm).joints):
            total = cost_on_arm(one, arm).typical.of(TOTAL)
            assert total["mul"] > 200, one.name


@kernel
def asks_who_calls(J, a, D, x, rows, n, scratch):
    """Twice the command if it is counted."""
    for i in range(n):
        x[i] = a[i] + a[i] if hasattr(a[i], "tally") else a[i]


def test_controller_that_commands_other_torques_when_counted_is_refused():
    own = Inverse("own", "", "", "", asks_who_calls, "acceleration", lambda rows, n: "")
    one = named("ur5e", "rotation-matrix@geometric+solve")._replace(inverse=own)
    with pytest.raises(BadLaw, match="must not depend on the type of its numbers"):
        on_arms.cost_on_arm(one, "ur5e")


N = 6

cost_in_contact = functools.cache(in_contact.cost_in_contact)


def holding(count: int) -> Specification:
    """So many rows held, the first ones."""
    return Specification("", tuple(int(i < count) for i in range(N)))


def muls_divs_adds(one: ContactController, specification: Specification, stage: str) -> tuple[int, int, int]:
    counts = cost_in_contact(one, specification).typical.of(stage)
    return counts["mul"], counts["div"], counts["add"]


def torques_by_hand(held: int) -> tuple[int, int, int]:
    """Elimination and back substitution (Golub & Van Loan 2013, 3.2), D y, J^T F, two sums a torque, and the rows."""
    steps = sum(m * (m + 1) for m in range(1, N)) + N * (N - 1) // 2
    complies = N - held
    return (
        steps + 2 * N * N + complies,
        N * (N - 1) // 2 + N + complies,
        steps + 2 * N * (N - 1) + 2 * N + held + 3 * complies,
    )


def projection_by_hand(held: int) -> tuple[int, int, int]:
    """S J (S J)^T, its Cholesky factors, two triangles, (S J)^T times that, and its sum with the rest."""
    k, pairs = held, held * (held - 1) // 2
    gram, factors = k * (k + 1) // 2, pairs + sum(j * (k - 1 - j) for j in range(k))
    return (
        gram * N + factors + pairs + 2 * pairs + 2 * k + N * k,
        k,
        gram * (N - 1) + factors + 2 * pairs + N * (k - 1) + N,
    )


@pytest.mark.parametrize("held", range(N + 1))
def test_torques_cost_what_a_count_by_hand_says(held):
    one = hybrid("hybrid-base", "inverse")
    assert muls_divs_adds(one, holding(held), "invert") == torques_by_hand(held)


@pytest.mark.parametrize("held", range(1, N + 1))
def test_projected_form_costs_a_pseudo_inverse_of_what_is_held_besides(held):
    inverse, projected = (
        np.array(muls_divs_adds(hybrid("hybrid-base", form), holding(held), "invert"))
        for form in ("inverse", "projected")
    )
    assert tuple(projected - inverse) == projection_by_hand(held)
    assert cost_in_contact(hybrid("hybrid-base", "projected"), holding(held)).typical.of("invert")["sqrt"] == held


def test_axes_carried_by_the_hand_cost_two_rotations_of_every_column_and_row():
    """Six columns of J and four rows, each of two vectors; a rotation is 9 multiplications and 6 additions."""
    base, carried = (
        np.array(muls_divs_adds(hybrid(law, "inverse"), in_contact.TILTING, "regulate"))
        for law in ("hybrid-base", "hybrid-hand")
    )
    vectors = 2 * (6 + 4)
    assert tuple(carried - base) == (2 * 9 * vectors, 0, 2 * 6 * vectors)


@pytest.mark.parametrize("representation", COORDINATES.values(), ids=COORDINATES)
def test_conversion_of_moments_costs_two_products_with_B_transposed(representation):
    """The measured moment and the one to exert are both converted."""
    tally = Tally()
    state = arm_states(ARM_OF[6])[0]
    at = representation.chart(state.chain.R)
    representation.generalized(counted(at, tally), counted((1.0, 2.0, 3.0), tally))
    once = tally.take().of(TOTAL)
    converted, left = (
        cost_in_contact(hybrid(law, "inverse", representation)).typical.of(TOTAL)
        for law in ("hybrid", "hybrid-unconverted")
    )
    for name in ("add", "mul", "div"):
        assert converted[name] - left[name] == 2 * once[name], name


@pytest.mark.parametrize("one", [*HYBRIDS, *IMPEDANCES])
def test_every_controller_can_be_counted_and_costs_the_same_at_least_in_the_worst_branch(one):
    found = cost_in_contact(one)
    typical, worst = (sum(counts.of(TOTAL)[name] for name in OPERATIONS) for counts in (found.typical, found.worst))
    assert 800 < typical <= worst
