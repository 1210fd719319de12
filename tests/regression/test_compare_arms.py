"""The gate on arms: what tells their rows apart, and what rounding may change."""

import shutil

import pytest
from support.comparing import change, ran

from bench.contenders.registry import find_contender
from bench.experiments import plan as planning
from bench.experiments.choice import Choice
from bench.regression.rows import compare
from bench.tables.store import read


@pytest.fixture(scope="module")
def arm_reference(tmp_path_factory):
    """Two arms and two inverses: what only columns of an arm tell apart."""
    places, ways = (("arm-regulation",), ("clear",), ("native",), ("puma560", "ur5e")), ("solve", "truncated-svd")
    choice = Choice(*places, ("geometric",), ways, ("nominal", "mass-1.15"))
    plan = planning.make("quick", [find_contender("rotation-matrix")], choice, count=1, horizon_s=1.5)
    return ran(plan, tmp_path_factory)


@pytest.fixture
def arm_candidate(arm_reference, tmp_path):
    return shutil.copytree(arm_reference, tmp_path / "candidate")


def doubtful(folder, beside="", by=float("nan")):
    """Episodes that 1e-12 rad gives this other outcome, and changes by so much, as the run would have written them."""

    def edit(frame):
        frame["outcome_beside"], frame["rounding_change"] = beside, by
        return frame

    change(folder, "episodes", edit)


def nominal(frame):
    settled = (frame["variation"] == "nominal") & (frame["outcome"] == "settled")
    assert settled.any()
    return settled


def test_gate_tells_arms_variations_and_joints_apart(arm_reference, arm_candidate):
    assert len(read(arm_reference, "episodes")) == 8
    assert compare(arm_reference, arm_candidate) == []
    change(arm_candidate, "episodes", lambda frame: frame[(frame["arm"] == "ur5e") | (frame["variation"] == "nominal")])
    lines = compare(arm_reference, arm_candidate)
    assert len(lines) == 2
    assert all(
        line.startswith("episodes: row is missing: quick arm-regulation puma560 mass-1.15 rotation-matrix geometric ")
        for line in lines
    )


def test_gate_names_the_joints_that_a_cost_is_for(arm_reference, arm_candidate):
    def add_one(frame):
        rows = (frame["joints"] == 6) & (frame["inverse"] == "solve") & (frame["stage"] == "invert")
        frame.loc[rows & (frame["branch"] == "worst"), "div"] += 1
        return frame

    change(arm_candidate, "costs", add_one)
    assert any(
        line.endswith(": rotation-matrix geometric solve 6 joints worst invert")
        for line in compare(arm_reference, arm_candidate)
    )


@pytest.mark.parametrize(
    ("by_rounding", "change_by", "is_told"),
    [
        (float("nan"), 2e-6, True),
        (float("nan"), 5e-7, False),
        (1e-9, 2e-6, True),
        (1e-5, 5e-5, False),  # ten times what 1e-12 rad did
        (1e-5, 2e-4, True),
        (0.2, 5.0, False),
        (float("inf"), 5.0, False),
    ],
)
def test_gate_allows_a_torque_what_rounding_makes_of_it(
    arm_reference, arm_candidate, tmp_path, by_rounding, change_by, is_told
):
    before = shutil.copytree(arm_candidate, tmp_path / "before")

    def shake(frame):
        frame.loc[nominal(frame), "peak_tau_nm"] *= 1.0 + change_by
        return frame

    for folder in (before, arm_candidate):
        doubtful(folder, by=by_rounding)
    change(arm_candidate, "episodes", shake)
    lines = compare(before, arm_candidate)
    assert bool(lines) == is_told
    assert all(line.startswith("peak_tau_nm: ") for line in lines)


@pytest.mark.parametrize(
    ("beside", "beside_now", "is_told"),
    [("", "", True), ("diverged", "", False), ("", "settled", False), ("", "stuck", True), ("stuck", "stuck", False)],
)
def test_gate_asks_for_one_outcome_in_common(arm_candidate, tmp_path, beside, beside_now, is_told):
    before = shutil.copytree(arm_candidate, tmp_path / "before")
    doubtful(before, beside)
    doubtful(arm_candidate, beside_now)

    def flip(frame):
        frame["outcome"] = frame["outcome"].astype(str).where(~nominal(frame), "diverged")
        return frame

    change(arm_candidate, "episodes", flip)
    assert any(line.startswith("outcome: settled -> diverged") for line in compare(before, arm_candidate)) == is_told


def test_gate_compares_no_cause(arm_candidate, tmp_path):
    """It follows from two numbers of a failed episode, which are not compared either."""

    def fail(cause):
        def edit(frame):
            frame["outcome"], frame["cause"] = "diverged", cause
            return frame

        return edit

    before = shutil.copytree(arm_candidate, tmp_path / "before")
    change(before, "episodes", fail("representation"))
    change(arm_candidate, "episodes", fail("both"))
    assert compare(before, arm_candidate) == []
