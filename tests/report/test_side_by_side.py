"""The page on which two laws are seen side by side: its data are the curves of the run, its controls have names."""

import json
import math
import re

import numpy as np
import pandas as pd
import pytest
from bs4 import BeautifulSoup

pytest.importorskip("matplotlib", reason="the report extra is not installed (cure: make setup)")

import tasks
from bench import counting
from bench.contenders.registry import find_contender, known_regulators
from bench.experiments import traces
from bench.experiments.experiment import Settings
from bench.tables import read
from report.figures.cards import side_by_side
from report.figures.cards import side_by_side_data as sides
from tasks.truth import angle

LAWS = ("rotation-matrix", "feedback-linearized/zyx-euler", "gibbs", "quaternion-unwinding")


def starts_of(start_set, ids):
    return [one for one in tasks.start_set(start_set) if one.id in ids]


@pytest.fixture(scope="module")
def rows():
    """Curves of four laws, as the page reads them."""
    units = [traces.of_law(find_contender(name), traces.FEW) for name in LAWS]
    frames = [traces.rows(Settings(), unit) for unit in units]
    return sides.shown(read.with_contender(pd.concat(frames, ignore_index=True)))


@pytest.fixture(scope="module")
def episodes(rows):
    """The starts' own columns of episodes.parquet."""
    pairs = rows[["start_set", "start_id"]].drop_duplicates().groupby("start_set", observed=True)["start_id"]
    lines = [
        {
            "start_id": one.id,
            "angle0_rad": angle(one.quat_wxyz, one.goal_wxyz),
            **{f"omega0_{axis}": one.omega[i] for i, axis in enumerate("xyz")},
            **{f"goal_quat_{axis}": one.goal_wxyz[i] for i, axis in enumerate("wxyz")},
            **{"kp": 100.0, "kv": 20.0, "horizon_s": 20.0},
        }
        for start_set, ids in pairs
        for one in starts_of(start_set, set(ids))
    ]
    return pd.DataFrame(lines)


@pytest.fixture(scope="module")
def costs():
    return read.with_contender(pd.DataFrame(counting.rows([find_contender(name) for name in LAWS])))


@pytest.fixture(scope="module")
def page(rows, episodes, costs):
    return side_by_side.page(rows, episodes, costs)


@pytest.fixture(scope="module")
def data(page):
    return json.loads(re.search(r'<script type="application/json" id="side-data">(.*?)</script>', page, re.DOTALL)[1])


def each(rows, data):
    """(rows, numbers on the page) of every curve whose body stays a rotation."""
    for (name, start_id), own in rows.groupby(["contender", "start_id"], observed=True):
        numbers = data["curves"][name][start_id]
        if len(numbers["angle"]) == len(own):
            yield own, numbers


def test_every_law_is_there_from_every_start(rows, data):
    assert set(data["laws"]) == set(data["curves"]) == set(LAWS)
    wanted = {one for ids in traces.TELLING.values() for one in ids} | {one.id for one in tasks.start_set("paper")}
    assert wanted < set(data["starts"])
    assert all(set(curves) == set(data["starts"]) for curves in data["curves"].values())
    assert len(list(each(rows, data))) == len(LAWS) * len(data["starts"])


def test_angles_are_the_runs_to_their_unit(rows, data):
    for own, numbers in each(rows, data):
        found = np.array(numbers["angle"]) * sides.ANGLE_UNIT
        assert np.abs(found - own["angle_rad"].to_numpy()).max() <= 0.5001 * sides.ANGLE_UNIT


def test_commands_are_the_runs_up_to_the_judges_limit(rows, data):
    for own, numbers in each(rows, data):
        exact = np.minimum(np.linalg.norm(own[["u_x", "u_y", "u_z"]], axis=1), 1e6)
        found = np.array(numbers["command"], float) * sides.COMMAND_UNIT
        assert np.array_equal(np.isnan(found), np.isnan(exact))
        assert np.nanmax(np.abs(found - exact), initial=0.0) <= 0.5001 * sides.COMMAND_UNIT


def test_rotation_vector_is_as_long_as_the_angle_to_the_goal(rows, data):
    for own, numbers in each(rows, data):
        turn = np.array(numbers["turn"]).reshape(-1, 3) * sides.TURN_UNIT
        away = np.abs(np.linalg.norm(turn, axis=1) - own["angle_rad"].to_numpy())
        assert away.max() <= math.sqrt(3.0) / 2.0 * sides.TURN_UNIT + 1e-5


def test_rotation_vector_begins_where_the_start_is(data):
    [start] = starts_of("paper", {"figure-2.3"})
    w, *vector = start.quat_wxyz
    direction = np.array(vector) / np.linalg.norm(vector) * math.copysign(1.0, w)
    first = np.array(data["curves"]["gibbs"]["figure-2.3"]["turn"][:3]) * sides.TURN_UNIT
    assert first / np.linalg.norm(first) == pytest.approx(direction, abs=1e-3)


@pytest.mark.parametrize(
    ("name", "start_id", "words"),
    [
        ("rotation-matrix", "half-turn-x-exact", "is stuck 180° from the goal"),
        ("gibbs", "half-turn-x-exact", "is singular at 0.00 s and has no command"),
        ("gibbs", "half-turn-random0-k04", "asks for more than 1\u202f000\u202f000 rad/s² at 0.00 s"),
    ],
)
def test_ending_is_said_in_words(data, name, start_id, words):
    assert data["curves"][name][start_id]["ending"].replace("\N{NO-BREAK SPACE}", " ") == words


def test_law_that_unwinds_turns_through_more_than_is_left(data):
    ways = {name: data["curves"][name]["goal-beyond-wrap-gamma-up"]["turned"] for name in LAWS}
    assert ways["gibbs"] == "23°"
    assert ways["quaternion-unwinding"] == "337°"


@pytest.mark.parametrize(
    ("from_half_turn", "words"),
    [(0.0, "180°"), (1e-4, "179.994°"), (1e-2, "179.4°"), (2.0, "65°"), (math.pi, "0°")],
)
def test_degrees_tell_an_angle_from_half_a_turn(from_half_turn, words):
    assert sides.degrees(math.pi - from_half_turn) == words


@pytest.fixture(scope="module")
def parsed(page):
    return BeautifulSoup(page, "html.parser")


def test_every_control_and_drawing_has_a_name(parsed):
    operated = parsed.select("select, input, canvas, svg, button[id]")
    named = {label.get("for") for label in parsed.select("label")}
    assert len(operated) == 11
    for one in operated:
        own = one.get_text(strip=True) if one.name == "button" else one.find_parent("label")
        assert one.get("aria-label") or one["id"] in named or own, one["id"]


def test_every_law_and_every_start_can_be_chosen(parsed, data):
    options = {word: [one["value"] for one in parsed.select(f"#side-{word} option")] for word in ("a", "b", "start")}
    assert set(options["a"]) == set(options["b"]) == set(LAWS)
    assert options["start"] == list(data["starts"])


def test_presets_name_laws_and_starts_that_every_run_has():
    known = {one for ids in traces.TELLING.values() for one in ids}
    for _, a, b, start in side_by_side.PRESETS:
        assert {a.partition("/")[0], b.partition("/")[0]} <= set(known_regulators())
        assert start in known


def test_table_says_how_every_law_ends(rows, episodes):
    head, _, *lines = side_by_side.table(rows, episodes).splitlines()
    assert len(lines) == len(LAWS)
    place = [cell.strip() for cell in head.split("|")].index("180°, x")
    assert [line.split("|")[place].strip() for line in lines if "rotation matrix" in line] == ["stuck"]


def test_run_without_telling_starts_shows_nothing(rows):
    assert sides.shown(rows[rows["start_set"] == "paper"]).empty
