"""Figures, tables and findings of the pages about arms, from a small run on one arm; and what they say without one."""

import dataclasses
import functools
import re

import pandas as pd
import pytest

pytest.importorskip("matplotlib", reason="the report extra is not installed (cure: make setup)")

from bench.contenders.registry import find_contender
from bench.experiments import plan
from bench.experiments.choice import Choice
from bench.experiments.traces import of_arm
from bench.running import run
from bench.tables import read
from report.figures.arms import (
    arm_causes,
    arm_findings,
    arm_matrix,
    arm_pole,
    arm_responses,
    arm_rows,
    arm_settling,
    arm_strain,
    arm_tables,
    arm_wrist,
    model_error,
    model_rest,
)
from report.figures.kit import absent, style

ARM = "puma560"
CHOICE = Choice(
    ("arm-regulation",),
    ("clear", "pole", "wrist", "uniform"),
    ("native",),
    (ARM,),
    ("geometric", "analytic"),
    ("solve", "damped-least-squares"),
    ("nominal", "mass-0.85", "friction-2"),
)
STARTS = 2

FIGURES = {
    "matrix": lambda: arm_matrix.matrix(standard()),
    "causes": lambda: arm_causes.causes(standard()),
    "pole": lambda: arm_pole.pole(standard()),
    "settling": lambda: arm_settling.later(arm_settling.differences(standard())),
    "strain": lambda: arm_strain.strain(standard()),
    "wrist": lambda: arm_wrist.wrist(arm_rows.episodes()),
    "responses": lambda: arm_responses.angles(traces(), arm_rows.episodes()),
    "linear": lambda: arm_responses.linear(traces(), arm_rows.episodes(), 100.0, 20.0),
    "model-error": lambda: model_error.spread(varied()),
    "gravity": lambda: model_rest.gravity(model_rest.predicted(varied())),
}


@pytest.fixture(scope="module", autouse=True)
def small_run(tmp_path_factory):
    """A folder of results, which bench.tables.read reads while this module runs."""
    laws = [find_contender(word) for word in ("rotation-matrix", "feedback-linearized/zyx-euler")]
    made = plan.make("quick", laws, CHOICE, count=STARTS, horizon_s=2.5)
    folder = tmp_path_factory.mktemp("arms") / "run"
    more = (of_arm(*one, 1) for one in dict.fromkeys((u.contender, u.task, u.arm) for u in made.of("arm")))
    run.run(dataclasses.replace(made, units=(*made.units, *more)), folder)
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv(read.VARIABLE, str(folder))
        yield folder


@functools.cache
def drawn(name):
    return FIGURES[name]()


def standard():
    return arm_rows.with_standard(arm_rows.episodes())


def varied():
    return model_error.compared(arm_rows.with_standard(arm_rows.varied()))


def traces():
    return arm_rows.named(read.traces(task="arm-regulation"))


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


def test_every_page_finds_its_numbers():
    every = arm_rows.episodes()
    for values in (
        arm_findings.on_arms(every),
        arm_findings.responding(traces(), every, 100.0, 20.0),
        arm_findings.varied(arm_rows.varied(), every),
    ):
        assert all("nan" not in str(value) and absent.WORDS not in str(value) for value in values.values()), values


def test_answers_say_so_when_a_run_holds_no_variations_or_curves():
    none, every = arm_rows.varied().iloc[:0], arm_rows.episodes()
    assert all(absent.WORDS in said for said in arm_findings.varied(none, every).values())
    assert set(arm_findings.responding(traces().iloc[:0], every, 100.0, 20.0).values()) == {absent.WORDS}
    assert absent.WORDS in absent.picture(none, model_error.spread, "Model errors").alt
    assert absent.WORDS in absent.table(none, model_error.table)


def test_standard_inverse_goes_by_the_number_of_joints_and_rows():
    quaternion = "feedback-linearized/quaternion"
    assert arm_rows.standard("puma560", "rotation-matrix", "geometric") == "solve"
    assert arm_rows.standard("panda", "rotation-matrix", "geometric") == "pseudo-inverse"
    assert arm_rows.standard("puma560", quaternion, "analytic") == "pseudo-inverse"
    assert arm_rows.standard("panda", quaternion, "analytic") == "truncated-svd"


def test_every_controller_has_a_title_of_its_own():
    jacobians = ("geometric", "geometric-body", "analytic", "analytic-differentiated")
    names = [f"feedback-linearized/{word}@{by}" for word in ("zyx-euler", "mrp") for by in jacobians]
    names += [f"rotation-matrix@{by}" for by in jacobians[:2]]
    assert len({arm_rows.title(name) for name in names}) == len(names)


def test_failures_are_all_filed_under_a_cause():
    counts = arm_causes.tallied(standard())
    failed = (~arm_rows.settled(standard())).groupby(standard()["controller"]).sum()
    assert counts[list(arm_causes.COLOURS)].sum(axis=1).to_dict() == failed.to_dict()
    assert counts["n"].sum() == len(standard())


def test_clear_starts_settle_as_the_free_body_does():
    assert arm_settling.close(arm_settling.differences(standard())).all()


def test_pole_distances_are_read_from_the_names_of_the_starts():
    names = pd.Series(["pole-plus-0-exact", "pole-minus-1-k1", "pole-plus-2-k7"])
    assert arm_pole.decade(names).tolist() == [8, 1, 7]


def test_six_joints_rest_where_gravity_alone_leaves_them():
    # 1 % of a transient is left after 2.5 s at most: (1 + 25) exp(-25) of the first angle is far below it
    ratios = model_rest.ratios(model_rest.predicted(varied()))
    assert len(ratios) == STARTS * len(model_error.SHOWN)
    assert ratios.to_numpy() == pytest.approx(1.0, abs=0.02)


def test_friction_holds_more_where_there_is_more_of_it():
    assert model_rest.held_deg(ARM, 10.0, 100.0) == pytest.approx(5.0 * model_rest.held_deg(ARM, 2.0, 100.0))


def test_reach_of_a_puma_is_that_of_its_outstretched_links():
    # Corke's table: shoulder to elbow a2 and, across it, d3; elbow to wrist hypot(a3, d4); the elbow stretches wholly
    stretched = 0.4318 + (0.0203**2 + 0.4318**2) ** 0.5
    assert arm_tables.reach("puma560") == pytest.approx((stretched**2 + 0.15005**2) ** 0.5, rel=1e-3)


def test_tables_of_what_there_is_have_a_row_each():
    assert len(arm_tables.jacobians().splitlines()) == 2 + 4
    assert all(f"`{name}`" in arm_tables.arms() for name in ("jaco", "panda", "puma560", "ur5e"))
    assert arm_tables.start_sets(arm_rows.episodes()).count("none") == 2
    assert "damped-least-squares" in arm_tables.inverses()
