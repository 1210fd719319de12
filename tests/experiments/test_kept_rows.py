"""Rows kept between processes: made once for a state of the sources; a user's own law is counted each time."""

import pytest

import tasks
from bench.engines import cache, counting
from bench.experiments import starts
from bench.experiments.costs import count_operations
from bench.experiments.kept_rows import kept
from bench.law.contenders.registry import find_contender

LAW = find_contender("mrp")
ROW = {"law": "mrp", "branch": "worst", "add": 3}


@pytest.fixture
def made():
    """Every call of what makes rows."""
    return []


@pytest.fixture
def of(tmp_path, made):
    """of(name, sources) -> its rows, from an empty folder that is kept."""

    def make():
        made.append(1)
        return [ROW]

    return lambda name="costs/mrp", sources="": kept(name, make, tmp_path / "cache", sources)


def test_are_made_once(of, made):
    assert [of(name) for name in ("costs/mrp-6", "costs/mrp-7", "costs/mrp-6")] == [[ROW]] * 3
    assert len(made) == 2


def test_of_other_sources_are_made_anew(of, made):
    assert of() == of(sources="0123456789abcdef")
    assert len(made) == 2


def test_without_room_are_made_each_time(of, made, tmp_path):
    (tmp_path / "cache").write_text("a file where the folder should be")
    assert of() == of()
    assert len(made) == 2


def test_law_of_a_user_is_not_kept():
    own = LAW._replace(regulator=LAW.regulator._replace(name="nobody-s", origin="nobody_s.py"))
    assert count_operations(own) == counting.rows([own])
    assert not list((cache.FOLDER / "costs").glob("*nobody-s*"))


def test_what_is_kept_is_what_is_counted():
    assert count_operations(LAW) == counting.rows([LAW])
    one = find_contender("rotation-matrix@geometric+solve")
    assert count_operations(one, 6) == counting.rows_on_arm(one, 6)


@pytest.mark.parametrize("count", [None, 1, 40])
@pytest.mark.parametrize("start_set", ["half-turn", "tumbling"])
def test_starts_on_an_arm_are_the_judges_to_the_bit(start_set, count):
    theirs = tasks.start_set(start_set, count, 3, arm="ur5e")
    for _ in ("as found", "as kept"):
        starts.found.cache_clear()
        assert list(map(repr, starts.on_arm(start_set, count, 3, "ur5e"))) == list(map(repr, theirs))
    assert starts.count_of(start_set, count, 3, "ur5e") == len(theirs)
