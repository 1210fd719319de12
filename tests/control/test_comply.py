"""`comply`: joint accelerations and torques of given rows, against formulas in numpy, for every selection."""

import itertools

import numpy as np
import pytest
from support.bits import EPS
from support.in_contact import LONGEST, SELECTIONS, TOUCH, backward

from bench.control.contact_controller import ACCELERATION_FORMS, FORMS, PAPERS_FORM
from bench.control.hybrid import comply
from bench.engines.contact_episode import room, rows

IN_FORMS = pytest.mark.parametrize("form", FORMS)


def given(count: int = 6):
    """J, D, fg and rows, drawn; J with a condition of some tens."""
    draw = np.random.default_rng(31)
    while count:
        J, root = draw.normal(size=(2, 6, 6))
        if np.linalg.cond(J) > 50.0:
            continue
        count -= 1
        into = rows()
        for row in into:
            row[:] = draw.normal(scale=5.0, size=6)
        yield J, root @ root.T + np.eye(6), draw.normal(size=6), into


def complied(form: str, held, J, D, fg, into):
    """(y, tau) of `comply`."""
    about, tau = room(), np.full(6, np.nan)
    for buffer in (about.y, about.b, about.held, *about.scratch):
        buffer[...] = np.nan
    comply(FORMS.index(form), held, 6, D, fg, J, into, TOUCH, about, tau)
    return about.y, tau


def answer(form, into) -> np.ndarray:
    """What is commanded where the hand complies: m_p is of x, y, z, m_o of the turns, kc of all."""
    driven = 0.0 if form == PAPERS_FORM else (into.F + into.h) / np.repeat((TOUCH.m_p, TOUCH.m_o), 3)
    return driven - TOUCH.kc * into.v


def exerted(form, held, into) -> np.ndarray:
    """w: the measured wrench cancelled, or what is to be exerted and its error where the hand complies."""
    if form == PAPERS_FORM:
        return (1.0 - np.array(held)) * (into.h + TOUCH.kf * (into.h + into.F))
    return -into.F


def by_formula(form: str, held, J, into) -> np.ndarray:
    """y: see the docstring of bench.control.hybrid."""
    S, left = np.diag(held), np.eye(6) - np.diag(held)
    complies = np.linalg.solve(J, left @ (answer(form, into) - into.drift))
    if form == "projected":
        return complies + np.linalg.pinv(S @ J) @ (into.a - into.drift)
    return complies + np.linalg.solve(J, S @ (into.a - into.drift))


@IN_FORMS
def test_torques_are_the_formula_for_every_selection(form):
    for (J, D, fg, into), held in itertools.product(given(), SELECTIONS):
        y, tau = complied(form, held, J, D, fg, into)
        wanted, w = by_formula(form, held, J, into), exerted(form, held, into)
        size = np.linalg.norm(np.linalg.inv(J), 2) * np.linalg.norm([answer(form, into), into.a, into.drift])
        np.testing.assert_allclose(y, wanted, rtol=0.0, atol=backward(J) * size, err_msg=held)
        allowed = backward(J) * (np.linalg.norm(D, 2) * size + np.linalg.norm(J, 2) * np.linalg.norm(w))
        np.testing.assert_allclose(tau, D @ wanted + fg + J.T @ w, rtol=0.0, atol=allowed, err_msg=held)


def test_forms_of_acceleration_are_one_where_all_is_held_or_all_complies_and_two_elsewhere():
    for J, D, fg, into in given():
        for held in SELECTIONS:
            one, other = (complied(form, held, J, D, fg, into)[0] for form in ACCELERATION_FORMS)
            size = np.linalg.norm(np.linalg.inv(J), 2) * LONGEST
            apart = np.linalg.norm(one - other)
            assert apart <= backward(J) * size if len(set(held)) == 1 else apart > 1e-3, held


def test_projected_form_holds_with_the_least_motion_of_the_joints():
    """Where nothing acts on what complies, y is lstsq's answer of least norm to S J y = S (a - drift)."""
    for (J, D, fg, into), held in itertools.product(given(), SELECTIONS[1:]):
        kept, nothing = np.array(held) > 0.0, np.zeros(6)
        quiet = into._replace(drift=np.where(kept, into.drift, 0.0), F=nothing, h=nothing, v=nothing)
        y, _ = complied("projected", held, J, D, fg, quiet)
        least = np.linalg.lstsq(J[kept], (into.a - into.drift)[kept], rcond=None)[0]
        np.testing.assert_allclose(y, least, rtol=0.0, atol=backward(J) * np.linalg.norm(np.linalg.inv(J), 2) * LONGEST)


@IN_FORMS
def test_hand_stays_at_rest_where_the_wrench_is_the_wished_one(form):
    """F = -h: y = 0, and the torques fg + J^T h are those that hold against it statically."""
    for J, D, fg, into in given():
        still = into._replace(F=-into.h, v=np.zeros(6), drift=np.zeros(6))
        y, tau = complied(form, (0.0,) * 6, J, D, fg, still)
        assert (y == 0.0).all()
        # six products a torque, and the row of J no longer than all of it
        allowed = 12 * EPS * (np.linalg.norm(J) * np.linalg.norm(into.h) + np.linalg.norm(fg))
        np.testing.assert_allclose(tau, fg + J.T @ into.h, rtol=0.0, atol=allowed)
