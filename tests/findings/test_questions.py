"""Questions of users: the number is wrong without the cure and right with it."""

import re

import pytest

from bench.findings.questions import QUESTIONS


@pytest.mark.parametrize("one", QUESTIONS, ids=lambda one: one.threads[0])
def test_symptom_shows_and_cure_cures(one):
    before, after = one.measure()
    assert abs(before - one.right) > max(one.tolerance, 0.05)
    assert abs(after - one.right) <= one.tolerance


def test_threads_are_addresses_and_each_is_there_once():
    threads = [thread for one in QUESTIONS for thread in one.threads]
    assert all(re.fullmatch(r"[\w.-]+/[\w.-]+#\d+", thread) for thread in threads)
    assert len(set(threads)) == len(threads)
