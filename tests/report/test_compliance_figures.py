"""What the pages on compliance draw and say of the published rows."""

import numpy as np
import pytest

import tasks
from bench.experiments.tables.schema import RESULTS
from bench.findings.claims.side_by_side import predicted
from report.figures.contact import compliance, hand_axes, in_contact
from report.figures.contact.rows import PAPERS, PAPERS_EULER, level, of, of_task
from report.figures.kit.page import run_in

RUN = run_in(RESULTS / "reference")


def level_rows(contender, order=""):
    """Return the probe's rows of one controller whose goal has no alpha and no gamma."""
    return of(level(of_task(RUN, compliance.PROBE)), contender, order)


@pytest.mark.parametrize("beta", [30, 60])
def test_hand_is_drawn_turning_as_the_closed_form_of_the_papers_force_control_has_it(beta):
    """About the axis, and as far, to the percent that the hand's own way costs where it turns by ten milliradians."""
    rows, plain = (level_rows(name, hand_axes.ORDER).query("arm == 'ur5e'") for name in (PAPERS_EULER, PAPERS))
    [C] = predicted(rows[rows["beta_deg"] == beta], "zyx-euler")
    full = float(plain["c_xx"].median())
    turns = hand_axes.turns(of_task(RUN, compliance.PROBE))
    drawn = [one for one in turns if one["beta"] == beta and one["contender"] == PAPERS_EULER]
    assert len(drawn) == 2
    for one in drawn:
        k = "xyz".index(one["pushed"])
        across = np.linalg.norm(np.delete(C[:, k], k))
        assert one["off"] == pytest.approx(np.degrees(np.arctan2(across, abs(C[k, k]))), abs=1.0)
        assert one["share"] == pytest.approx(np.linalg.norm(C[:, k]) / full, rel=0.02)


def test_every_task_in_contact_is_shown():
    free = {"wrench-probe", "compliance-loop"}
    assert set(in_contact.MEASURES) == set(tasks.contact_names()) - free
