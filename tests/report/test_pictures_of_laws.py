"""The pictures that compare laws: what stands where, who is counted, and what is said of what was not run."""

import math

import numpy as np
import pandas as pd
import pytest
from matplotlib.figure import Figure
from support.pages import RUN, assert_is_drawn

from bench.findings.answer import NOT_TESTED, Answer, find_answer
from bench.findings.perturbed import Direction, Threshold
from bench.findings.selection.sensitivity import tune
from bench.findings.theory.thresholds import HALF_TURN
from report.figures.answer import topology, which_law
from report.figures.comparison import angle, equal_peak, peaks
from report.figures.comparison.comparison import uniform
from report.figures.contact import in_contact
from report.figures.kit import families
from report.figures.kit.laws import LINEARIZED
from report.figures.robustness import changed_situations, goal_jumps, half_turn_noise, robustness

pytestmark = pytest.mark.usefixtures("reference")


@pytest.fixture
def axes():
    return Figure().subplots()


def noise(levels, **shares):
    """Made-up rows of noise at 180°: each law's share of ten starts that settle at each level."""
    rows = []
    for law, own in shares.items():
        for level, share in zip(levels, own, strict=True):
            settled = [True] * round(10 * share) + [False] * round(10 * (1 - share))
            rows += [{"contender": law.replace("_", "-"), "level": level, "good": good} for good in settled]
    made = pd.DataFrame(rows).assign(kp=100.0, kv=20.0)
    return made.assign(contender=pd.Categorical(made["contender"], ordered=True))


def test_line_to_a_label_begins_at_the_end_of_its_own_curve(axes):
    angle.label_ends(axes, {"mrp-memory": 0.541, "late-braking": 0.564, "rotation-vector": 0.583})
    assert [line.get_ydata()[0] for line in axes.lines] == [0.541, 0.564, 0.583]
    assert [text.get_text() for text in axes.texts] == ["MRP with memory", "late braking", "rotation vector"]
    for line, text in zip(axes.lines, axes.texts, strict=True):
        assert line.get_ydata()[1] == text.get_position()[1]


def test_band_holds_no_law_that_is_drawn_or_wrong_on_purpose_or_without_a_bound():
    others = angle.list_others(uniform(RUN))
    laws = [law for alike in others.values() for law in alike]
    assert laws
    assert not set(laws) & {*angle.SHOWN, *families.CONTROLS, "gibbs"}
    assert all(equation.is_bounded for equation in others)


def test_laws_are_sorted_by_the_noise_that_traps_them_within_their_group():
    rows = noise((0.001, 0.1, 0.3), gibbs=(1, 1, 0), mrp=(0, 0, 0), synergistic=(1, 0.5, 0), hybrid=(1, 1, 1))
    groups = half_turn_noise.split_by_memory(["gibbs", "hybrid", "mrp", "synergistic"])
    order = [half_turn_noise.sort_by_tolerance(rows, laws) for laws in groups.values()]
    assert order == [["mrp", "gibbs"], ["synergistic", "hybrid"]]


def test_law_that_stores_a_potential_is_not_said_to_store_a_side():
    rows = noise((0.001, 0.1, 0.3), mrp=(0, 0, 0), synergistic=(1, 0.5, 0), hybrid=(1, 1, 0))
    said = half_turn_noise.describe_trapped(rows)
    assert "all 1 laws without memory" in said
    assert "With the 1 laws that store a side and whose limit is known, the body leaves 180° from every start" in said
    assert said.endswith("at noise up to 0.1 rad")
    trapped = half_turn_noise.trap(half_turn_noise.leaving(rows), "synergistic")
    assert trapped == "the body leaves 180° with synergistic from 50 % of the starts (δ = 0.1 rad)"


def test_every_law_with_noise_is_in_one_of_the_two_pictures():
    from report.figures.comparison import noise as others

    tested = robustness.laws(robustness.along(RUN, HALF_TURN), controls=False)
    both = half_turn_noise.facts(RUN)[HALF_TURN].alt, others.facts(RUN)["others"].alt
    for law in tested:
        assert sum(f" {families.word(law)} " in f" {alt} " for alt in both) >= 1, law


def test_counts_of_laws_that_noise_does_not_trap_say_who_has_a_memory():
    assert topology.describe_part(7, 7) == "all 7 of these laws have"
    assert topology.describe_part(1, 7) == "1 of these 7 laws has"
    assert topology.describe_part(0, 7) == "none of these 7 laws has"


def test_thresholds_that_differ_are_said_beside_those_of_most_laws():
    direction = Direction("spin")
    each = {law: {direction: Threshold(20.0, math.nan, math.nan)} for law in ("mrp", "hybrid")}
    each["gibbs"] = {direction: Threshold(10.0, 15.0, 0.2)}
    groups = robustness.group_alike(each, [direction])
    assert [len(group) for group in groups] == [2, 1]
    [[law, *cells]] = robustness.list_weaker(groups, each, [direction])
    assert "Gibbs" in law
    assert cells == ["Initial spin", "10 rad/s", "20 rad/s (last level tried)"]
    said = robustness.describe_weaker(groups, each, [direction])
    assert said == "1 of the 3 laws withstands only milder levels than the other laws, for 1 of the perturbations"
    assert (
        robustness.describe_weaker(groups[:1], each, [direction])
        == "All 2 laws have the same thresholds"
    )


def test_resets_are_counted_by_path_and_by_time():
    kept, longer = goal_jumps.Jumps(4.0, 230.0, 0.50), goal_jumps.Jumps(1.0, 200.0, 0.52)
    resets = [goal_jumps.Reset("hybrid", kept, longer), goal_jumps.Reset("mrp-memory", longer, kept)]
    said = goal_jumps.describe_measures(resets)
    assert "rarer with 1 of these 2 laws. With hybrid, the share of long paths drops from 4.0 % to 1.0 %." in said
    assert said.endswith("A reset saves time with 1 of these laws")
    assert goal_jumps.pair_of(resets[0], "delay_ms") == (0.0, pytest.approx(20.0))


def test_settling_times_of_situations_are_those_of_the_map():
    line = changed_situations.follow("bound")
    assert list(line) == changed_situations.list_shown()
    assert np.isinf(line.index.max())
    assert line.to_numpy().min() > 0.0
    assert_is_drawn(changed_situations.draw_situations({"bound": line}))


def test_law_that_loses_starts_stands_at_never():
    found = {each.law: each for each in peaks.list_laws(RUN)}
    assert math.isinf(found[LINEARIZED].time_s)
    assert peaks.place(found[LINEARIZED])[1] == peaks.NEVER_S
    assert not set(found) & set(families.CONTROLS)


def test_slopes_have_every_law_once():
    drawn = [law for row in equal_peak.list_tuned() for law in row.laws]
    assert sorted(drawn) == sorted(each.law for each in tune())
    assert len(set(drawn)) == len(drawn)


def test_page_of_the_answer_names_its_laws_for_each_controller():
    table = which_law.NEEDS(which_law.list_needs()).splitlines()[2:]
    for need, line in zip(find_answer().needs, table, strict=False):
        assert families.word(need.law).split()[0] in line
        assert f"({need.attribution})" in line


def test_page_without_a_map_says_not_tested(monkeypatch):
    monkeypatch.setattr(which_law, "find_answer", lambda: Answer(*[NOT_TESTED] * 6, ()))
    assert which_law.lead() == "Which law to use is not tested: the map of situations is missing."


def pegs(contender, beta, outs):
    return [{"task": "peg-in-hole", "contender": contender, "beta_deg": beta, "jam": out} for out in outs]


def test_pegs_are_counted_by_controller_and_frame_and_missing_ones_are_not_failures():
    made = pegs(in_contact.PAPERS, 0.0, (0.0, 0.0)) + pegs(in_contact.PAPERS, 45.0, (0.0, 1.0))
    table = str(in_contact.count_pegs(pd.DataFrame(made))).replace("\N{NO-BREAK SPACE}", " ")
    assert "| Force control, Cartesian compliance | none of 2 | 1 of 2 |" in table
    assert "| Force control, Euler Jacobian | not tested | not tested |" in table
    assert "not in this run" in in_contact.compare_pegs(pd.DataFrame(made), in_contact.PAPERS, in_contact.PAPERS_EULER)
