"""What figures of the published run hold: areas, points, bends and shares; `test_every_page` draws them all."""

import numpy as np
import pandas as pd
import pytest

pytest.importorskip("matplotlib", reason="the report extra is not installed (cure: make setup)")

from support.pages import assert_is_drawn

from bench.experiments.tables.schema import RESULTS
from report.figures import index
from report.figures.failures import failure_map, world_map
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


def test_map_keeps_areas():
    # Archimedes: directions even in longitude and in the sine of the latitude have equal shares of the sphere
    longitude, sine = np.meshgrid(np.linspace(-3.1, 3.1, 60), np.linspace(-0.95, 0.95, 60))
    step = 1e-5
    along = np.array(world_map.hammer(longitude + step, np.arcsin(sine))) - world_map.hammer(longitude, np.arcsin(sine))
    up = np.array(world_map.hammer(longitude, np.arcsin(sine + step))) - world_map.hammer(longitude, np.arcsin(sine))
    area = along[0] * up[1] - along[1] * up[0]
    np.testing.assert_allclose(area / area.mean(), 1.0, rtol=1e-3)


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
