"""Contracts that every inverse in contenders/inverses keeps; a new file is under them. Oracle: numpy.linalg."""

import numpy as np
import pytest
from support.bits import same_bits
from support.buffers import as_counted, buffer, scratch
from support.each import each
from support.filling import FACTORED, SHAPES, A, accepted, anything, inertia, resolved, well_conditioned

from bench.engines.compiled import compile_on_demand
from bench.law.contenders.registry import contenders

EVERY = contenders("inverses").values()
ACCELERATIONS, TORQUES = ([one for one in EVERY if one.gives == what] for what in ("acceleration", "torque"))

inverse = each(EVERY)


def test_it_accepts_some_shape_and_refusals_name_a_cure(inverse):
    assert inverse.gives in ("acceleration", "torque")
    assert (6, 6) in accepted(inverse)
    for shape in SHAPES:
        reason = inverse.refuses(*shape)
        assert isinstance(reason, str)
        if reason:
            assert f"{shape[0]} x {shape[1]}" in reason
            cures = [word for word in contenders("inverses") if word in reason and word != inverse.name]
            assert any(not contenders("inverses")[word].refuses(*shape) for word in cures)


def test_counted_and_compiled_answers_are_the_plain_ones_bit_for_bit_and_all_is_counted(inverse):
    compiled = compile_on_demand(inverse.resolve)
    for rows, n in accepted(inverse):
        for word, J in anything(rows, n).items():
            plain, _ = resolved(inverse, J, A[:rows], inertia(n))
            counted, _ = resolved(inverse, J, A[:rows], inertia(n), object)
            native, _ = resolved(inverse, J, A[:rows], inertia(n), resolve=compiled)
            assert same_bits(counted, plain), (rows, n, word, "counted")
            assert same_bits(native, plain), (rows, n, word, "compiled")
        given = [as_counted(buffer(part)) for part in (well_conditioned(rows, n)[0], A[:rows], inertia(n))]
        x = buffer(np.full(n, np.nan), object)
        inverse.resolve(*given, x, rows, n, scratch(object))
        assert all(hasattr(number, "tally") for number in x[:n])


def test_linear_in_the_command(inverse):
    """x of 2 a is twice x of a, exactly: a doubling rounds nothing."""
    for rows, n in accepted(inverse):
        for J in well_conditioned(rows, n):
            once, _ = resolved(inverse, J, A[:rows], inertia(n))
            twice, _ = resolved(inverse, J, 2.0 * A[:rows], inertia(n))
            assert same_bits(twice, 2.0 * once)


@pytest.mark.parametrize("one", ACCELERATIONS)
def test_acceleration_of_the_tool_is_the_one_asked_for(one):
    """J x = a for all of a that the rank allows; none may lose more than a twentieth of it at sigma > 0.1."""
    for rows, n in accepted(one):
        for J in well_conditioned(rows, n):
            x, _ = resolved(one, J, A[:rows], inertia(n))
            reachable = J @ (np.linalg.pinv(J) @ A[:rows])
            # W a is up to 1 / LENGTH = 2 times as long as a
            assert np.linalg.norm(J @ x - reachable) <= 0.05 * 2.0 * np.linalg.norm(A[:rows])


@pytest.mark.parametrize("one", TORQUES)
def test_torque_moves_nothing_that_the_tool_does_not_see(one):
    """It is J^T of some force."""
    for rows, n in accepted(one):
        for J in well_conditioned(rows, n):
            x, _ = resolved(one, J, A[:rows], inertia(n))
            unseen = np.eye(n) - np.linalg.pinv(J) @ J
            assert np.linalg.norm(unseen @ x) <= FACTORED * np.linalg.cond(J) * np.linalg.norm(x)
            assert np.linalg.norm(x) > 0.0


def test_matrices_that_are_not_finite_or_singular_raise_nothing_and_all_that_is_given_is_left(inverse):
    for rows, n in accepted(inverse):
        for J in anything(rows, n).values():
            for a in (A[:rows], np.full(rows, np.nan), np.full(rows, np.inf)):
                x, left = resolved(inverse, J, a, inertia(n))
                assert x.shape == (n,)
                assert all(map(same_bits, left, map(buffer, (J, a, inertia(n)))))
