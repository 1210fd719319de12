"""Costs kept between processes: counted once for a state of the sources, and anew for another."""

import pytest

from bench import kept_costs
from bench.kept_costs import kept


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """An empty cache."""
    monkeypatch.setattr(kept_costs.cache, "FOLDER", tmp_path / "cache")
    return tmp_path / "cache"


def rows(flops):
    """A function that counts its calls."""
    calls = []

    def count():
        calls.append(flops)
        return [{"stage": "total", "flops": flops}]

    return count, calls


def test_is_counted_once(folder):
    count, calls = rows(7)
    assert [kept("mrp/of-a-law", count) for _ in range(3)] == [[{"stage": "total", "flops": 7}]] * 3
    assert calls == [7]


def test_other_sources_are_counted_anew(folder, monkeypatch):
    assert kept("mrp", rows(7)[0])[0]["flops"] == 7
    monkeypatch.setattr(kept_costs, "source_digest", lambda: "0123456789abcdef")
    assert kept("mrp", rows(8)[0])[0]["flops"] == 8


def test_without_room_it_is_counted_each_time(folder):
    folder.write_text("a file where the folder should be")
    count, calls = rows(7)
    assert kept("mrp", count) == kept("mrp", count)
    assert calls == [7, 7]
