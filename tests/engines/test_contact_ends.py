"""Rest, overshoot and port energy: of records whose answers are known, and against MuJoCo's own balance of power."""

import math

import mujoco
import numpy as np
import pytest
from scipy.spatial.transform import Rotation as Turn
from support.contact_records import ARM, answered, trial
from support.in_contact import ARMS

import tasks
from bench.engines.metrics.contact import port, rest, wrench
from bench.engines.metrics.contact_force import WINDOW_S, rms
from bench.engines.metrics.contact_metric import Pose, response
from bench.engines.simulate_contact import run_contact as run
from bench.findings.theory.compliance_theory import free
from bench.law.control.registry import find_controller
from tasks.arm_model import Arm
from tasks.contact import Specification
from tasks.contact_episode import environment
from tasks.domains import force_on_plane, surface_alignment, wrench_probe

CARTESIAN = find_controller("hybrid-base+inverse")
DT, TICKS = 0.01, 401
TIME = DT * np.arange(TICKS)
NONE = pytest.approx(math.nan, nan_ok=True)
PRESSING = Specification("z", (1, 1, 0, 1, 1, 1), (0.0, 0.0, -20.0, 0.0, 0.0, 0.0))


def pose(task=surface_alignment.TASK, rested=False, **arrays) -> Pose:
    """A hand that feels 20 N and does not move, but for the arrays given."""
    force = np.tile((0.0, 0.0, 20.0), (TICKS, 1))
    one = answered(trial(PRESSING), **({"time": TIME, "force": force} | arrays))
    return Pose(task, ARM, CARTESIAN, (one._replace(rested=rested),))


LATE = np.clip(TIME - 3.5, 0.0, None)
CREEPS = pose(p=np.outer(LATE, (3e-3, 0.0, 4e-3)), R=Turn.from_rotvec(np.outer(LATE, (0.0, 0.02, 0.0))).as_matrix())
FADES_S = 0.2
TILTS = Turn.from_rotvec(np.outer(0.3 * np.exp(-TIME / FADES_S), (1.0, 0.0, 0.0))) * Turn.from_euler("x", np.pi)
"""The wrist points up, along minus the plate's normal, and its angle fades as exp(-t/FADES_S)."""
PEAKS = np.tile((100.0, 0.0, 20.0), (TICKS, 1))
PEAKS[17, 2] = 75.0
THERE_AND_BACK = pose(p=np.outer(np.sin(np.pi * TIME / TIME[-1]), (0.0, 0.0, -0.1)))


@pytest.mark.parametrize(
    ("measure", "measured", "found"),
    [
        (rest.time_to_rest, pose(rested=True), pytest.approx(TIME[-1] - 0.25)),  # when the window began
        (rest.time_to_rest, pose(), NONE),
        (rest.remaining_speed, CREEPS, pytest.approx(5e-3)),  # of the last window
        (rest.remaining_rate, CREEPS, pytest.approx(0.02)),
        (rest.remaining_speed, CREEPS._replace(task=force_on_plane.TASK), NONE),
        (rest.time_to_align, pose(R=TILTS.as_matrix()), pytest.approx(FADES_S * math.log(50.0), abs=1.01 * DT)),
        (wrench.force_overshoot, pose(force=PEAKS), pytest.approx(75.0 / 20.0 - 1.0)),  # of the component ordered
        (port.port_energy, pose(p=np.outer(TIME**2, (0.0, 0.0, -0.01))), pytest.approx(0.2 * TIME[-1] ** 2, rel=1e-12)),
        (port.port_energy, THERE_AND_BACK, pytest.approx(0.0, abs=1e-12)),
        (port.port_energy_peak, THERE_AND_BACK, pytest.approx(2.0, rel=1e-4)),
    ],
)
def test_measure_of_a_record_is_what_was_put_into_it(measure, measured, found):
    assert measure(measured) == found


@pytest.mark.parametrize("kept", [TICKS, 120])
def test_mean_error_is_over_the_window_and_what_rests_stays(kept):
    """An episode that ends at rest has the mean error of the same one watched for longer."""
    error = np.zeros((TICKS, 3))
    error[:, 0] = np.where(TIME < 1.0, 4.0, 2.0)
    short = pose(rested=True, time=TIME[:kept])
    expected = math.sqrt((1.0 * 16.0 + (WINDOW_S - 1.0) * 4.0) / WINDOW_S)
    assert rms(short, error[:kept]) == pytest.approx(expected, rel=1e-12)


def test_hand_that_yields_to_a_moment_takes_energy_as_its_inertia_and_damping_do():
    """m theta(t) = m^2 free(t), free(t) being that of an inertia with a damper (compliance_theory)."""
    task = wrench_probe.TASK
    trial = next(one for one in task.trials(ARM) if "about x, moment +x" in one.id)
    ended = next(run("native", CARTESIAN, task, ARM, [trial]))
    taken = -port.port_energy(Pose(task, ARM, CARTESIAN, (response(trial, ended),)))
    assert taken == pytest.approx(wrench_probe.PUSH**2 * free(task.horizon_s), rel=5e-3)


@pytest.mark.parametrize("arm", ARMS)
def test_energy_through_the_port_balances_that_of_the_arm_and_its_motors(arm):
    """Kinetic and potential energy, by MuJoCo, grow by the work of motors, joints' damping and surroundings: an arm
    pushed onto a plate. What is left, of a semi-implicit step and an impact, falls with the step."""
    gaps = [balance(tasks.arm(arm), dt) for dt in (2e-4, 1e-4)]
    assert abs(gaps[1]) <= 0.03
    assert abs(gaps[1]) <= 0.7 * abs(gaps[0])


def balance(arm: Arm, dt: float) -> float:
    """(What the arm gained less the work done on it) over the energy that went through the port."""
    task = surface_alignment.TASK._replace(horizon_s=0.3)

    def energies(model) -> None:
        model.opt.enableflags |= mujoco.mjtEnableBit.mjENBL_ENERGY

    trial = task.trials(arm)[3]
    loop = environment(task, arm, trial, dt, vary=energies)
    seen, physics, work, lines = loop.reset().observation, loop.physics, 0.0, []
    data, n = physics.data, arm.joints
    start = data.energy.sum()
    J = np.zeros((6, physics.model.nv))
    for _ in range(round(0.3 / dt)):
        mujoco.mj_jacSite(physics.model.ptr, data.ptr, J[:3], J[3:], physics.model.name2id("hand", "site"))
        tau = (data.qfrc_bias - data.qfrc_passive)[:n] + J[2, :n] * -30.0 - 5.0 * data.qvel[:n]
        lines.append(np.concatenate((seen["p"], seen["omega"], seen["F"])))
        before, passive = np.array(data.qvel[:n]), np.array(data.qfrc_passive[:n])
        seen = loop.step(tau).observation
        work += (tau + passive) @ (before + data.qvel[:n]) / 2.0 * dt
    p, omega, force, moment = np.split(np.array(lines), 4, axis=1)
    shown = pose(time=dt * np.arange(len(lines)), p=p, omega=omega, force=force, moment=moment).first
    given = port.given(shown)[-1]
    return float((data.energy.sum() - start - work + given) / given)
