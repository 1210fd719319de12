"""Figures, tables and findings of the pages on compliance, from a few rows of every task in contact, and from none."""

import functools
import re

import numpy as np
import pandas as pd
import pytest

pytest.importorskip("matplotlib", reason="the report extra is not installed (cure: make setup)")

import tasks
from bench.control.registry import find_compliant
from bench.engines.contact_episode import USUAL
from bench.experiments.contact import poses_of
from bench.experiments.rows import contact as contact_rows
from bench.tables import read
from report.figures.contact import (
    compliance_axes,
    compliance_forms,
    compliance_laws,
    compliance_loops,
    compliance_map,
    compliance_rows,
    compliance_said,
    compliance_tables,
    contact_models,
    contact_results,
    contact_said,
)
from report.figures.kit import absent, style

ARM = "puma560"
ZYZ = compliance_rows.ZYZ
PROJECTED = "hybrid/zyx-euler+projected"
HYBRIDS = (compliance_rows.CARTESIAN, compliance_rows.HAND, compliance_rows.EULER)
SPRINGS = ("impedance-geometric", compliance_rows.SPRINGS_OF_EULER)
WANTED = {
    "wrench-probe": (*HYBRIDS, PROJECTED, ZYZ, compliance_rows.UNCONVERTED, *SPRINGS),
    "compliance-loop": (*HYBRIDS, compliance_rows.BY_RATE),
    **dict.fromkeys(contact_results.MEASURES, (*HYBRIDS, *SPRINGS)),
}
PROBED = re.compile(r"alpha\+0 beta\+(0|5|30|60|85) gamma\+0, about x( and y)?|alpha\+35 .*, about x and y")
SCENES = {
    "wrench-probe": PROBED,
    "compliance-loop": re.compile(r"beta\+(0|45), x first"),
    "surface-alignment": re.compile(r"tilt 20 about 0, .*"),  # that of the loop on the page
}

FIGURES = {
    "axes": lambda: compliance_axes.axes_of_turning(probe()),
    "laws": lambda: compliance_laws.measured_and_predicted(probe()),
    "map": lambda: compliance_map.misalignment(probe(), (compliance_rows.EULER, compliance_rows.ZYZ)),
    "loops": lambda: compliance_loops.left_over(compliance_rows.rows("compliance-loop")),
    "contact": lambda: contact_results.by_frame(contact_results.all_rows()),
}


def chosen(task: str, poses):
    """The poses that SCENES names; of other tasks one scene with every frame of the hand."""
    if task in SCENES:
        return tuple(pose for pose in poses if SCENES[task].fullmatch(pose[0].pose))
    scene = poses[0][0].scene_pos, poses[0][0].scene_wxyz
    return tuple(pose for pose in poses if (pose[0].scene_pos, pose[0].scene_wxyz) == scene)


@pytest.fixture(scope="module", autouse=True)
def few_rows():
    """Rows of one arm, as bench.tables.read would read them."""
    frames, arm = [], tasks.arm(ARM)
    for name, words in WANTED.items():
        task = tasks.contact_task(name)
        for compliant in map(find_compliant, words):
            poses = chosen(name, poses_of(compliant, task, arm, dense=False))
            frames.append(contact_rows.frame("mine", compliant, task, arm, poses, USUAL))
    whole = read.with_compliant(pd.concat(frames, ignore_index=True))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(read, "compliance", lambda **words: read.chosen(whole, words))
        yield whole


def probe():
    return compliance_rows.rows("wrench-probe")


@functools.cache
def drawn(name):
    return FIGURES[name]()


@pytest.mark.parametrize("name", FIGURES)
def test_figure_says_its_numbers_in_words(name):
    assert len(re.findall(r"\d", drawn(name).alt)) > 1


@pytest.mark.parametrize("name", FIGURES)
def test_figure_uses_colours_of_the_palette_only(name):
    twins = {colour.lower() for pair in style.TWINS.items() for colour in pair}
    for svg in (drawn(name).wide, drawn(name).narrow):
        assert {colour.lower() for colour in re.findall(r"#[0-9a-fA-F]{6}\b", svg)} <= twins


@pytest.mark.parametrize("name", FIGURES)
def test_figure_is_drawn_for_a_phone_too(name):
    assert drawn(name).narrow not in ("", drawn(name).wide)


@pytest.mark.parametrize("beta", [30, 60, 85])
def test_euler_hand_turns_beta_off_a_moment_about_x_and_yields_by_its_cosine(beta):
    both = {one["pushed"]: one for one in compliance_axes.turns(probe()) if one["beta"] == beta and is_euler(one)}
    assert both["x"]["off"] == pytest.approx(beta, abs=0.1)
    assert both["x"]["share"] == pytest.approx(np.cos(np.radians(beta)), rel=1e-3)
    assert both["z"]["off"] == pytest.approx(90.0 - beta, abs=0.1)
    assert both["z"]["share"] == pytest.approx(np.sin(np.radians(beta)), rel=1e-3)


def is_euler(one) -> bool:
    return one["contender"] == compliance_rows.EULER


def test_cartesian_hand_turns_about_the_moment_and_holds_the_other_axis():
    both = {one["pushed"]: one for one in compliance_axes.turns(probe()) if not is_euler(one)}
    assert both["x"]["off"] == pytest.approx(0.0, abs=1e-3)
    assert both["x"]["share"] == pytest.approx(1.0)
    assert np.isnan(both["z"]["off"])


def test_measurements_lie_on_the_lines_of_theory():
    gaps = compliance_laws.gaps(probe())
    assert set(gaps) == set(compliance_laws.LAWS)
    assert max(gaps.values()) < 1e-3


def test_map_holds_beta_where_the_frame_is_level_and_a_cross_where_nothing_is_left():
    of = {name: compliance_rows.level(compliance_rows.of(probe(), name)) for name in (compliance_rows.EULER, ZYZ)}
    values, words = compliance_map.cells(of[compliance_rows.EULER])
    assert values.loc["about x and y"].to_numpy() == pytest.approx(values.columns.to_numpy(), abs=0.1)
    assert words.loc["about x", 60.0] == "60"
    failed = of[ZYZ].assign(outcome="singular")
    assert set(compliance_map.cells(failed)[1].to_numpy().ravel()) == {compliance_map.FAILED}


def test_hand_held_by_its_rate_drifts_by_about_the_square_of_the_side():
    facts = compliance_loops.facts(compliance_rows.rows("compliance-loop"))
    side, theory, rate = (float(facts[f"loop_{name}"]) for name in ("side", "theory", "rate"))
    assert theory == pytest.approx(np.degrees(np.radians(side) ** 2), rel=0.03)
    assert rate == pytest.approx(theory, rel=0.1)  # corners are rounded by damping
    assert float(facts["loop_base"]) < 0.1 * rate


def test_tables_have_a_line_for_each_impedance_beta_and_controller():
    assert len(compliance_tables.springs(probe()).splitlines()) == 2 + len(SPRINGS)
    assert len(compliance_tables.conversion(probe()).splitlines()) == 2 + len({0, 5, *compliance_axes.BETAS})
    for name in contact_results.MEASURES:
        own = compliance_rows.rows(name)
        assert len(contact_results.table(own).splitlines()) == 2 + len(WANTED[name])
    assert len(contact_said.contact(contact_results.all_rows()).splitlines()) == 2 + len(contact_results.MEASURES)


def test_unconverted_moments_turn_the_hand_the_wrong_way_and_make_work():
    line = next(one for one in compliance_tables.conversion(probe()).splitlines() if one.startswith("| 60 "))
    converted, lost, _, unconverted, made, _ = (cell.strip() for cell in line.strip("|").split("|")[1:])
    assert converted == "25.0"
    assert lost.endswith("eps")
    assert unconverted.startswith("\u2212")
    assert float(made) > 0.1


def test_every_page_finds_its_numbers():
    every = contact_results.all_rows()
    loops = compliance_loops.facts(compliance_rows.rows("compliance-loop"))
    for values in (compliance_said.probed(probe()), loops, contact_said.said(every)):
        assert all("nan" not in str(value) and absent.WORDS not in str(value) for value in values.values()), values


def test_answers_say_so_when_a_run_holds_no_contact():
    none = compliance_rows.rows("a-task-of-another-run")
    assert none.empty
    assert absent.WORDS in contact_said.contact(none)
    assert set(compliance_said.probed(none).values()) == {absent.WORDS}
    assert set(compliance_loops.facts(none).values()) == {absent.WORDS}
    for word in ("plate_euler", "betas", "penetration", "worst"):
        assert absent.WORDS in contact_said.said(none)[word]
    assert absent.WORDS in absent.picture(none, contact_results.by_frame, "Tasks in contact").alt


def test_loop_shows_a_tool_that_lies_flat_and_one_that_does_not():
    said = contact_said.plate(compliance_rows.rows("surface-alignment"))
    assert float(said["plate_cartesian"]) < 0.1
    assert float(said["plate_euler"]) > 10.0


def test_every_task_in_contact_is_shown():
    free = {"wrench-probe", "compliance-loop"}
    assert set(contact_results.MEASURES) == set(tasks.contact_names()) - free


def test_other_contacts_and_steps_leave_the_tool_where_it_was():
    cartesian, euler = contact_models.CONTROLLERS
    for variant in contact_models.VARIANTS[:2]:
        assert contact_models.episode(cartesian, variant)[1][0] < 0.1
        assert contact_models.episode(euler, variant)[1][0] > 10.0


def test_projected_form_never_runs_away_with_servos_all_alike(monkeypatch):
    monkeypatch.setattr(compliance_forms, "POSES", 20)
    compliance_forms.shares.cache_clear()
    found = compliance_forms.shares()
    compliance_forms.shares.cache_clear()
    assert (found["(S J)⁺, servos alike [%]"] == 0.0).all()
    assert found["J⁻¹ S, servos alike [%]"].max() > 0.0
