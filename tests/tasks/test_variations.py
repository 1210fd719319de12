"""Variations of an arm's plant: factors against a model compiled from its source, friction against its level."""

import mujoco
import numpy as np
import pytest
from support.buffers import inertia_of, state_of

import tasks
from tasks.arm_model import model_xml
from tasks.variations import IMPEDANCE, SPREAD

DT = 1e-3
FACTORS = {"mass-0.70": 0.70, "mass-0.85": 0.85, "mass-1.15": 1.15, "mass-1.30": 1.30}
FRICTIONS = {"friction-2": 0.02, "friction-5": 0.05, "friction-10": 0.10}
LINKS = ("links-1", "links-2", "links-3")


def compiled(arm: str, variation: str = "nominal") -> mujoco.MjModel:
    found = tasks.arm(arm)
    model = mujoco.MjModel.from_xml_string(model_xml(found, DT))
    tasks.variation(variation).apply(model, found.rated)
    return model


def compiled_from_source(arm: str, factors) -> mujoco.MjModel:
    """MuJoCo's own compiler on the nominal arm, whose inertial parameters were scaled before it saw them."""
    found = tasks.arm(arm)
    spec = mujoco.MjSpec.from_string(model_xml(found, DT))
    for hand in (list(one.data) for one in spec.numerics if one.name == "hand"):
        tool = spec.body("tool")
        tool.explicitinertial, tool.mass, tool.ipos, tool.inertia = True, hand[0], hand[1:4], hand[4:]
        tool.mass, tool.inertia = factors[-1] * tool.mass, factors[-1] * tool.inertia
    for joint, factor in zip(spec.joints, factors, strict=True):
        joint.armature = factor * (found.motors[1] if found.motors else joint.armature)

        body = joint.parent
        body.mass, body.inertia = factor * body.mass, factor * body.inertia
        body.fullinertia = factor * body.fullinertia
    return spec.compile()


def states(arm: str, count: int, qdot: float = 0.0):
    rng = np.random.default_rng(7)
    joints = tasks.arm(arm).joints
    for _ in range(count):
        yield rng.uniform(-np.pi, np.pi, joints), qdot * rng.standard_normal(joints)


def test_nominal_is_first_and_ideal_motors_change_nothing():
    assert tasks.variation_names()[:2] == ["nominal", "ideal-motors"]
    assert tasks.variation_names("puma560")[2:] == ["motors-slow", "motors-late", *FACTORS, *LINKS, *FRICTIONS]
    plain, varied = (mujoco.MjModel.from_xml_string(model_xml(tasks.arm("panda"), DT)) for _ in range(2))
    tasks.variation("ideal-motors").apply(varied, tasks.arm("panda").rated)
    for name in ("body_mass", "body_inertia", "dof_armature", "dof_frictionloss", "actuator_ctrllimited"):
        assert np.array_equal(getattr(plain, name), getattr(varied, name))


@pytest.mark.parametrize("name", ["nominal", "motors-low", "motors-high", "mass-1.30", "friction-5"])
@pytest.mark.parametrize("arm", tasks.arm_names())
def test_motors_give_no_more_than_their_rating_and_joints_stop(arm, name):
    found = tasks.arm(arm)
    model = compiled(arm, name)
    data = state_of(model, found.home)
    data.ctrl[:] = 10.0 * np.array(found.rated)
    mujoco.mj_forward(model, data)
    np.testing.assert_array_equal(data.qfrc_actuator, found.rated)
    for joint, upper in enumerate(found.upper):
        if np.isfinite(upper):
            q = np.array(found.home)
            q[joint] = upper + 0.05
            assert state_of(model, q).qfrc_constraint[joint] < 0.0


DERIVED = ("body_subtreemass", "body_invweight0", "dof_invweight0", "dof_M0", "body_mass", "body_inertia")


@pytest.mark.parametrize("arm", tasks.arm_names())
@pytest.mark.parametrize("name", [*FACTORS, *LINKS])
def test_derived_constants_are_those_of_a_model_compiled_from_source(arm, name):
    varied, plain = compiled(arm, name), compiled(arm)
    factors = [varied.body_mass[plain.jnt_bodyid[i]] / plain.body_mass[plain.jnt_bodyid[i]] for i in range(plain.nv)]
    assert name not in FACTORS or factors == pytest.approx([FACTORS[name]] * plain.nv, rel=1e-15)
    fresh = compiled_from_source(arm, factors)
    for constant in DERIVED:
        found, expected = getattr(varied, constant), getattr(fresh, constant)
        # MuJoCo's weights come from its solve with D, whose condition number is below 1e3 on these arms: 1e-13.
        assert np.abs(found - expected).max() <= 1e-12 * np.abs(expected).max(), constant
    for q, qdot in states(arm, 3, qdot=1.0):
        a, b = state_of(varied, q, qdot), state_of(fresh, q, qdot)
        assert np.abs(inertia_of(varied, a) - inertia_of(fresh, b)).max() <= 1e-13 * inertia_of(fresh, b).max()
        assert np.abs(a.qfrc_bias - b.qfrc_bias).max() <= 1e-13 * np.abs(b.qfrc_bias).max()


@pytest.mark.parametrize("arm", tasks.arm_names())
def test_links_draws_differ_from_link_to_link_and_draw_to_draw(arm):
    plain = compiled(arm)
    moving = plain.jnt_bodyid
    drawn = np.array([compiled(arm, name).body_mass[moving] / plain.body_mass[moving] for name in LINKS])
    assert SPREAD[0] <= drawn.min() < drawn.max() <= SPREAD[1]
    assert len(np.unique(drawn.round(9))) == drawn.size
    again = compiled(arm, "links-1").body_mass[moving] / plain.body_mass[moving]
    assert np.array_equal(again, drawn[0])


@pytest.mark.parametrize("arm", tasks.arm_names())
@pytest.mark.parametrize(("name", "fraction"), FRICTIONS.items())
def test_arm_pushed_below_the_friction_level_stays_put_and_a_joint_that_turns_is_slowed_by_it(arm, name, fraction):
    found, model = tasks.arm(arm), compiled(arm, name)
    for joint, rated in enumerate(found.rated):
        data, torque = state_of(model, found.home), 0.9 * fraction * rated
        held = data.qfrc_bias.copy()
        for _ in range(500):
            data.ctrl[:] = held
            data.ctrl[joint] += torque
            mujoco.mj_step(model, data)
        # The creep of variations.py with b = 2 / (d 2 dt), which is (1 - d) dt F / m; a hundredth more for the arm's
        # slow fall away from home, where gravity is held.
        assert abs(data.qvel[joint]) <= 1.01 * (1.0 - IMPEDANCE) * DT * torque * model.dof_invweight0[joint]
    data = state_of(model, found.home, np.ones(model.nv))
    np.testing.assert_allclose(data.qfrc_constraint, -fraction * np.array(found.rated), rtol=1e-9)
