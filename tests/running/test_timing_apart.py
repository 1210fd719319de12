"""A user's law is timed beside ours in a process of its own, whose end is not the end of this one."""

import pytest
from support.user_law import spring_text

from bench.base.errors import BadLaw
from bench.law.contenders.described_law import described
from bench.law.contenders.registry import contenders_of, find_contender
from bench.running import timing


def contenders(tmp_path, *lines):
    """A law of ours, and one of a user's with these lines."""
    path = tmp_path / "own.py"
    path.write_text(spring_text(*lines))
    return [find_contender("rotation-matrix"), *contenders_of(described(path))]


def test_law_of_a_user_is_timed_beside_ours(tmp_path):
    told = []
    given = {"quick": True, "report": told.append, "json_file": tmp_path / "samples.json"}
    path = timing.run_apart(contenders(tmp_path), tmp_path / "timings", **given)
    assert '"name": "law mine"' in given["json_file"].read_text()
    rows = timing.read(path)
    assert {"mine", "rotation-matrix"} <= set(rows["regulator"].astype(str))
    assert {one.name for one in told if one.total == 0} == {"mine", "rotation-matrix"}
    assert told[-1].done == told[-1].total > 0


def test_law_that_ends_its_process_is_refused(tmp_path):
    made = contenders(tmp_path, "if R.n[0] < 2.0 and omega[0] == omega[0]: os._exit(0)")
    with pytest.raises(BadLaw, match=r"own\.py"):
        timing.run_apart(made, tmp_path / "timings", quick=True)
    assert not (tmp_path / "timings").exists()
