"""Parts of plans in contact and under perturbations: everything that goes together, or what a user names."""

import dataclasses

import pandas as pd
import pytest
from support.command_line import bench

import tasks
from bench.base.errors import Incompatible, UnknownWord
from bench.cli.details import robustness as details
from bench.experiments import plan as planning
from bench.experiments import robustness
from bench.experiments.contact import DENSE, can_do, controllers_and_poses, cut, poses_of
from bench.experiments.request import Request, integrators
from bench.experiments.suites import BOUNDED, SUITES
from bench.experiments.tables.run import with_contender
from bench.experiments.tables.schema import table_of
from bench.experiments.tables.store import read
from bench.law.contenders.registry import all_contenders, find_contender
from bench.law.control.registry import all_controllers, find_controller
from bench.running import run as running

LAW = (find_contender("rotation-matrix"),)
EVERY_LAW = tuple(one for one in all_contenders() if not one.regulator.costing_only)
TASKS = tasks.contact_names()
ABLE = [arm for arm in tasks.arm_names() if can_do(tasks.contact_task("wrench-probe"), tasks.arm(arm))]
EULER = "hybrid/zyx-euler+inverse"
DRY = ("run", "--dry-run", "--suite", "quick")


def contacts(suite="quick", **words):
    """The units in contact of a suite with these words of a request, and the episodes beside them."""
    plan = planning.make(Request(suite, LAW, **words or {"experiments": ("contact", "free-body")}))
    return plan.of("contact"), plan.episodes("free-body", "arm")


def named(units, name):
    """The different values that units have there, in their order."""
    return list(dict.fromkeys(getattr(unit, name) for unit in units))


@pytest.mark.parametrize("suite", SUITES)
def test_suite_sets_every_task_to_every_arm_that_can_do_it(suite):
    units, episodes = contacts(suite)
    section = SUITES[suite].sections["contact"]
    assert named(units, "task") == TASKS
    assert named(units, "arm") == ABLE
    for arm in map(tasks.arm, ABLE):
        mine = [unit for unit in units if unit.arm == arm.name]
        words = controllers_and_poses(section, arm.joints)[0] or [one.name for one in all_controllers()]
        assert {*named(mine, "contender")} == {*words}
        free = sum(not tasks.contact_task(name).touches(arm) for name in TASKS)
        left_out = sum(find_controller(word).law in section["in_free_space"] for word in words)
        touching = sum(word in section["in_touch"] for word in words)
        expected = len(TASKS) * len(words) - (len(TASKS) - free) * left_out - free * touching
        assert len({(unit.task, unit.contender) for unit in mine}) == expected
    assert episodes > 0


@pytest.mark.parametrize(("suite", "laws", "count"), [*((one, LAW, None) for one in SUITES), ("quick", EVERY_LAW, 7)])
def test_units_cover_each_pose_and_start_once_and_have_keys_of_their_own(suite, laws, count):
    plan = planning.make(Request(suite, laws, count=count))
    assert len({unit.key for unit in plan.units}) == len(plan.units)
    reached: dict = {}
    for unit in plan.of("contact", "free-body", "arm"):
        place = dataclasses.replace(unit, first=0, count=0, episodes=0)
        assert unit.first == reached.get(place, 0)
        reached[place] = unit.first + unit.count
    for place, found in reached.items():
        expected = place.total
        if place.experiment == "contact" and not count:
            task, arm = tasks.contact_task(place.task), tasks.arm(place.arm)
            every = len(poses_of(find_controller(place.contender), task, arm, place.selector == DENSE))
            _, most = controllers_and_poses(SUITES[suite].sections["contact"], arm.joints)
            expected = min(every, most or every)
        assert found == expected


def test_unit_lasts_some_seconds_at_most():
    task = tasks.contact_task("wrench-probe")
    units = list(cut(find_controller(EULER), task, tasks.arm("ur5e"), None, False, task.horizon_s, longest_s=20.0))
    assert len(units) > 5
    assert all(unit.episodes * unit.horizon_s <= 20.0 for unit in units)


def test_full_suite_takes_dense_trials_where_a_task_has_them():
    task = tasks.contact_task("wrench-probe")
    units, _ = contacts("full", tasks=(task.name,), arms=("ur5e",), controllers=(EULER,))
    coarse, dense = (task.trials(tasks.arm("ur5e"), dense=dense) for dense in (False, True))
    assert sum(unit.episodes for unit in units) == len(dense) > len(coarse)


def test_poses_of_a_hybrid_are_all_trials_of_the_task_in_their_order():
    for name in TASKS:
        task, arm = tasks.contact_task(name), tasks.arm("ur5e")
        poses = poses_of(find_controller(EULER), task, arm, dense=False)
        assert [trial for pose in poses for trial in pose] == list(task.trials(arm))
        assert all(len({trial.pose for trial in pose}) == 1 for pose in poses)


def test_impedance_is_set_what_differs_in_more_than_the_selection():
    """wrench-probe has several orders at each frame of the hand, alike but for what is held."""
    task, arm = tasks.contact_task("wrench-probe"), tasks.arm("ur5e")
    trials = [trial for pose in poses_of(find_controller("impedance-geometric"), task, arm, False) for trial in pose]
    frames = {(trial.goal_wxyz, trial.push) for trial in task.trials(arm)}
    assert len(trials) == len(frames) < len(task.trials(arm))
    assert {(trial.goal_wxyz, trial.push) for trial in trials} == frames


def test_integrator_in_contact_is_implicit_unless_one_is_named():
    usual, both = (
        planning.make(Request("quick", LAW, arms=("ur5e",), **integrators(word))).request
        for word in (None, "rk4")
    )
    assert (usual.integrator, usual.contact_integrator) == ("euler", "implicitfast")
    assert (both.integrator, both.contact_integrator) == ("rk4", "rk4")


SUITES_OWN = list(SUITES["quick"].sections["contact"]["controllers"])


@pytest.mark.parametrize(
    ("words", "name", "values", "has_episodes"),
    [
        ({"controllers": ("impedance-quaternion", EULER)}, "contender", ["impedance-quaternion", EULER], False),
        ({"controllers": ("impedance-quaternion", EULER)}, "task", TASKS, False),
        ({"tasks": ("wrench-probe",)}, "task", ["wrench-probe"], False),
        ({"tasks": ("wrench-probe",)}, "contender", SUITES_OWN, False),
        ({"tasks": ("free-body", "wrench-probe")}, "task", ["wrench-probe"], True),
        ({"arms": ("ur5e",)}, "arm", ["ur5e"], True),
    ],
)
def test_what_is_named_runs_alone(words, name, values, has_episodes):
    units, episodes = contacts(**words)
    assert named(units, name) == values
    assert (episodes > 0) == has_episodes


def test_dry_run_counts_trials_of_each_arm_and_task(capsys):
    said = bench(
        capsys, *DRY, "--experiment", "contact", "--controller", EULER, "--task", "wrench-probe", "--count", "3"
    )
    assert (said.code, said.err) == (0, "")
    assert f"{18 * len(ABLE)} episodes in {len(ABLE)} unit" in said.out
    assert f"controllers in contact: {EULER}" in said.out
    for arm in ABLE:
        assert f"contact, {arm}: wrench-probe 18 " in said.out


TWO = (find_contender("rotation-matrix"), find_contender("hybrid"))


def made(laws=TWO, **options):
    return planning.make(Request("quick", laws, **options))


@pytest.mark.parametrize("suite", SUITES)
def test_every_suite_perturbs_every_law_on_r_along_every_axis(suite):
    found = robustness.units(Request(suite, EVERY_LAW))
    met = {(unit.contender, unit.selector) for unit in found}
    on_matrix = [one.name for one in EVERY_LAW if one.representation is None and not one.regulator.in_engine]
    bounded = SUITES[suite].sections["robustness"]["bounded"]
    assert met >= {
        (name, axis)
        for name in on_matrix
        for axis in tasks.axis_names()
        if name not in BOUNDED or axis in (bounded or tasks.axis_names())
    }
    assert len(met) == len(found)
    for unit in found:
        assert unit.episodes == unit.count * len(tasks.axis(unit.selector).levels)


def test_a_named_axis_is_all_that_runs():
    found = made(count=3, axes=("delay",))
    assert {(unit.experiment, unit.selector) for unit in found.units} == {("robustness", "delay")}
    assert found.episodes("robustness") == found.episodes() == 2 * 3 * len(tasks.axis("delay").levels)


def test_words_that_an_axis_does_not_take_are_refused():
    with pytest.raises(Incompatible, match="takes both arms such as 'ur5e' and axes such as 'delay'"):
        made(axes=("delay",), arms=("ur5e",))
    with pytest.raises(UnknownWord, match="did you mean 'delay'"):
        made(axes=("dely",))
    with pytest.raises(Incompatible, match="laws of the free body"):
        made((find_contender("in-engine"),), axes=("delay",))


@pytest.fixture(scope="module")
def rows(tmp_path_factory) -> pd.DataFrame:
    out = tmp_path_factory.mktemp("perturbation")
    laws = tuple(find_contender(word) for word in ("rotation-matrix", "hybrid", "gibbs"))
    running.run(made(laws, count=3, axes=("delay", "half-turn-noise"), experiments=("robustness",)), out)
    return with_contender(read(out, "robustness"))


def test_there_is_a_row_for_each_law_level_and_start(rows):
    assert not rows.duplicated(list(table_of("robustness").key)).any()
    counts = rows.groupby(["contender", "axis", "level"], observed=True).size()
    assert (counts == 3).all()
    for axis in ("delay", "half-turn-noise"):
        assert sorted(rows.loc[rows["axis"] == axis, "level"].unique()) == list(tasks.axis(axis).levels)


def test_table_says_up_to_which_level_a_law_withstands(rows):
    lines = details.summary(rows).set_index("law")
    assert lines.loc["rotation-matrix", "half-turn-noise"] == "none"
    assert float(lines.loc["hybrid", "half-turn-noise"]) < float(lines.loc["hybrid", "half-turn-noise, theory"])
    assert lines.loc["hybrid", "delay"] == f"{max(tasks.axis('delay').levels):g}+"  # the end of the grid
