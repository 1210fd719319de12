"""Costs kept between processes: ours are counted once for a state of the sources, a user's own each time."""

import pytest

from bench import counting
from bench.contenders.registry import find_contender
from bench.tables import kept_costs
from bench.tables.kept_costs import of_controller, of_law

LAW = find_contender("mrp")


@pytest.fixture
def calls(tmp_path, monkeypatch):
    """What is counted from now on, with an empty cache."""
    calls = []
    monkeypatch.setattr(kept_costs.cache, "FOLDER", tmp_path / "cache")
    monkeypatch.setattr(counting, "rows", lambda laws: [{"law": calls.append(one) or one.name} for one in laws])
    monkeypatch.setattr(counting, "rows_on_arm", lambda one, joints: [{"joints": calls.append(one) or joints}])
    return calls


def test_is_counted_once(calls):
    assert [of_law(LAW) for _ in range(3)] == [[{"law": "mrp"}]] * 3
    assert [of_controller(LAW, joints) for joints in (6, 7, 6)] == [[{"joints": 6}], [{"joints": 7}], [{"joints": 6}]]
    assert calls == [LAW] * 3


def test_columns_keep_their_order(calls, monkeypatch):
    row = {"law": "mrp", "branch": "worst", "add": 3}
    monkeypatch.setattr(counting, "rows", lambda _: [row])
    assert [list(one.items()) for _ in range(2) for one in of_law(LAW)] == [list(row.items())] * 2


def test_law_of_a_user_is_counted_each_time(calls):
    own = LAW._replace(regulator=LAW.regulator._replace(origin="mrp.py"))
    assert of_law(own) == of_law(own)
    assert calls == [own, own]


def test_other_sources_are_counted_anew(calls, monkeypatch):
    of_law(LAW)
    monkeypatch.setattr(kept_costs, "source_digest", lambda: "0123456789abcdef")
    of_law(LAW)
    assert len(calls) == 2


def test_without_room_it_is_counted_each_time(calls):
    kept_costs.cache.FOLDER.write_text("a file where the folder should be")
    assert of_law(LAW) == of_law(LAW) == [{"law": "mrp"}]
    assert len(calls) == 2
