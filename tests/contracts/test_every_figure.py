"""Every figure and table of results, drawn from a small run: words with numbers, colours of the palette, no failures.

The run is simulated once: two engines, all start sets at rest, a few traces and boundaries. It has fewer starts, and
fewer engines, than any run that a report is built from.
"""

import dataclasses
import functools

import numpy as np
import pandas as pd
import pytest

pytest.importorskip("matplotlib", reason="the report extra is not installed (cure: make setup)")

from support.pages import assert_is_drawn

from bench.experiments import boundaries, plan, traces
from bench.experiments.choice import Choice
from bench.experiments.tables import read
from bench.law.contenders.registry import find_contender
from bench.running import run
from report.figures import index
from report.figures.failures import ball, failure_map, world_map
from report.figures.kit.page import run_in
from report.figures.kit.rows import FEEDBACK
from report.figures.kit.share import share
from report.figures.responses import responses, settling_time

STARTS = ("uniform", "half-turn", "poles", "wraps", "box", "paper")
FIGURES = {
    **dict.fromkeys(("response-matrix", "response-linearized", "response-feedback"), responses),
    "settling-decades": settling_time,
    "failure-map": failure_map,
    "hero": index,
}
"""Figure -> the page's module that has it."""


@pytest.fixture(scope="module", autouse=True)
def small_run(tmp_path_factory):
    """A folder of results, which bench.experiments.tables.read reads while this module runs."""
    words = ("rotation-matrix", "linearized-euler/zyx-euler", "feedback-linearized/zyx-euler")
    laws = [find_contender(word) for word in words]
    made = plan.make("quick", laws, Choice(("free-body",), STARTS, ("ideal-rk4", "ideal-held")), count=150)
    folder = tmp_path_factory.mktemp("figures") / "run"
    more = [made_of(one, count) for made_of, count in ((traces.of_law, 2), (boundaries.of_law, 12)) for one in laws]
    run.run(dataclasses.replace(made, units=(*made.units, *more)), folder)
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv(read.VARIABLE, str(folder))
        yield folder


@functools.cache
def of_page(module):
    return module.figures(run_in(read.folder()))


def drawn(name):
    return of_page(FIGURES[name])[name]


def ideal(*start_sets):
    rows = read.episodes(engine="ideal-rk4")
    return rows[rows["start_set"].isin(start_sets)] if start_sets else rows


@pytest.mark.parametrize("name", FIGURES)
def test_figure_says_its_numbers_keeps_to_the_palette_and_fits_a_phone(name):
    assert_is_drawn(drawn(name))


def test_ball_shows_half_turns_at_both_ends_of_their_axis():
    points = ball.unit_ball(pd.DataFrame([(0.0, 1.0, 0.0, 0.0)], columns=[f"quat_{one}" for one in "wxyz"]))
    assert points == [[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]]


def test_map_keeps_areas():
    # Archimedes: directions even in longitude and in the sine of the latitude have equal shares of the sphere
    longitude, sine = np.meshgrid(np.linspace(-3.1, 3.1, 60), np.linspace(-0.95, 0.95, 60))
    step = 1e-5
    along = np.array(world_map.hammer(longitude + step, np.arcsin(sine))) - world_map.hammer(longitude, np.arcsin(sine))
    up = np.array(world_map.hammer(longitude, np.arcsin(sine + step))) - world_map.hammer(longitude, np.arcsin(sine))
    area = along[0] * up[1] - along[1] * up[0]
    np.testing.assert_allclose(area / area.mean(), 1.0, rtol=1e-3)


@pytest.mark.parametrize("facts", [responses.facts, settling_time.facts, failure_map.facts])
def test_facts_of_a_page_are_numbers(facts):
    values = facts(run_in(read.folder()))
    assert all("nan" not in str(value) for value in values.values()), values


def test_response_bends_are_nothing_under_feedback_linearization():
    traces = read.traces(start_set="paper")
    own = traces[(traces["start_id"] == "figure-2.5") & (traces["contender"] == FEEDBACK)]
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
