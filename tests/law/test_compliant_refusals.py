"""Controllers, constants, specifications, trials and contacts that mean nothing: one line says what, and the cure."""

import numpy as np
import pytest
from support.in_contact import ARMS
from support.own_arm import JOINTS, xml

import tasks
from bench.base.errors import BenchError
from bench.engines.contact_episode import USUAL
from bench.engines.simulate_contact import run_contact as run
from bench.law.contenders.registry import contenders, representation
from bench.law.control.contact_controller import FORMS, HYBRIDS, hybrid, impedance_controller
from bench.law.control.registry import find_controller
from bench.law.control.setpoint import TOUCH
from bench.law.inputs import Gains
from tasks.arm import arm as arm_in
from tasks.contact import Specification
from tasks.contact_checks import check_contact, check_specification, check_trial
from tasks.contact_episode import environment
from tasks.contact_model import STANDARD, model_xml
from tasks.domains.wrench_probe import TASK
from tasks.errors import BadValue, TaskError

ARM = tasks.arm("ur5e")
TRIAL = TASK.trials(ARM)[0]
SPECIFICATION = Specification("about x", (1, 1, 1, 0, 1, 1))
BASE = hybrid("hybrid-base", "inverse")
ZYX, QUATERNION = representation("zyx-euler"), representation("quaternion")
GEOMETRIC, COORDINATES = (contenders("impedances")[word] for word in ("geometric", "coordinates"))
ENGINES = pytest.mark.parametrize("engine", ["native", "reference"])


def line_of(action, kind) -> str:
    """The one line of a refusal."""
    with pytest.raises(kind) as caught:
        action()
    line = str(caught.value)
    assert "\n" not in line
    return line


@pytest.mark.parametrize(
    ("action", "says"),
    [
        (lambda: hybrid("hybrid-tool", "inverse"), ["'hybrid-tool' is no hybrid controller", *HYBRIDS]),
        (lambda: hybrid("hybrid-base", "solve"), ["'solve' is no form of hybrid control", *FORMS]),
        (lambda: hybrid("hybrid", "inverse"), ["needs some", "try: hybrid/zyx-euler+inverse"]),
        (lambda: hybrid("hybrid-base", "inverse", ZYX), ["takes no representation", "try: hybrid-base+inverse"]),
        (
            lambda: impedance_controller(COORDINATES, QUATERNION),
            ["'quaternion' has no coordinate for each", "try: zyx-euler"],
        ),
        (lambda: impedance_controller(COORDINATES), ["needs some", "try: impedance-coordinates/zyx-euler"]),
        (lambda: impedance_controller(GEOMETRIC, ZYX), ["takes no representation", "omit 'zyx-euler'"]),
        (lambda: find_controller("hybrid-bse+inverse"), ["'hybrid-bse' is unknown", "did you mean 'hybrid-base'"]),
        (
            lambda: find_controller("hybrid/zyx+inverse"),
            ["representation 'zyx' is unknown", *contenders("representations")],
        ),
        (lambda: find_controller("hybrid-base"), ["try: hybrid-base+inverse, or hybrid-base+projected, or"]),
        (lambda: find_controller("impedance-geometric+inverse"), ["omit '+inverse'"]),
    ],
)
def test_controller_that_has_no_meaning_is_refused_with_the_cure(action, says):
    line = line_of(action, BenchError)
    assert [part for part in says if part not in line] == []


@pytest.mark.parametrize("value", [0.0, -1.0, np.nan, np.inf])
@pytest.mark.parametrize("name", [*Gains._fields, *TOUCH._fields])
def test_stiffness_inertia_or_damping_that_is_none_is_refused_before_anything_runs(name, value):
    if name in Gains._fields:
        conditions = USUAL._replace(gains=USUAL.gains._replace(**{name: value}))
    else:
        conditions = USUAL._replace(touch=TOUCH._replace(**{name: value}))
    line = line_of(lambda: run("native", BASE, TASK, ARM, [TRIAL], conditions), BenchError)
    assert line.startswith(f"{name} = {value} ")
    assert "above 0 (try: " in line


@pytest.mark.parametrize(
    ("engine", "conditions", "says"),
    [
        ("nativ", USUAL, "engine 'nativ' is unknown (did you mean 'native'?)"),
        ("native", USUAL._replace(integrator="eulr"), "integrator 'eulr' is unknown (did you mean 'euler'?)"),
        ("native", USUAL._replace(dt_s=0.0), "dt_s = 0.0 s: give a finite number above 0"),
        ("reference", USUAL._replace(dt_s=np.nan), "dt_s = nan s: give a finite number above 0"),
    ],
)
def test_word_or_period_that_is_none_is_refused_before_anything_runs(engine, conditions, says):
    assert says in line_of(lambda: run(engine, BASE, TASK, ARM, [TRIAL], conditions), BenchError)


@pytest.mark.parametrize(
    ("fields", "says"),
    [
        *(
            ({"selection": selection}, "must be six of 0 and 1")
            for selection in (*((1, 1, 1, x, 1, 1) for x in (0.5, 2, -1, np.nan)), (1, 1, 1), (1, 1, 1, 0, 1, 1, 1))
        ),
        ({"selection": np.eye(6)}, "the diagonal of the selection matrix"),
        ({"desired_wrench": (0.0, 0.0, -5.0, 0.0, 0.0, 0.0)}, "z is held and is to exert -5 at once (release it"),
        ({"desired_wrench": (0.0, 0.0, 0.0, np.inf, 0.0, 0.0)}, "desired_wrench = "),
        ({"desired_wrench": (0.0, 0.0, 0.0)}, "must be 6 finite numbers [N, N m]"),
        ({"velocity": (0.0, np.nan, 0.0)}, "must be 3 finite numbers [m/s]"),
        ({"velocity": (0.1, 0.0)}, "must be 3 finite numbers [m/s]"),
    ],
)
def test_specification_that_selects_too_much_too_little_or_halves_is_refused(fields, says):
    line = line_of(lambda: check_specification(SPECIFICATION._replace(**fields)), BadValue)
    assert line.startswith("specification 'about x': ")
    assert says in line


@pytest.mark.parametrize("held", [(0,) * 6, (1,) * 6, (True, True, False, False, True, True), (1.0,) * 6])
def test_specification_that_holds_nothing_or_everything_is_unusual_and_no_more(held):
    specification = Specification("", held)
    check_specification(specification)
    ended = next(run("native", BASE, TASK._replace(horizon_s=0.02), ARM, [TRIAL._replace(specification=specification)]))
    assert ended.outcome == "done"


OTHERS_RANGE = (*TRIAL.q[:2], 7.0, *TRIAL.q[3:])


@pytest.mark.parametrize(
    ("trial", "says"),
    [
        (TRIAL._replace(q=(*TRIAL.q, 0.0)), "must be 6 finite numbers [rad], one for each joint of arm 'ur5e'"),
        (TRIAL._replace(q=(np.nan, *TRIAL.q[1:])), "must be 6 finite numbers [rad]"),
        (TRIAL._replace(q=OTHERS_RANGE), "joint 3 of arm 'ur5e' at 7 rad, outside "),
        (TRIAL._replace(goal_wxyz=(2.0, 0.0, 0.0, 0.0)), "goal_wxyz = (2.0, 0.0, 0.0, 0.0) is no unit quaternion"),
        (TRIAL._replace(mount_wxyz=(0.0, 0.0, 0.0, 0.0)), "divide it by its norm"),
        (TRIAL._replace(scene_wxyz=(1.0, 0.0, 0.0)), "scene_wxyz = (1.0, 0.0, 0.0) is no unit quaternion"),
        (TRIAL._replace(scene_pos=(0.0, np.inf, 0.0)), "must be 3 finite numbers [m]"),
        (TRIAL._replace(push=(1.0, 2.0, 3.0)), "must be 6 finite numbers [N, N m]"),
        (TRIAL._replace(legs=((0.0,) * 6,)), "it has a push and legs"),
        (TRIAL._replace(push=(0.0,) * 6, legs=((1.0,) * 6,) * 9), "9 legs, and 8 are the most"),
    ],
)
def test_trial_that_no_episode_of_the_arm_can_be_made_of_is_refused(trial, says):
    line = line_of(lambda: check_trial(trial, ARM), BadValue)
    assert line.startswith(f"trial '{TRIAL.id}': ")
    assert says in line


@pytest.mark.parametrize("word", tasks.contact_names())
@pytest.mark.parametrize("arm", ARMS)
def test_no_trial_of_ours_is_refused(word, arm):
    task, on = tasks.contact_task(word), tasks.arm(arm)
    for trial in (*task.trials(on), *task.trials(on, dense=True)):
        check_trial(trial, on)


@ENGINES
def test_arm_without_a_wrist_is_refused_with_the_cure(engine, tmp_path):
    (tmp_path / "own.xml").write_text(xml())
    own = arm_in("own", tmp_path)
    line = line_of(lambda: run(engine, BASE, TASK, own, [TRIAL]), BadValue)
    assert line.startswith("arm 'own' has no site 'wrist'")
    assert '(add <site name="wrist"/> to the last body of its file)' in line


@pytest.mark.parametrize("joints", [JOINTS, (*JOINTS, ("7", "0 1 0"))], ids=len)
def test_arm_is_taken_once_it_has_a_wrist(joints, tmp_path):
    (tmp_path / "own.xml").write_text(xml(joints).replace('<site name="tool"', '<site name="wrist"/><site name="tool"'))
    own = arm_in("own", tmp_path)
    assert 'name="hand"' in model_xml(TASK, own, 1e-3)


@pytest.mark.parametrize(
    ("name", "value"),
    [
        (name, value)
        for name in STANDARD._fields
        for value in (0.0, -0.01, np.nan, np.inf)
        if (name, value) not in (("friction", 0.0), ("noslip", 0.0))
    ],
)
def test_contact_that_MuJoCo_would_replace_without_a_word_is_refused(name, value):
    contact = STANDARD._replace(**{name: value})
    line = line_of(lambda: check_contact(contact), BadValue)
    assert line.startswith(f"contact model: {name} = {value} must be ")
    assert line.endswith(f"(try: {getattr(STANDARD, name)})")


@ENGINES
def test_bad_specification_or_contact_is_refused_by_both_engines_before_the_first_episode(engine):
    bad = TRIAL._replace(specification=SPECIFICATION._replace(selection=(1, 1, 1, 0.5, 1, 1)))
    assert "six of 0 and 1" in line_of(lambda: run(engine, BASE, TASK, ARM, [TRIAL, bad]), TaskError)
    contact = STANDARD._replace(stiffness=-0.01)
    for action in (
        lambda: run(engine, BASE, TASK, ARM, [TRIAL], USUAL, contact),
        lambda: environment(TASK, ARM, TRIAL, contact=contact),
    ):
        assert "stiffness = -0.01" in line_of(action, BadValue)


def test_contact_may_be_smooth_or_let_creep_and_its_impedance_is_a_share():
    check_contact(STANDARD._replace(friction=0.0, noslip=0))
    for value in (1.0, 2.0):
        assert "dmax = " in line_of(lambda value=value: check_contact(STANDARD._replace(dmax=value)), BadValue)
