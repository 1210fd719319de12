"""The rendered files of the report: there, small, of a start and contenders that exist and still do what is said."""

import headline
import media as rendering
import numpy as np
import pytest
import three_fates
from drawing import THEMES
from PIL import Image
from support.tables import table

import tasks
from bench.engines.contact_episode import P, R
from report.figures.cards import live
from report.figures.kit import media, style

ABOUT = media.facts()
LOOPS = ("pole-loop", "plate-loop", "fates-loop")
FILES = [
    f"{name}{one.suffix}.{kind}"
    for one in THEMES
    for name in ("arms", "contact-tasks", "fates", *LOOPS)
    for kind in (("png", "webm", "mp4") if name in LOOPS else ("png",))
] + ["headline.png", "card.png", *(f"live-{name}.png" for name in live.PRESETS)]
LARGEST, LARGEST_IN_ALL = 200_000, 2_000_000  # a page shows one or two of them
STARTS_OF = {"png": b"\x89PNG\r\n", "webm": b"\x1a\x45\xdf\xa3", "mp4": b"ftyp"}


def test_folder_holds_these_files_alone_each_what_its_name_says_and_small():
    contents = {path.name: path.read_bytes() for path in media.FOLDER.iterdir()}
    assert set(contents) == {*FILES, "media.json", "live.json"}
    assert all(STARTS_OF[name.rpartition(".")[2]] in contents[name][:12] for name in FILES)
    assert max(map(len, contents.values())) <= LARGEST
    assert sum(map(len, contents.values())) <= LARGEST_IN_ALL


@pytest.mark.parametrize("about", [ABOUT, ABOUT["contact"]["plate"], ABOUT["fates"]], ids=LOOPS)
def test_motion_is_no_longer_than_three_seconds(about):
    assert about["loop_s"] * about["slower"] <= 3.0


def test_files_are_of_what_the_program_would_draw_now():
    rows = {one["contender"]: one | {"outcome": "settled", "failure_time_s": np.nan} for one in ABOUT["episodes"]}
    assert list(rows) == list(rendering.CONTENDERS)
    assert rendering.describe_files(rows, ABOUT["fates"]) == {
        key: value for key, value in ABOUT.items() if key not in ("commit", "headline")
    }


def test_headline_and_card_show_what_the_published_results_say():
    assert {key: value for key, value in ABOUT["headline"].items() if key != "commit"} == headline.describe()


def test_card_has_the_size_of_a_shared_link_and_the_headline_two_pixels_a_pixel():
    with Image.open(media.FOLDER / "card.png") as card, Image.open(media.FOLDER / "headline.png") as wide:
        assert card.size == headline.CARD_PIXELS
        assert wide.width == 2 * 96 * style.TEXT_WIDTH_IN


def test_three_fates_are_those_of_the_published_episodes():
    found = three_fates.simulate_fates()
    assert three_fates.describe(found) == ABOUT["fates"]
    rows = table("episodes").query("engine == 'ideal-rk4' and start_set == 'half-turn'").set_index(["start_id", "law"])
    for one in ABOUT["fates"]["episodes"]:
        row, [*_, last] = rows.loc[one["start"], one["contender"]], found[one["start"]][one["contender"]][0].poses
        assert (one["outcome"], one["path_ratio"]) == (row["outcome"], pytest.approx(row["path_ratio"], rel=1e-5))
        assert one["settling_time_s"] == (pytest.approx(row["settling_time_s"]) if one["settling_time_s"] else None)
        assert np.allclose(last, np.eye(3), atol=0.05) == (one["outcome"] == "settled")


def test_a_still_shows_every_task_in_contact():
    assert set(rendering.STILLS) == set(tasks.contact_names()) - {"wrench-probe", "compliance-loop"}


def test_joints_follow_the_hand_of_the_record():
    puppet, motion = rendering.simulate_contact(**rendering.PLATE, name=rendering.BY)
    for line in motion.frames(2.0):
        puppet.follow(line)
    hand = puppet.data.site("hand")
    np.testing.assert_allclose(hand.xpos, line[P : P + 3], atol=1e-9)
    np.testing.assert_allclose(hand.xmat.reshape(3, 3).T.ravel(), line[R : R + 9], atol=1e-9)


@pytest.mark.slow
def test_motion_is_still_that_of_the_two_controllers():
    # The first passes a singularity, where rounding decides the torque; that it swings wildly is not rounding's.
    euler, geometric = (row for _, row in rendering.simulate_at_pole().values())
    assert geometric["outcome"] == "settled"
    assert geometric["peak_torque_ratio"] < 1.0
    assert geometric["path_ratio"] == pytest.approx(1.0, abs=0.01)
    assert euler["peak_torque_ratio"] > 100.0
    assert euler["outcome"] != "settled" or euler["path_ratio"] > 3.0
