"""The eight conclusions and the answer: their words, their numbers from planted rows, and what is not tested."""

import pandas as pd
import pytest
from support.tables import changed

from bench.base.errors import NoEvidence
from bench.experiments.tables.run import Run
from bench.experiments.tables.schema import RESULTS
from bench.findings import claims, replication
from bench.findings.answer import NOT_TESTED, find_answer
from bench.findings.conclusions import FINDINGS, find_all, read_texts
from bench.findings.failure_places import (
    describe_failures,
    least_trapping_noise,
    slowness_near_half_turn,
)
from bench.findings.selection.regions import find_default

REFERENCE = RESULTS / "reference"
TABLES = ("episodes", "compliance", "costs", "robustness")

ADDED = {
    "rotation-matrix": (
        "The rotational regulator by Luh, Walker, and Paul showed reasonable performance over the entire range of "
        "rotations but with uncertain settling times and points at which the orientation error would be erroneously "
        "zero."
    ),
    "linearized-euler": "the calculations involved are more involved than for the previous regulator.",
    "feedback-linearized": (
        "However, the regulator did have difficulty on the boundary of rotation where the model of rotation failed to "
        "be valid and numeric difficulties would cause undesired behavior."
    ),
    "compliance": (
        "Force compliance using the Euler Jacobian produces compliance around the Euler angles and not necessarily "
        "about the Cartesian axes."
    ),
}
"""Words of sections 2.5 and 4 that no claim quotes, copied from the paper a second time."""


@pytest.fixture(scope="module")
def frames():
    return {name: Run(REFERENCE).table(name) for name in TABLES}


@pytest.fixture(scope="module")
def findings(frames):
    return find_all(Run(REFERENCE, dict(frames)))


def find(frames, name, **planted):
    """Return the sentence of a conclusion on the reference with planted tables."""
    return FINDINGS[name](Run(REFERENCE, {**frames, **planted}))


def of_law(frames, law):
    rows = frames["episodes"]
    return (rows["contender"].astype(str) == law) & (rows["engine"] == "ideal-rk4")


def test_there_are_eight_conclusions_each_with_a_sentence():
    assert len(read_texts()) == 8
    assert list(FINDINGS) == list(read_texts())


@pytest.mark.parametrize("name", read_texts())
def test_words_of_a_conclusion_are_those_of_its_claims_or_of_the_paper(name):
    text = read_texts()[name]
    quotes = [one.quote for one in claims.all_claims() if one.id in text["claims"]]
    known = " ".join([*quotes, ADDED.get(name, "")])
    for part in text["quote"].split(" ... "):
        for sentence in part.replace(". ", ".\n").replace("errors, ", "errors,\n").splitlines():
            assert sentence.rstrip(".,") in known
    assert all(part in text["quote"] for part in text["short"].split(" ... "))
    assert len(text["short"].replace("...", "").split()) <= 6


def test_every_sentence_has_a_number_with_its_interval(findings):
    for name, sentence in findings.items():
        assert " to " in sentence
        assert any(map(str.isdigit, sentence)), name


def test_settling_of_the_cross_product_is_read_off_the_rows(frames, findings):
    own = of_law(frames, "rotation-matrix")
    slower = changed(frames["episodes"], own, settling_time_s=lambda times: 2.0 * times)
    assert (
        "within 1.68 s (1.56 to 1.93 s). The rotation-matrix law fails from starts exactly 180°"
        in findings["rotation-matrix"]
    )
    assert "within 3.36 s (3.11 to 3.87 s). The rotation-matrix law fails from starts exactly 180°" in find(
        frames, "rotation-matrix", episodes=slower
    )


def test_places_of_failure_are_read_off_the_rows(frames):
    rows = replication.starts_at_rest(Run(REFERENCE, dict(frames)))
    rows = rows[rows["contender"].astype(str) == "rotation-matrix"]
    beta, angle, alpha = rows["beta0"].abs(), rows["angle0_rad"], rows["alpha0"].abs()
    settled = changed(rows, rows.index, outcome="settled")
    for is_failed, place in (
        (beta > 1.5707963, "gimbal lock"),
        (alpha > 2.0, "|alpha| > 114 deg"),
        (angle > 3.1, "from 177 deg on"),
        ((alpha > 2.0) & (angle < 3.0) & (beta > 1.45), "near gimbal lock"),
    ):
        assert describe_failures(changed(settled, is_failed, outcome="stuck"))[-1].endswith(place)
    assert describe_failures(settled) == []
    assert describe_failures(rows) == ["exactly 180 deg"]


def test_slow_start_near_180_degrees_is_held_against_the_median_of_the_uniform_starts():
    common = {"start_set": "uniform", "outcome": "settled", "goal_quat_w": 1.0}
    rows = pd.DataFrame([{**common, "angle0_rad": 1.0, "settling_time_s": time} for time in (1.0, 2.0, 3.0)])
    near = pd.DataFrame([{**common, "start_set": "half-turn", "angle0_rad": 3.1, "settling_time_s": 8.0}])
    both = pd.concat([rows, near], ignore_index=True)
    assert slowness_near_half_turn(both) == 4.0
    assert slowness_near_half_turn(rows) is None
    # What never settles is no slow start: it is a failure.
    assert slowness_near_half_turn(both.assign(outcome=["settled"] * 3 + ["stuck"])) is None
    assert slowness_near_half_turn(both.assign(outcome=["stuck"] * 3 + ["settled"])) is None


def test_noise_that_traps_a_law_is_read_off_the_rows(frames):
    rows = frames["robustness"]
    of_hybrid = (rows["contender"].astype(str) == "hybrid") & (rows["axis"] == "half-turn-noise")
    trapped = changed(rows, of_hybrid & (rows["level"] == 0.03), outcome="stuck")
    assert least_trapping_noise(Run(REFERENCE, dict(frames)), "hybrid") == float("inf")
    assert least_trapping_noise(Run(REFERENCE, {**frames, "robustness": trapped}), "hybrid") == 0.03
    assert least_trapping_noise(Run(REFERENCE, {**frames, "robustness": rows[~of_hybrid]}), "hybrid") is None


def test_torque_past_gimbal_lock_is_read_off_the_rows(frames):
    rows = frames["episodes"]
    euler = rows["contender"].astype(str).str.startswith("feedback-linearized/zyx-euler@analytic")
    twice = changed(rows, euler, peak_torque_ratio=lambda torque: 2.0 * torque, outcome="diverged")
    before = replication.compare_jacobians(Run(REFERENCE, dict(frames)))
    after = replication.compare_jacobians(Run(REFERENCE, {**frames, "episodes": twice}))
    assert after.harder.value == pytest.approx(2.0 * before.harder.value)
    assert after.failed == (before.failed[0], before.moves)


def test_wrong_axis_is_read_off_the_rows(frames):
    rows = frames["compliance"]
    turned = changed(rows, rows["misalignment_rad"].notna(), misalignment_rad=0.5)
    said = find(frames, "compliance", compliance=turned)
    assert "an axis that is 29° away from the axis of the moment (29° to 29° on 2 arms)" in said


@pytest.mark.parametrize("name", read_texts())
def test_sentence_says_not_tested_without_its_table(frames, name):
    lacking = {
        "euler-jacobian": "episodes",
        "compliance": "compliance",
        "cost": "costs",
        "no-regulator": "costs",
        "open-question": "costs",
    }.get(name, "episodes")
    empty = {lacking: frames[lacking].iloc[:0]}
    with pytest.raises(NoEvidence):
        find(frames, name, **empty)
    assert find_all(Run(REFERENCE, {**frames, **empty}))[name].startswith("Not tested: ")


def test_answer_is_the_law_that_the_conclusions_and_the_open_question_name(findings):
    answer = find_answer()
    assert answer.law == find_default() == answer.needs[0].law
    named = f"{answer.law} ({answer.attribution})"
    for name in ("cost", "no-regulator", "open-question"):
        assert f": {named}, " in findings[name]
    assert named in claims.judge("C27", Run(REFERENCE)).correction


def test_every_need_has_a_law_its_attribution_a_reason_and_a_price():
    needs = find_answer().needs
    assert len({need.name for need in needs}) == len(needs) >= 5
    for need in needs:
        assert all(need)
        assert need.attribution in ("published", "adapted")


def test_answer_says_not_tested_without_the_map(tmp_path):
    answer = find_answer(tmp_path)
    assert not answer.is_tested
    assert set(answer[:-1]) == {NOT_TESTED}
    assert answer.needs[0].law == NOT_TESTED
    assert {need.name: need.law for need in answer.needs}["arm"] != NOT_TESTED


def test_answer_says_not_tested_without_the_run(tmp_path):
    needs = {need.name: need for need in find_answer(run=tmp_path).needs}
    assert needs["default"].law == find_default()
    assert needs["arm"].law == needs["velocity"].law == NOT_TESTED


def test_conclusion_names_no_answer_where_none_passes(frames):
    rows = frames["episodes"]
    is_uniform = (rows["start_set"] == "uniform") & (rows["engine"] == "ideal-rk4") & (rows["arm"] == "")
    lost = changed(rows, rows.index[is_uniform][::7], outcome="stuck")
    assert "No later law passes every test." in find(frames, "open-question", episodes=pd.DataFrame(lost))
