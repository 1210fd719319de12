"""What the pages on arms and compliance say and draw of made-up rows and of the published run."""

import re

import numpy as np
import pandas as pd
import pytest
from support.pages import RUN

import tasks
from bench.findings.claims.side_by_side import predicted
from report.figures.arms import arm_rows, arms, jacobians
from report.figures.contact import compliance, in_contact
from report.figures.contact.in_contact import PAPERS, PAPERS_EULER, level, of, of_task

ARM = "puma560"


def test_standard_inverse_goes_by_the_number_of_joints_and_rows():
    quaternion = "feedback-linearized/quaternion"
    assert arm_rows.standard("puma560", "rotation-matrix", "geometric") == "solve"
    assert arm_rows.standard("panda", "rotation-matrix", "geometric") == "pseudo-inverse"
    assert arm_rows.standard("puma560", quaternion, "analytic") == "pseudo-inverse"
    assert arm_rows.standard("panda", quaternion, "analytic") == "truncated-svd"


def test_every_controller_that_is_shown_has_a_title_of_its_own():
    names = [f"feedback-linearized/{word}@{by}" for word in ("zyx-euler", "mrp") for by in arm_rows.PAPERS_JACOBIANS]
    names.append(arm_rows.ON_MATRIX)
    assert len({arm_rows.title(name) for name in names}) == len(names)


def rows_of(passing: dict[str, int], of: int = 20, **columns) -> pd.DataFrame:
    """Episodes from uniform starts of controllers, so many of which pass everything."""
    usual = {"arm": ARM, "kp": 100.0, "start_set": "uniform", "range_excess_rad": 0.0, "outcome": "settled"}
    return pd.concat(
        pd.DataFrame({"controller": f"{law}@geometric", "start_id": range(of), **usual}).assign(
            peak_torque_ratio=[0.5 if i < count else 2.0 for i in range(of)], **columns
        )
        for law, count in passing.items()
    )


def test_lead_names_a_winner_only_where_one_is_told_apart():
    winner = arms.leading(rows_of({"rotation-matrix": 15, "mrp": 8, "hybrid": 4}), "range")
    assert winner.startswith("(2.2) Rotation matrix is better than every other law. With this law, 75 % (")
    assert winner.endswith("n = 20)")
    tie = arms.leading(rows_of({"rotation-matrix": 15, "mrp": 12, "hybrid": 4}), "range")
    assert tie.startswith("With (2.2) Rotation matrix and (2.2) MRP, the share of episodes that settle does not differ")
    assert "the share with (2.2) Rotation matrix." in tie
    assert "With (2.2) Rotation matrix, 75 % (" in tie
    every = rows_of(dict.fromkeys(("rotation-matrix", "mrp", "hybrid", "late-braking", "rotation-vector"), 20))
    assert arms.leading(every, "settled").startswith("With 5 laws, the share of episodes that settle does not")


def test_baselines_are_compared_with_the_laws():
    baseline = {"regulator": "resolved-rate", "jacobian": "geometric", "way": "resolved-rate@geometric+standard"}
    law = {"regulator": "mrp", "jacobian": "geometric", "way": "mrp@geometric+standard"}
    rows = pd.concat([rows_of({"resolved-rate": 20}, **baseline), rows_of({"mrp": 5}, **law)])
    found = {cells[0]: cells[2] for cells in arms.ranked(rows)}
    assert found["Resolved rate"].startswith("100\N{NO-BREAK SPACE}(")
    assert found["MRP"].split() == ["**25", "(11", "to", "47)**"]


def test_stock_pose_is_well_conditioned_and_on_the_pole():
    said = jacobians.describe_first(RUN.rows("poses", **jacobians.FIRST_EXAMPLE))
    # how large that of the angles is, rounding decides, up to a one with nothing before its power of ten
    assert re.search(r"number 7\.9\. .* Jacobian has the condition number ([2-9]·)?10[⁰¹²³⁴⁵⁶⁷⁸⁹]{2}, .* β = 90°", said)


@pytest.mark.parametrize("beta", [30, 60])
def test_hand_is_drawn_turning_as_the_closed_form_of_the_papers_force_control_has_it(beta):
    """About the axis, and as far, to the percent that the hand's own way costs where it turns by ten milliradians."""
    probed = level(of_task(RUN, compliance.PROBE)).query("arm == 'ur5e'")  # goals without alpha and gamma
    rows, plain = (of(probed, name, compliance.ORDER) for name in (PAPERS_EULER, PAPERS))
    [C] = predicted(rows[rows["beta_deg"] == beta], "zyx-euler")
    full = float(plain["c_xx"].median())
    [drawn] = [
        turn for turn in compliance.measure(of_task(RUN, compliance.PROBE), PAPERS_EULER) if turn.beta_deg == beta
    ]
    off = np.degrees(np.arctan2(np.linalg.norm(C[1:, 0]), abs(C[0, 0])))
    assert drawn.off_deg == pytest.approx(off, abs=1.0)
    assert drawn.held == pytest.approx(np.linalg.norm(C[:, 2]) / full, rel=0.02)


def test_curve_of_a_tilt_is_the_closed_form_of_that_row():
    rows = of_task(RUN, compliance.PROBE)
    row = compliance.probed(rows, PAPERS_EULER).query("beta_deg == 85")
    [C] = predicted(row, "zyx-euler")
    drawn = compliance.predict(rows, PAPERS_EULER)[-1]
    assert drawn.beta_deg == 85.0
    assert drawn.off_deg == pytest.approx(np.degrees(np.arctan2(np.linalg.norm(C[1:, 0]), abs(C[0, 0]))), abs=1e-6)


def test_every_task_in_contact_is_shown():
    free = {"wrench-probe", "compliance-loop"}
    assert set(in_contact.MEASURES) == set(tasks.contact_names()) - free
