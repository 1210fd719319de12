"""Costs kept between processes: ours are counted once for a state of the sources, a user's own each time."""

import pytest

from bench import counting
from bench.contenders.registry import find_contender
from bench.tables.kept_costs import kept, of_controller, of_law

LAW = find_contender("mrp")
OWN = LAW._replace(regulator=LAW.regulator._replace(origin="mrp.py"))
ROW = {"law": "mrp", "branch": "worst", "add": 3}


@pytest.fixture
def counted():
    """Every call of what counts."""
    return []


@pytest.fixture
def of(tmp_path, counted):
    """of(contender, name, sources) -> its rows, from an empty folder that is kept."""

    def count():
        counted.append(1)
        return [ROW]

    return lambda one=LAW, name="mrp", sources="": kept(one, name, count, tmp_path / "cache", sources)


def test_is_counted_once(of, counted):
    assert [of(name=name) for name in ("mrp-6", "mrp-7", "mrp-6")] == [[ROW]] * 3
    assert len(counted) == 2


def test_columns_keep_their_order(of):
    assert [list(one.items()) for _ in range(2) for one in of()] == [list(ROW.items())] * 2


def test_law_of_a_user_is_counted_each_time(of, counted):
    assert of(OWN) == of(OWN)
    assert len(counted) == 2


def test_other_sources_are_counted_anew(of, counted):
    assert of() == of(sources="0123456789abcdef")
    assert len(counted) == 2


def test_without_room_it_is_counted_each_time(of, counted, tmp_path):
    (tmp_path / "cache").write_text("a file where the folder should be")
    assert of() == of()
    assert len(counted) == 2


def test_what_is_kept_is_what_is_counted():
    assert of_law(LAW) == counting.rows([LAW])
    one = find_contender("rotation-matrix@geometric+solve")
    assert of_controller(one, 6) == counting.rows_on_arm(one, 6)
