"""Each number and name that a lead takes from results, computed again from the tables by other code than the page's.

A key of a lead without a recomputation fails, so that a new lead needs one. Sentences that compare change their word on
a planted table.
"""

import importlib
import re

import pandas as pd
import pytest
from support.leads import COMPUTED

pytest.importorskip("matplotlib", reason="the report extra is not installed (cure: make setup)")

from bench.tables import read
from bench.tables.schema import RESULTS
from report.figures.arms import arm_ranking
from report.figures.comparison import comparison
from report.figures.contact import hand_axes, in_contact, limits
from report.figures.kit.page import REPORT, kinds_of, modules_of, pasted, run_in, word_of

LEAD = re.compile(r"^(:{3,})\{div\} lead\n(.*?)^\1$", re.DOTALL | re.MULTILINE)
FORCES = re.compile(r"^- \*\*Forces\.\*\*.*?(?=^-|^##)", re.DOTALL | re.MULTILINE)
PAGES = (REPORT / "index.md", *sorted(REPORT.glob("pages/*.md")))
ELSEWHERE = {
    "07-cost": {"cost_on_arms.six_share", "cost_on_arms.six_spread", "cost_on_arms.time_most_law"},
    "08-arms": {"advised"},
    "16-robustness": {"apart", "harmless", "hardest", "hardest_n", "laws"},
    "17-velocity-commands": {"lead"},
    "25-libraries": {"right", "idioms_wrong"},
    "26-live": {"laws"},
    "29-take-it-home": {"languages"},
    "40-claims": {"first_words"},
}
"""Page -> keys that no table decides alone: a rule's choice, a search for steps, what is registered."""


def leads():
    """(page, text of its lead)."""
    for path in PAGES:
        text = path.read_text(encoding="utf-8")
        found = LEAD.search(text)[2] if LEAD.search(text) else ""
        yield path.stem, found + (FORCES.search(text)[0] if path.stem == "index" else "")


@pytest.fixture(autouse=True)
def reference(monkeypatch):
    monkeypatch.setenv(read.VARIABLE, str(RESULTS / "reference"))


@pytest.mark.parametrize(("page", "text"), list(leads()), ids=[path.stem for path in PAGES])
def test_every_key_of_a_lead_is_recomputed(page, text):
    known = set(COMPUTED.get(page, dict)()) | ELSEWHERE.get(page, set())
    assert set(pasted(text)) <= known


@pytest.mark.parametrize("page", COMPUTED)
def test_leads_say_what_the_tables_say(page):
    text, run = (
        next(path for path in PAGES if path.stem == page).read_text(encoding="utf-8"),
        run_in(RESULTS / "reference"),
    )
    said = {}
    for name in modules_of(text):
        module = importlib.import_module(f"report.figures.{name}")
        if kinds_of(module, text) and hasattr(module, "facts"):
            said |= {f"{word_of(module, text)}{key}": value for key, value in module.facts(run).items()}
    for key, wanted in COMPUTED[page]().items():
        shown = str(said[key]).replace("\u202f", "")
        if not isinstance(wanted, list):
            assert shown == str(wanted), key
            continue
        numbers = iter(map(float, re.findall(r"\d+(?:\.\d+)?(?:e-?\d+)?", shown.translate(SUPERSCRIPT))))
        assert all(any(number == pytest.approx(float(one)) for number in numbers) for one in wanted), (
            key,
            shown,
            wanted,
        )


SUPERSCRIPT = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789 ", "")


def planted_pegs(bad):
    """24 pegs in frames that lean, each way; so many of the Euler ones are not in."""
    lines = [(who, 45.0, float(i < (bad if who == "e" else 0))) for who in "ce" for i in range(24)]
    frame = pd.DataFrame([*lines, ("c", 0.0, 0.0), ("e", 0.0, 0.0)], columns=["contender", "beta_deg", "jam"])
    return in_contact.stuck(frame.assign(task="peg-in-hole"), "c", "e")


def test_pegs_differ_significantly_only_where_the_test_says_so():
    assert "do not differ significantly" in planted_pegs(3)
    assert "frames differ significantly" in planted_pegs(18)


def test_closer_pegs_go_in_less_only_where_they_do():
    fits = pd.DataFrame({"clearance": [0.02, 0.02, 0.001, 0.001], "depth_m": [0.03, 0.03, 0.03, 0.0]})
    assert limits.said_of_fits(fits).startswith("fewer pegs")
    assert limits.said_of_fits(fits.assign(depth_m=0.03)).startswith("not fewer pegs")


def test_axis_is_less_off_than_the_tilt_only_where_it_is():
    one = {"contender": hand_axes.PAPERS_EULER, "beta": 30.0, "pushed": "x", "share": 1.0}
    plain = {"contender": hand_axes.PAPERS, "beta": 60.0, "pushed": "z", "share": 0.2, "off": 5.0}
    assert hand_axes.measured([{**one, "off": 24.0}, plain])["off_word"] == "less than β"
    assert hand_axes.measured([{**one, "off": 31.0}, plain])["off_word"] == "not always less than β"


def test_laws_near_the_goal_are_apart_by_their_medians():
    rows = pd.DataFrame({"contender": ["a", "b"], "start_id": 1, "angle0_rad": 0.1, "settling_time_s": [0.5, 0.6]})
    assert comparison.near(rows)["apart_30"] == "20"
    assert comparison.near(rows.assign(settling_time_s=0.5))["apart_30"] == "0"


def test_arm_is_named_as_one_without_a_pass_only_while_no_law_passes_there():
    law = {"controller": "rotation-matrix@geometric", "start_set": "uniform", "outcome": "settled", "start_id": [1, 2]}
    angles = {**law, "controller": "feedback-linearized/zyx-euler@analytic"}
    rows = pd.concat([pd.DataFrame(one) for one in (law, angles)]).assign(
        arm="panda", peak_torque_ratio=2.0, range_excess_rad=0.0
    )
    assert "no law passes: Franka Emika Panda." in arm_ranking.lead(rows)
    assert "no law passes: none." in arm_ranking.lead(rows.assign(peak_torque_ratio=0.5))
