"""The live page in a browser: its episodes are the recorded ones, and so are the colours of its ball."""

import numpy as np
import pytest
import screenshots
from support import live

import tasks
from bench.experiments.tables.run import shown_run
from tasks.condition import Condition
from tasks.verdict import OUTCOMES

PAGE = screenshots.SITE / "pages" / "10-try-it.html"
STARTS, ROUNDED = 1000, 0.03

# The settling times of the ball's starts, by the workers that colour it, and their colours.
MAPPED = """
const [word, rows, settings, rules, done] = arguments, times = [];
liveMap.compute(word, rows, { ...settings, bound: Infinity }, rules, (i, time) => {
  times[i] = time;
  if (Object.keys(times).length === rows.length)
    done(times.map(one => [Number.isFinite(one) ? one : null, liveMap.colourOf(one, "never")]));
});
"""

missing = screenshots.missing(PAGE)
pytestmark = [pytest.mark.browser, pytest.mark.skipif(bool(missing), reason=missing or "ready")]


@pytest.fixture(scope="module")
def driver(opened):
    screenshots.open_page(opened, PAGE, screenshots.VIEWS[0])
    return opened


def test_a_thousand_episodes_of_every_law_are_the_recorded_ones(driver):
    starts = tasks.start_set("uniform", STARTS)
    rows, (settings, rules) = live.rows_of(starts), live.asked()
    script = f"return ({live.PLAYED})(...arguments)"
    beyond = {}
    for word in driver.execute_script("return Object.keys(live.laws)"):
        wanted = live.by_the_sampled_plant(word, starts)
        found = driver.execute_script(script, word, rows, settings, rules, live.SEEN)
        which = live.differing(wanted, found)
        if len(which) > live.most_that_rounding_decides(wanted):
            beyond[word] = which
    assert beyond == {}


@pytest.mark.parametrize("level", [0.01, 0.1, 0.3])
@pytest.mark.parametrize("word", ["rotation-matrix", "mrp", "mrp-memory", "quaternion-shortest", "late-braking"])
def test_sensor_that_is_off_near_180_holds_the_starts_that_it_held_in_the_results(driver, word, level):
    recorded = shown_run().table("robustness", axis="half-turn-noise", contender=word)
    recorded = recorded[np.isclose(recorded["level"], level)].reset_index()
    starts = tasks.axis("half-turn-noise").starts(len(recorded), 0, level)
    assert [one.id for one in starts] == recorded["start_id"].tolist()
    settings, rules = live.asked(Condition(worst_attitude_error=level))
    given = word, live.rows_of(starts), {**settings, "horizon_s": float(recorded["horizon_s"][0])}, rules, []
    found = driver.execute_script(f"return ({live.PLAYED})(...arguments)", *given)
    assert [OUTCOMES[row[0]] for row in found] == recorded["outcome"].tolist()
    times = [row[1] / 1000 if row[1] >= 0 else np.nan for row in found]
    np.testing.assert_allclose(times, recorded["settling_time_s"], atol=1e-9)


@pytest.mark.parametrize("word", ["rotation-matrix", "linearized-euler/zyx-euler", "mrp-memory", "late-braking"])
def test_colours_of_the_ball_are_the_recorded_settling_times(driver, word):
    recorded = shown_run().table("episodes", engine="ideal-rk4", start_set="uniform", contender=word).reset_index()
    starts, (settings, rules) = tasks.start_set("uniform", STARTS)[: len(recorded)], live.asked()
    assert [one.id for one in starts] == recorded["start_id"].tolist()
    found = driver.execute_async_script(MAPPED, word, live.rows_of(starts), settings, rules)
    times = np.array([time for time, _ in found], dtype=float)
    held = live.by_the_sampled_plant(word, starts).rows
    compiled = np.where(held[:, 1] >= 0, held[:, 1] / 1000, np.nan)
    assert np.sum(~np.isclose(times, compiled, atol=1e-9, equal_nan=True)) <= ROUNDED * len(starts)
    continuous = recorded["settling_time_s"].to_numpy(dtype=float)  # its command is not held for a millisecond
    assert np.sum(~np.isclose(times, continuous, atol=0.01, equal_nan=True)) <= ROUNDED * len(starts)
    assert [colour == "never" for _, colour in found] == np.isnan(times).tolist()
