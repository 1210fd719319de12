"""The paper's claims: all present, decided by the data, and refused without any."""

import itertools
import math
import subprocess

import numpy as np
import pandas as pd
import pytest
from support.tables import changed, decided, judged

from bench.contenders.registry import representation
from bench.findings import claims
from bench.findings.claims import degeneracy, probes
from bench.findings.claims.errata import ERRATA
from bench.findings.claims.tables import Results, share
from bench.findings.claims.verdict import HISTORY, Claim, Evidence, NoEvidence, Word, decide, read_texts
from bench.law.contender import Gains
from bench.provenance import ROOT
from bench.tables import read

TESTED = tuple(f"C{i:02d}" for i in range(1, 18))
WITHOUT_TABLES = ("C13", "C15")
LAWS = ("rotation-matrix", "linearized-euler", "linearized-euler-relative", "feedback-linearized")
REFERENCE = ROOT / "results" / "reference"
TABLES = ("episodes", "costs", "traces", "boundaries")


@pytest.fixture(scope="session")
def frames():
    """The committed run of the quick suite, which `make gate` holds to today's code: the paper's laws, free body."""
    reference, found = Results(REFERENCE), {}
    for name in TABLES:
        frame = reference.table(name, **read.FREE_BODY)
        of_the_paper = frame["regulator"].isin(LAWS) & frame["representation"].isin(("", "zyx-euler"))
        found[name] = frame if name == "costs" else frame[of_the_paper]
    return found | {"timings": reference.timings(), "map": pd.DataFrame(), "counted": pd.DataFrame(spun())}


def spun():
    """Random starts at rest and spinning, of which the law that linearizes by feedback loses some at 20 rad/s."""
    for law in ("rotation-matrix", "linearized-euler/zyx-euler", "feedback-linearized/zyx-euler"):
        for speed in (0.0, 20.0):
            lost = 50 if speed and law.startswith("feedback") else 0
            speeds = {"contender": law, "least_speed": speed, "most_speed": speed}
            yield {**speeds, "starts": 10_000, "settled": 10_000 - lost, "unconverged": 0, "lost": lost}


def of(law, *start_sets, engine="ideal-rk4"):
    def rows(frame):
        chosen = (frame["regulator"] == law) & (frame["engine"] == engine)
        return chosen & frame["start_set"].isin(start_sets) if start_sets else chosen

    return rows


def law_of(regulator):
    """The rows of one law, whatever the table."""
    return lambda frame: frame["regulator"] == regulator


def test_every_claim_is_there_once():
    assert [one.id for one in claims.all_claims()] == [f"C{i:02d}" for i in range(1, 36)]


@pytest.mark.parametrize("one", claims.all_claims(), ids=lambda one: one.id)
def test_claim_has_its_texts_and_its_judge(one):
    assert all((one.section, one.sentence, one.judge, one.quote, one.value))
    assert "does not hold" in one.criterion or "answered since" in one.criterion
    assert bool(one.correction) == ("with a correction" in one.criterion)


@pytest.mark.parametrize("one", claims.all_claims(), ids=lambda one: one.id)
def test_criterion_and_those_before_it_name_a_commit_of_their_date(one):
    dates = [when.split() for when in (*(old.written for old in one.earlier), one.written)]
    assert [date for date, _ in dates] == sorted(date for date, _ in dates)
    for date, commit in dates:
        asked = ["git", "-C", str(ROOT), "log", "-1", "--format=%as", commit, "--"]
        found = subprocess.run(asked, capture_output=True, text=True, check=False)
        assert found.returncode or found.stdout.strip() == date  # a shallow clone may lack it


@pytest.mark.slow
@pytest.mark.parametrize("id", TESTED)
def test_claim_is_decided_by_a_quick_run(frames, id):
    verdict = judged(id, **frames)
    assert verdict.word in (Word.HOLDS, Word.CORRECTED, Word.FAILS)
    assert decided(verdict, verdict.word)


@pytest.mark.slow
def test_table_has_a_line_a_verdict(frames):
    verdicts = [judged(id, **frames) for id in ("C16", "C17")]
    table = claims.table(verdicts)
    assert list(table["claim"]) == ["C16", "C17"]
    assert list(table["rows"]) == [one.rows for one in verdicts]


@pytest.mark.slow
@pytest.mark.parametrize("id", [id for id in TESTED if id not in WITHOUT_TABLES])
def test_claim_is_refused_without_rows(frames, id):
    with pytest.raises(NoEvidence):
        judged(id, **{name: frame.iloc[:0] for name, frame in frames.items()})


def test_verdict_on_no_rows_is_an_error():
    nothing = Evidence("all of none", 0, ("episodes",))
    with pytest.raises(NoEvidence, match="C00: no row of episodes"):
        decide(Claim("C00", "", "", "", judge=lambda results: (Word.HOLDS, nothing)), None)


def test_history_is_of_claims():
    assert set(read_texts(HISTORY)) <= {one.id for one in claims.all_claims()}


def beside(frame):
    """A table with rows that no claim of chapter 2 is about: the same laws on an arm, and in other representations."""
    spoilt = frame.assign(regulator=frame["regulator"].astype(str), representation=frame["representation"].astype(str))
    for name, value in (("outcome", "diverged"), ("flops", 0), ("atan2", 0), ("time_s", 1e3), ("fails_from_rad", 0.1)):
        if name in frame:
            spoilt[name] = value
    on_arm = spoilt.assign(
        jacobian="geometric", inverse="solve", **({"task": "arm-regulation"} if "task" in frame else {})
    )
    together = pd.concat([on_arm, frame, spoilt.assign(representation="mrp")], ignore_index=True)
    together = read.with_contender(together)
    # evidence lists outcomes that are equally frequent in the order of their categories
    return together.astype({"outcome": frame["outcome"].dtype}) if "outcome" in frame else together


@pytest.mark.slow
@pytest.mark.parametrize("id", ["C03", "C06", "C09", "C12", "C14", "C17"])
def test_claim_of_the_free_body_looks_at_no_arm_and_no_other_coordinates(frames, id):
    more = {name: beside(frame) if name in TABLES else frame for name, frame in frames.items()}
    alone, among = judged(id, **frames), judged(id, **more)
    assert (among.word, str(among.evidence), among.rows) == (alone.word, str(alone.evidence), alone.rows)


def first(frame):
    return frame.index == frame.index[of("rotation-matrix", "uniform")(frame)][0]


def short(frame):
    return of("rotation-matrix", "uniform")(frame) & (frame["angle0_rad"] < 1.0)


def off_the_axes(frame):
    return of("rotation-matrix", "half-turn")(frame)


def outside(frame):
    return law_of("linearized-euler")(frame) & (frame["alpha0"].abs() >= math.pi / 2)


ALL_SETTLE = {"outcome": "settled"}


def slower(factor):
    return {"settling_time_s": lambda time: factor * time}


@pytest.mark.slow
@pytest.mark.parametrize(
    ("id", "word", "table", "rows", "cells"),
    [
        ("C01", Word.FAILS, "episodes", first, {"outcome": "diverged"}),
        ("C01", Word.FAILS, "episodes", short, {"final_angle_rad": 2.0}),  # energy grows
        ("C01", Word.HOLDS, "episodes", law_of("rotation-matrix"), ALL_SETTLE),
        ("C01", Word.HOLDS, "episodes", of("rotation-matrix", engine="native"), {"outcome": "diverged"}),  # our clock
        ("C01", Word.CORRECTED, "episodes", first, {"outcome": "timed-out"}),
        ("C02", Word.FAILS, "episodes", of("rotation-matrix", "goals"), slower(2)),
        ("C03", Word.CORRECTED, "episodes", of("rotation-matrix", "half-turn"), slower(1.05)),
        ("C03", Word.FAILS, "episodes", of("rotation-matrix", "half-turn"), slower(1.2)),
        ("C03", Word.FAILS, "episodes", of("rotation-matrix", "uniform"), {"settling_time_s": 1.0}),
        ("C05", Word.FAILS, "episodes", off_the_axes, {"quat_x": 1.0, "quat_y": 0.0, "quat_z": 0.0}),
        ("C06", Word.FAILS, "episodes", of("linearized-euler", "box"), {"outcome": "diverged"}),
        ("C07", Word.FAILS, "episodes", law_of("linearized-euler"), ALL_SETTLE | {"peak_u": 100.0}),
        ("C08", Word.FAILS, "episodes", of("linearized-euler-relative", "goals"), {"outcome": "timed-out"}),
        ("C09", Word.FAILS, "counted", lambda counted: counted["contender"].str.startswith("feedback"), {"lost": 200}),
        ("C09", Word.CORRECTED, "counted", lambda counted: counted["least_speed"] == 0.0, {"lost": 30}),
        ("C03", Word.HOLDS, "episodes", of("rotation-matrix", "half-turn"), {"horizon_s": 1.0}),
        ("C03", Word.CORRECTED, "episodes", of("rotation-matrix", "half-turn"), {"final_angle_rad": 3.0}),
        ("C10", Word.FAILS, "episodes", of("feedback-linearized", "poles"), ALL_SETTLE),
        ("C11", Word.FAILS, "episodes", of("feedback-linearized", "uniform"), {"peak_u": 1e5}),
        ("C17", Word.HOLDS, "episodes", law_of("feedback-linearized"), {"outcome": "diverged"}),
        # adequate everywhere
        ("C17", Word.FAILS, "episodes", law_of("rotation-matrix"), ALL_SETTLE | {"settling_time_s": 0.6}),
        ("C09", Word.FAILS, "traces", of("feedback-linearized"), {"time_s": lambda t: 1.1 * t}),  # a trace bends
        ("C12", Word.HOLDS, "costs", law_of("rotation-matrix"), {"flops": 1}),
        ("C12", Word.CORRECTED, "costs", law_of("linearized-euler"), {"flops": 1, "atan2": 0}),  # time says otherwise
    ],
)
def test_verdict_follows_the_table_when_it_contradicts(frames, id, word, table, rows, cells):
    assert judged(id, **frames | {table: changed(frames[table], rows(frames[table]), **cells)}).word == word


@pytest.mark.slow
def test_c06_holds_when_the_outside_fails(frames):
    episodes = frames["episodes"]
    episodes = changed(episodes, law_of("linearized-euler")(episodes), **ALL_SETTLE)
    episodes = changed(episodes, outside(episodes), outcome="diverged")
    assert judged("C06", **frames | {"episodes": episodes}).word == Word.HOLDS


def test_share_has_wilsons_interval():
    # Newcombe 1998, Statistics in Medicine 17, 857-872, table I: 81 of 263
    found = share(pd.Series([True] * 81 + [False] * 182))
    assert (found.low, found.high) == pytest.approx((0.2553, 0.3662), abs=5e-5)


def test_share_of_no_rows_is_an_error():
    with pytest.raises(NoEvidence):
        share(pd.Series([], dtype=bool))


def test_condition_of_the_rotation_vector_is_that_of_the_left_jacobian():
    # singular values 1 and 2 sin(angle / 2) / angle (twice)
    E = (0.8, -0.5, 1.1)
    angle = math.hypot(*E)
    R = representation("rotation-vector").to_matrix(E)
    expected = angle / (2 * math.sin(angle / 2))
    assert degeneracy.condition_in("rotation-vector", R) == pytest.approx(expected, rel=1e-12)


def test_condition_of_zyz_is_that_of_its_middle_angle():
    # B^T B has eigenvalues 1, 1 + cos(beta), 1 - cos(beta)
    expected = math.sqrt((1 + math.cos(0.3)) / (1 - math.cos(0.3)))
    R = representation("zyz-euler").to_matrix((0.4, 0.3, -0.9))
    assert degeneracy.condition_in("zyz-euler", R) == pytest.approx(expected, rel=1e-12)


def test_condition_of_angle_and_axis_is_that_of_its_half_angle():
    # columns of length 1, 2 sin(angle / 2) and that times sin(polar angle), orthogonal
    angle, polar = 0.3, 0.7
    expected = 1.0 / (2 * math.sin(angle / 2) * math.sin(polar))
    found = degeneracy.condition_of_angle_and_axis(np.array((angle, polar, -0.9)))
    assert found == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("one", [one for one in ERRATA if one.check], ids=lambda one: one.id)
def test_erratum_is_confirmed(one):
    assert one.check()


def test_errata_are_numbered_and_complete():
    assert [one.id for one in ERRATA] == [f"E{i:02d}" for i in range(1, len(ERRATA) + 1)]
    assert all(one.where and one.printed and one.right and one.how for one in ERRATA)


def test_texts_are_lines_with_the_numbers_of_their_module():
    one = next(claim for claim in claims.all_claims() if claim.id == "C01")
    assert "at most 0.1% of the uniform ones" in one.criterion
    assert not any(mark in text for text in (one.quote, one.criterion, one.open) for mark in ("{", "\n"))


def test_bodies_beside_a_pole_are_fast_and_outside_the_margin():
    outcomes = probes.beside_pole(0.2, "feedback-linearized/zyx-euler", Gains())
    assert len(outcomes) == probes.BESIDE
    assert list(itertools.compress(outcomes["outcome"], outcomes["outcome"] == "settled"))
