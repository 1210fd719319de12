"""Plans of arms: every compatible combination has one, every other is refused with the reason; a user's law too."""

import hashlib

import pytest
from support.command_line import bench
from support.on_arms import ARMS, LAWS
from support.user_law import spring_text

import tasks
from bench.base.errors import Incompatible
from bench.experiments import plan as planning
from bench.experiments.request import Request
from bench.experiments.suites import BY_WORD_ALONE, IDEAL_MOTORS, NOMINAL, SLOW, SUITES
from bench.law.contender import refusal
from bench.law.contenders import combinations
from bench.law.contenders.registry import contenders, find_contender
from bench.law.inputs import Gains

EVERY_LAW = tuple(LAWS.values())
ON_BOTH = ("ur5e", "panda")  # six joints and seven: nothing else of an arm decides what goes together
SHORT = ("run", "--dry-run", "--suite", "quick", "--task", "arm-regulation", "--starts", "clear", "--count", "2")


@pytest.fixture
def own(tmp_path):
    path = tmp_path / "mine.py"
    path.write_text(spring_text())
    return path


def crossed():
    """(contender, law, Jacobian, inverse) of everything there is."""
    for law in LAWS.values():
        for by in contenders("jacobians"):
            for through in contenders("inverses"):
                one = law._replace(jacobian=contenders("jacobians")[by], inverse=contenders("inverses")[through])
                yield one, law, by, through


@pytest.mark.parametrize("arm", ON_BOTH)
def test_plan_of_a_named_combination_is_that_one_alone_or_refused_with_its_reason(arm):
    planned = 0
    for one, law, by, through in crossed():
        request = Request(
            "quick",
            (law,),
            count=2,
            tasks=("arm-regulation",),
            start_sets=("clear",),
            arms=(arm,),
            jacobians=(by,),
            inverses=(through,),
        )
        reason = refusal(one, tasks.arm(arm).joints)
        if not reason:
            plan = planning.make(request)
            assert [one.name for one in plan.contenders] == [f"{law.name}@{by}+{through}"]
            assert {(unit.arm, unit.selector, unit.variation) for unit in plan.of("arm")} == {(arm, "clear", NOMINAL)}
            planned += 1
        else:
            with pytest.raises(Incompatible) as refused_with:
                planning.make(request)
            assert reason in str(refused_with.value)
            assert "try:" in str(refused_with.value) or "use " in str(refused_with.value)
    assert planned == len(combinations.chosen((), LAWS, tasks.arm(arm).joints))


def test_arm_alone_is_the_suite_on_that_arm():
    plan = planning.make(Request("default", EVERY_LAW, arms=("puma560",)))
    assert {unit.arm for unit in plan.units if unit.arm} == {"puma560"}
    ideal = {unit.contender for unit in plan.of("arm") if unit.variation == IDEAL_MOTORS}
    section = SUITES["default"].sections["arm"]
    words = (*section["words"], *section["operational"]["words"])
    by_words = combinations.chosen(words, LAWS, 6, by_word_alone=BY_WORD_ALONE)
    assert ideal == {one.name for one in (*by_words, *combinations.baselines(6))}
    assert {unit.selector for unit in plan.of("arm") if unit.variation == IDEAL_MOTORS} == set(
        tasks.task("arm-regulation", "puma560").start_sets
    )


def test_default_suite_varies_the_model_on_every_arm():
    plan = planning.make(Request("default", EVERY_LAW))
    varied = {(unit.arm, unit.variation) for unit in plan.of("arm")}
    assert varied == {(arm, word) for arm in ARMS for word in tasks.variation_names(arm)}


@pytest.mark.parametrize("suite", ["quick", "default"])
def test_compared_laws_run_on_every_arm_as_it_is_with_three_levels_of_gains(suite):
    plan = planning.make(Request(suite, EVERY_LAW))
    for arm in map(tasks.arm, ARMS):
        units = [unit for unit in plan.of("arm") if unit.arm == arm.name and unit.variation == NOMINAL]
        by_gains = {}
        for unit in units:
            by_gains.setdefault((unit.kp, unit.kv), set()).add(unit.law)
        own = {(arm.gains[0], 2.0 * arm.gains[0] ** 0.5)} if arm.gains else set()
        assert set(by_gains) == {(0.0, 0.0), (SLOW[0], 10.0), *own}
        for laws in by_gains.values():
            assert {"late-braking", "mrp-memory", "px4", "square-root", "rotation-matrix"} <= laws


@pytest.mark.parametrize("kp", [25.0, 100.0, 150.0])
def test_no_episode_is_planned_twice_whatever_the_gains(kp):
    units = planning.make(Request("quick", (LAWS["mrp"],), arms=("ur5e",), gains=Gains(kp, 20.0))).of("arm")
    keys = [(one.contender, one.selector, one.variation, one.kp or kp, one.first) for one in units]
    assert len(set(keys)) == len(keys)


def test_start_sets_of_the_free_body_and_of_arms_are_planned_together():
    units = planning.make(Request("quick", EVERY_LAW, count=1, start_sets=("paper", "wrist"))).units
    planned = {(unit.experiment, unit.selector) for unit in units if unit.selector}
    assert planned == {("free-body", "paper"), ("arm", "wrist")}


def test_full_suite_runs_every_compatible_combination():
    plan = planning.make(Request("full", EVERY_LAW, arms=ON_BOTH, count=1))
    for arm in ON_BOTH:
        planned = {unit.contender for unit in plan.of("arm") if unit.arm == arm and unit.variation == IDEAL_MOTORS}
        beside = combinations.baselines(tasks.arm(arm).joints)
        assert planned == {one.name for one in (*combinations.chosen((), LAWS, tasks.arm(arm).joints), *beside)}


def test_baselines_are_run_where_the_goals_joints_are_known_and_no_law_is_named():
    plan = planning.make(Request("default", EVERY_LAW, arms=("ur5e",)))
    names = {one.name for one in combinations.baselines(6)}
    assert {unit.selector for unit in plan.of("arm") if unit.contender in names} == {"reach", "uniform"}
    for words in ({"regulators": ("hybrid",)}, {"inverses": ("solve",)}, {"variations": ("mass-1.30",)}):
        found = planning.make(Request("default", (LAWS["hybrid"],), arms=("ur5e",), **words)).of("arm")
        assert found
        assert names.isdisjoint(unit.contender for unit in found)


@pytest.mark.parametrize("arm", ON_BOTH)
def test_inverses_and_twins_are_run_where_they_differ_and_all_else_from_every_set(arm):
    """On seven joints the pseudo-inverse is both the standard and one of the inverses."""
    section, joints = SUITES["default"].sections["arm"], tasks.arm(arm).joints
    at_few_starts = section["at_few_starts"]
    others = tuple(word for word in section["words"] if word not in at_few_starts)
    usual = {one.name for one in combinations.on(others, LAWS, joints)}
    few = {one.name for one in combinations.on(at_few_starts, LAWS, joints)} - usual
    for sets, expected in (((), {"wrist", "uniform"}), (("clear",), {"clear"})):
        plan = planning.make(Request("default", EVERY_LAW, arms=(arm,), start_sets=sets))
        usually = [unit for unit in plan.of("arm") if unit.variation == (NOMINAL if sets else IDEAL_MOTORS)]
        for name in few:
            assert {unit.selector for unit in usually if unit.contender == name} == expected
        for name in usual:
            assert {unit.selector for unit in usually if unit.contender == name} == set(
                sets or tasks.start_set_names(arm=True)
            )


@pytest.mark.parametrize("words", [{"arms": ("ur5e",)}, {"tasks": ("wrench-probe",), "arms": ("ur5e",)}])
def test_plan_knows_an_arms_model(words):
    """A results folder of another arm of the same name is not gone on with."""
    plan = planning.make(Request("quick", (find_contender("rotation-matrix"),), count=1, **words))
    digest = hashlib.sha256(tasks.arm("ur5e").xml.encode()).hexdigest()
    assert plan.identity()["arms"] == {"ur5e": digest[:16]}


def test_users_law_is_planned_on_every_arm_by_the_geometric_jacobian(capsys, own):
    said = bench(capsys, *SHORT, "--law", own, "--regulator", "mine")
    assert (said.code, said.err) == (0, "")
    for arm in ARMS:
        assert f"{arm}: clear 2 (each of 1 contender, at most)" in said.out


@pytest.mark.parametrize("suite", ["quick", "default"])
def test_suite_runs_a_law_on_arms_that_none_of_its_words_names(suite):
    laws = list(LAWS.values())
    new = laws[0]._replace(regulator=laws[0].regulator._replace(name="new"))
    usual, more = (
        {unit.contender for unit in planning.make(Request(suite, tuple(some), arms=("ur5e",))).of("arm")}
        for some in (laws, [*laws, new])
    )
    assert more - usual == {"new@geometric+solve"}


def test_users_law_runs_on_an_arm(capsys, own, tmp_path):
    from bench.experiments.tables import store

    out = tmp_path / "out"
    words = ("--suite", "quick", "--arm", "ur5e", "--starts", "clear", "--count", "2", "--horizon", "0.05")
    said = bench(capsys, "run", *words, "--engine", "native", "--engine", "reference", "--law", own,
                 "--regulator", "mine", "--out", out)  # fmt: skip
    assert said.code == 0, said
    rows = store.read(out, "episodes")
    assert set(rows.regulator) == {"mine"}
    assert set(zip(rows.jacobian, rows.inverse, strict=True)) == {("geometric", "solve")}
    fast, slow = (rows[rows.engine == engine].reset_index(drop=True) for engine in ("native", "reference"))
    assert fast.drop(columns="engine").equals(slow.drop(columns="engine"))
    costs = store.read(out, "costs")
    assert set(costs[costs.regulator == "mine"].joints) == {6}
