"""Figures, tables and findings of the pages about arms, from a small run on one arm; and what they say without one."""

import pandas as pd
import pytest

pytest.importorskip("matplotlib", reason="the report extra is not installed (cure: make setup)")

from support.pages import assert_is_whole

from bench.experiments import plan
from bench.experiments.choice import Choice
from bench.experiments.tables import read
from bench.law.contenders.registry import find_contender
from bench.running import run
from report.figures.arms import arm_pole, arm_ranking, arm_rows, arms
from report.figures.kit.page import run_in

ARM = "puma560"
CHOICE = Choice(
    ("arm-regulation",),
    ("clear", "pole", "uniform"),
    ("native",),
    (ARM,),
    ("geometric", "analytic"),
    ("solve",),
    ("nominal", "mass-0.85"),
)
STARTS = 2


@pytest.fixture(scope="module", autouse=True)
def small_run(tmp_path_factory):
    """A folder of results, which bench.experiments.tables.read reads while this module runs."""
    laws = [find_contender(word) for word in ("rotation-matrix", "feedback-linearized/zyx-euler")]
    made = plan.make("quick", laws, CHOICE, count=STARTS, horizon_s=2.5)
    folder = tmp_path_factory.mktemp("arms") / "run"
    run.run(made, folder)
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv(read.VARIABLE, str(folder))
        yield folder


def test_page_is_whole():
    assert_is_whole(arms, run_in(read.folder()))


def test_standard_inverse_goes_by_the_number_of_joints_and_rows():
    quaternion = "feedback-linearized/quaternion"
    assert arm_rows.standard("puma560", "rotation-matrix", "geometric") == "solve"
    assert arm_rows.standard("panda", "rotation-matrix", "geometric") == "pseudo-inverse"
    assert arm_rows.standard("puma560", quaternion, "analytic") == "pseudo-inverse"
    assert arm_rows.standard("panda", quaternion, "analytic") == "truncated-svd"


def test_every_controller_has_a_title_of_its_own():
    jacobians = ("geometric", "geometric-body", "analytic", "analytic-differentiated")
    names = [f"feedback-linearized/{word}@{by}" for word in ("zyx-euler", "mrp") for by in jacobians]
    names += [f"rotation-matrix@{by}" for by in jacobians[:2]]
    assert len({arm_rows.title(name) for name in names}) == len(names)


def test_pole_distances_are_read_from_the_names_of_the_starts():
    names = pd.Series(["pole-plus-0-exact", "pole-minus-1-k1", "pole-plus-2-k7"])
    assert arm_pole.decade(names).tolist() == [8, 1, 7]


def rows_of(passing: dict[str, int], of: int = 20, **columns) -> pd.DataFrame:
    """Episodes from uniform starts of controllers, so many of which pass everything."""
    usual = {"arm": ARM, "start_set": "uniform", "range_excess_rad": 0.0, "outcome": "settled"}
    return pd.concat(
        pd.DataFrame({"controller": f"{law}@geometric", "start_id": range(of), **usual}).assign(
            peak_torque_ratio=[0.5 if i < count else 2.0 for i in range(of)], **columns
        )
        for law, count in passing.items()
    )


def test_lead_names_a_winner_only_where_one_is_told_apart():
    winner = arm_ranking.leading(rows_of({"rotation-matrix": 15, "mrp": 8, "hybrid": 4}), "range")
    assert winner.startswith("of the laws (2.2) Rotation matrix settles most: 75 % (")
    assert winner.endswith("n = 20)")
    tie = arm_ranking.leading(rows_of({"rotation-matrix": 15, "mrp": 12, "hybrid": 4}), "range")
    assert "(2.2) Rotation matrix and (2.2) MRP are not distinguished from the best of them" in tie
    assert "(2.2) Rotation matrix: 75 % (" in tie
    every = rows_of(dict.fromkeys(("rotation-matrix", "mrp", "hybrid", "late-braking", "rotation-vector"), 20))
    assert arm_ranking.leading(every, "settled").startswith("5 laws are not distinguished from the best of them")


def test_baselines_are_compared_with_the_laws():
    baseline = {"regulator": "resolved-rate", "jacobian": "geometric", "way": "resolved-rate@geometric+standard"}
    law = {"regulator": "mrp", "jacobian": "geometric", "way": "mrp@geometric+standard"}
    rows = pd.concat([rows_of({"resolved-rate": 20}, **baseline), rows_of({"mrp": 5}, **law)])
    found = list(arm_ranking.ranked(rows))
    assert [cells[0] for cells in found] == ["Resolved rate", "(2.2) MRP"]
    assert found[0][3].startswith("**100 (")
    assert found[1][3] == "25 (11 to 47)"
