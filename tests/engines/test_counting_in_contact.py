"""What a controller in contact costs: against a count by hand of its torques, and of what sets two of them apart."""

import functools

import numpy as np
import pytest
from support.in_contact import COORDINATES, HYBRIDS, IMPEDANCES

from bench.engines.counting import in_contact
from bench.engines.counting.costs import counted
from bench.engines.counting.counted import OPERATIONS, TOTAL, Tally
from bench.engines.counting.on_arms import ARM_OF, arm_states
from bench.law.control.contact_controller import ContactController, hybrid
from tasks.contact import Specification

N = 6

cost = functools.cache(in_contact.cost_in_contact)


def holding(count: int) -> Specification:
    """So many rows held, the first ones."""
    return Specification("", tuple(int(i < count) for i in range(N)))


def muls_divs_adds(one: ContactController, specification: Specification, stage: str) -> tuple[int, int, int]:
    counts = cost(one, specification).typical.of(stage)
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
    assert cost(hybrid("hybrid-base", "projected"), holding(held)).typical.of("invert")["sqrt"] == held


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
        cost(hybrid(law, "inverse", representation)).typical.of(TOTAL) for law in ("hybrid", "hybrid-unconverted")
    )
    for name in ("add", "mul", "div"):
        assert converted[name] - left[name] == 2 * once[name], name


@pytest.mark.parametrize("one", [*HYBRIDS, *IMPEDANCES], ids=lambda one: one.name)
def test_every_controller_can_be_counted_and_costs_the_same_at_least_in_the_worst_branch(one):
    found = cost(one)
    typical, worst = (sum(counts.of(TOTAL)[name] for name in OPERATIONS) for counts in (found.typical, found.worst))
    assert 800 < typical <= worst
