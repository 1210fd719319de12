"""What figures of the published run hold: points, bends and shares; `test_every_page` draws them all."""

import pandas as pd
import pytest

pytest.importorskip("matplotlib", reason="the report extra is not installed (cure: make setup)")

from support.pages import assert_is_drawn

from bench.experiments.tables.schema import RESULTS
from report.figures import index
from report.figures.failures import failure_map
from report.figures.kit.page import run_in
from report.figures.kit.rows import FEEDBACK
from report.figures.kit.share import share
from report.figures.responses import responses

RUN = run_in(RESULTS / "reference")


def test_figure_of_the_front_page_says_its_numbers_keeps_to_the_palette_and_fits_a_phone():
    assert_is_drawn(index.figures(RUN)["hero"])


def test_ball_shows_half_turns_at_both_ends_of_their_axis():
    points = failure_map.unit_ball(pd.DataFrame([(0.0, 1.0, 0.0, 0.0)], columns=[f"quat_{one}" for one in "wxyz"]))
    assert points == [[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]]


def test_response_bends_are_nothing_under_feedback_linearization():
    traces, _ = responses.drawn(RUN)
    own = responses.find(traces, {"start_id": "figure-2.5", "contender": FEEDBACK})
    assert responses.bend_deg(own, 100.0, 20.0).max() < 1e-6


def test_share_is_within_wilsons_interval_and_that_of_none_or_all_ends_where_shares_end():
    # Wilson's interval of 1 in 10, two-sided 95 %: 0.0179 to 0.4042 (Newcombe 1998, table I's method 3)
    found = share(1, 10)
    assert (found.low, found.value, found.high) == pytest.approx((0.0179, 0.1, 0.4042), abs=5e-5)
    assert share(0, 50).low == 0.0
    assert share(50, 50).high == 1.0


@pytest.mark.parametrize(("count", "of"), [(1, 0), (-1, 5), (6, 5)])
def test_share_refuses_what_is_none(count, of):
    with pytest.raises(ValueError, match=f"{count} of {of} is no share"):
        share(count, of)
