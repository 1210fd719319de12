"""Restated controllers against their sources: the committed comparison, and the study on a source made here."""

import mpmath
import numpy as np
import pinocchio
import pytest

from bench.base.files import read_json
from bench.findings.libraries import RESTATED
from bench.law.contenders.registry import contenders
from bench.studies.restated import __main__ as study

ROWS = {row["name"]: row for row in read_json(RESTATED)["controllers"]}
LIMIT = 1e-12
EXACT = mpmath.mp.clone()
EXACT.dps = 40

LOSING = {
    "crisp": lambda e: np.clip(e, -0.5, 0.5),
    "fzi-motion": lambda e: e * min(1.0, 1.0 / np.linalg.norm(e)),
    "pink": lambda e: e,
}
"""Controllers whose source takes an axis from a matrix that is nearly symmetric -> what they make of the logarithm."""


def compute_exact_logarithm(pair):
    """Return the rotation vector from now to goal (w, x, y, z each) by 40 digits, rounded once."""
    (w, x, y, z), (a, b, c, d) = (map(EXACT.mpf, one) for one in np.split(pair, 2))
    scalar = w * a + x * b + y * c + z * d
    v = (x * a - w * b - y * d + z * c, y * a - w * c - z * b + x * d, z * a - w * d - x * c + y * b)
    size = EXACT.sqrt(sum(part * part for part in v))
    angle = 2 * EXACT.atan2(size, abs(scalar)) * (1 if scalar >= 0 else -1)
    return np.array([float(angle * part / size) for part in v])


def test_every_controller_was_compared_at_the_commit_that_it_names():
    assert set(ROWS) == set(contenders("shipped"))
    for name, one in contenders("shipped").items():
        assert f"{ROWS[name]['repository']}@{ROWS[name]['commit']}" == one.source
        assert ROWS[name]["file"] in one.path.split(", ")


@pytest.mark.parametrize("row", ROWS.values(), ids=lambda row: row["name"])
def test_controller_equals_its_source_where_it_was_built_and_lines_are_those_that_the_study_marks(row):
    if "reason" in row:
        assert row["reason"]
    else:
        assert row["pairs"] == study.PAIRS
        assert row["difference"] <= LIMIT
        assert (row["near_180"] > LIMIT) == (row["name"] in LOSING)
    [source] = study.SOURCES.glob(f"{row['name'].replace('-', '_')}.*")
    marks = [mark for mark in study.MARK.finditer(source.read_text()) if mark["file"] == row["file"]]
    assert row["lines"] == ", ".join(f"{mark['first']}-{mark['last']}" for mark in marks)
    assert all(int(mark["first"]) <= int(mark["last"]) for mark in marks)


def test_restatement_is_exact_beyond_175_degrees_where_three_sources_lose_digits():
    """What the sources lose is what they differ from the restatement by: 5e-11 at most, that of pinocchio's log3."""
    pairs = study.pairs()
    turns = study.turns_of(pairs)
    near = np.flatnonzero(turns.magnitude() > study.NEAR_180_RAD)
    exact = np.array([compute_exact_logarithm(pair) for pair in pairs[near]])
    for name, made in LOSING.items():
        ours = study.errors_of(contenders("shipped")[name], turns[near])
        assert np.linalg.norm(ours - [made(e) for e in exact], axis=1).max() <= 2e-15
        assert LIMIT < ROWS[name]["near_180"] < 5e-11
    logarithms = np.array([pinocchio.log3(R) for R in turns[near].as_matrix()])
    assert 1e-11 < np.linalg.norm(logarithms - exact, axis=1).max() < 1e-10


@pytest.mark.parametrize("row", [row for row in ROWS.values() if "errors" in row], ids=lambda row: row["name"])
def test_kernel_gives_what_the_source_gave(row):
    turns = study.turns_of(study.pairs()[study.KEPT])
    found = study.errors_of(contenders("shipped")[row["name"]], turns)
    is_far = turns.magnitude() <= study.NEAR_180_RAD
    np.testing.assert_allclose(found[is_far], np.array(row["errors"])[is_far], rtol=0.0, atol=LIMIT)


@pytest.mark.parametrize(("factor", "difference"), [("1.0", 0.0), ("1.5", 0.5)])
def test_study_finds_a_source_that_differs(tmp_path, factor, difference):
    one = contenders("shipped")["libfranka"]
    file = tmp_path / "frankaemika+libfranka" / "examples" / "theirs.py"
    file.parent.mkdir(parents=True)
    file.write_text(f"before\n    v = {factor} * turn.as_quat(canonical=True)[:3]\nafter\n")
    source = tmp_path / "libfranka.python"
    source.write_text(
        "from scipy.spatial.transform import Rotation\n\n\ndef error(goal, now):\n"
        "    both = [Rotation.from_quat(q, scalar_first=True) for q in (goal, now)]\n"
        "    turn = both[0] * both[1].inv()\n    #@ examples/theirs.py 2-2\n    return v\n"
    )
    row = study.compare(one, source, tmp_path, [])
    assert row["lines"] == "2-2"
    assert row["difference"] == pytest.approx(difference, abs=0.01 if difference else 1e-15)


def test_source_without_a_copy_is_read_and_says_why(tmp_path):
    row = study.compare(contenders("shipped")["libfranka"], study.SOURCES / "libfranka.cpp", tmp_path, [])
    assert "not built" in row["reason"]
    assert study.kept(row, list(ROWS.values())) == ROWS["libfranka"]
    assert study.kept(row | {"commit": "another"}, list(ROWS.values()))["commit"] == "another"
