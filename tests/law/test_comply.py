"""`comply`: joint accelerations and torques of given rows, against formulas in numpy, for every selection."""

import itertools
from typing import NamedTuple

import numpy as np
import pytest
from support.in_contact import GAINS, SELECTIONS, TOUCH, backward, damping

from bench.engines.contact_episode import room, rows
from bench.law.chain import Chain
from bench.law.control.contact_controller import FORMS, PAPERS_FORM
from bench.law.control.hybrid import comply
from bench.law.control.setpoint import Rows

IN_FORMS = pytest.mark.parametrize("form", FORMS)
ON_JOINTS = pytest.mark.parametrize("n", [6, 7])


class Given(NamedTuple):
    """What `comply` is given, drawn."""

    J: np.ndarray
    D: np.ndarray
    fg: np.ndarray
    qdot: np.ndarray
    rows: Rows


def given(n: int, count: int = 6):
    """So many; J with a condition of some tens."""
    draw = np.random.default_rng(31)
    while count:
        J, root = draw.normal(size=(6, n)), draw.normal(size=(n, n))
        if np.linalg.cond(J) > 50.0:
            continue
        count -= 1
        into = rows()
        for row in into:
            row[:] = draw.normal(scale=5.0, size=6)
        yield Given(J, root @ root.T + np.eye(n), draw.normal(size=n), draw.normal(size=n), into)


def complied(form: str, held, at: Given):
    """tau of `comply`."""
    n = len(at.fg)
    about, tau = room(), np.full(n, np.nan)
    for buffer in (about.y, about.b, about.x, about.held, *about.scratch):
        buffer[...] = np.nan
    chain = Chain(n, None, None, at.qdot, None, None)
    comply(FORMS.index(form), held, chain, at.D, at.fg, at.J, at.rows, GAINS, TOUCH, about, tau)
    return tau


def inverse(at: Given) -> np.ndarray:
    """J^#, n x 6: the dynamically consistent one, D^-1 J^T Lambda; on six joints J^-1."""
    if len(at.fg) == 6:
        return np.linalg.inv(at.J)
    weighed = np.linalg.solve(at.D, at.J.T)
    return weighed @ np.linalg.inv(at.J @ weighed)


def size(form: str, at: Given) -> float:
    """No y is longer [rad/s^2]."""
    into = at.rows
    along = np.linalg.norm([answer(form, into), into.a, into.drift]) + np.linalg.norm(at.J @ damping(at.qdot))
    return np.linalg.norm(inverse(at), 2) * along + np.linalg.norm(damping(at.qdot))


def answer(form, into) -> np.ndarray:
    """What is commanded where the hand complies: m_p is of x, y, z, m_o of the turns, kc of all."""
    driven = 0.0 if form == PAPERS_FORM else (into.F + into.h) / np.repeat((TOUCH.m_p, TOUCH.m_o), 3)
    return driven - TOUCH.kc * into.v


def exerted(form, held, into) -> np.ndarray:
    """w: the measured wrench cancelled, or what is to be exerted and its error where the hand complies."""
    if form == PAPERS_FORM:
        return (1.0 - np.array(held)) * (into.h + TOUCH.kf * (into.h + into.F))
    return -into.F


def by_formula(form: str, held, at: Given) -> np.ndarray:
    """y: see the docstring of bench.law.control.hybrid."""
    S, left, into, z = np.diag(held), np.eye(6) - np.diag(held), at.rows, damping(at.qdot)
    through = inverse(at)
    complies = through @ left @ (answer(form, into) - into.drift - at.J @ z)
    holds = S @ (into.a - into.drift - at.J @ z)
    return complies + (np.linalg.pinv(S @ at.J) if form == "projected" else through) @ holds + z


@IN_FORMS
@ON_JOINTS
def test_torques_are_the_formula_for_every_selection(n, form):
    for at, held in itertools.product(given(n), SELECTIONS):
        wanted, w = by_formula(form, held, at), exerted(form, held, at.rows)
        sizes = np.linalg.norm(at.D, 2) * size(form, at) + np.linalg.norm(at.J, 2) * np.linalg.norm(w)
        allowed = backward(at.J) * np.linalg.cond(at.D) * sizes  # normal equations with J and with D
        tau = complied(form, held, at)
        np.testing.assert_allclose(tau, at.D @ wanted + at.fg + at.J.T @ w, rtol=0.0, atol=allowed, err_msg=held)
